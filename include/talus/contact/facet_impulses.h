// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_facet_impulses_h
#define talus_contact_facet_impulses_h

#include <talus/contact/facets.h>
#include <talus/state/state.h>

#include <array>
#include <vector>

namespace talus
{
  /// Identity of a facet in tables, on any number of ranks: key of its cell
  /// (two numbers), obstacle, number of the facet among those of the obstacle in
  /// the cell.
  using FacetName = std::array<double, 4>;

  template <int dim>
  FacetName
  name_of(const ContactFacet<dim> &facet);



  /// What a facet passes to the soil in a step.
  template <int dim>
  struct FacetImpulse
  {
    double                 normal = 0; ///< along the facet's normal, N s
    dealii::Tensor<1, dim> tangential; ///< along the facet, N s
    double                 effective_mass = 0; ///< that the facet sees, kg
    double mean_normal = 0; ///< of the last steps, which limits friction, N s

    bool
    acts() const
    {
      return normal > 0 || tangential.norm_square() > 0;
    }
  };



  /// Those of all facets of this rank, which outlive the facets: when the mesh,
  /// its partition or the place of an obstacle changes, and in checkpoints, they
  /// stay with the cell, the obstacle and the number of the facet there.
  template <int dim>
  class FacetImpulses
  {
  public:
    explicit FacetImpulses(const Facets<dim> &facets)
      : facets_(facets)
    {}

    /// Of Facets::owned().
    const std::vector<FacetImpulse<dim>> &
    all() const
    {
      return impulses_;
    }

    FacetImpulse<dim> &
    operator[](const unsigned int facet)
    {
      return impulses_[facet];
    }

    const FacetImpulse<dim> &
    operator[](const unsigned int facet) const
    {
      return impulses_[facet];
    }

    /// Take @p impulses of Facets::owned().
    void
    set(const std::vector<FacetImpulse<dim>> &impulses);

    /// Return one row for each loaded facet, or the restored rows if they have not
    /// been taken yet: key of the cell (two), obstacle, number of the facet in
    /// its cell, and those of FacetImpulse.
    std::vector<double>
    rows() const;

    /// Those that have a row in @p rows; no impulse for the other facets.
    void
    take(const std::vector<double> &rows);

    /// Keep @p rows until there are facets for them, see take_restored().
    void
    restore(const std::vector<double> &rows)
    {
      restored_ = rows;
    }

    bool
    has_restored() const
    {
      return !restored_.empty();
    }

    void
    take_restored();

    void
    list_state(StateList &list);

  private:
    static constexpr unsigned int n_columns = 7 + dim;

    const Facets<dim>             &facets_;
    std::vector<FacetImpulse<dim>> impulses_;
    std::vector<double>            restored_; ///< rows of a checkpoint
  };
} // namespace talus

#endif
