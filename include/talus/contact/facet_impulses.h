// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_facet_impulses_h
#define talus_contact_facet_impulses_h

#include <talus/contact/facets.h>
#include <talus/state/state.h>

#include <array>
#include <vector>

namespace talus
{
  /// Identity of a facet in tables, on any number of ranks: key of the cell
  /// (two numbers), number of the obstacle, ContactFacet::number.
  using FacetName = std::array<double, 4>;

  template <int dim>
  FacetName
  name_of(const ContactFacet<dim> &facet);



  /// Impulse of a facet on the soil in a step.
  template <int dim>
  struct FacetImpulse
  {
    double                 normal = 0;         ///< along the normal, N s, >= 0
    dealii::Tensor<1, dim> tangential;         ///< along the facet, N s
    double                 effective_mass = 0; ///< mass of soil, kg; 0: none
    double mean_normal = 0; ///< running mean of `normal`, limits friction, N s

    bool
    acts() const
    {
      return normal > 0 || tangential.norm_square() > 0;
    }
  };



  /// Impulses of all facets in owned cells. As long as a facet with the same
  /// FacetName exists, an impulse survives changes of the mesh and its
  /// partition, motion of obstacles, and checkpoints.
  template <int dim>
  class FacetImpulses
  {
  public:
    explicit FacetImpulses(const Facets<dim> &facets)
      : facets_(facets)
    {}

    /// Return the impulses, one per facet of Facets::owned().
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

    /// Replace all impulses. @p impulses: one per facet of Facets::owned().
    void
    set(const std::vector<FacetImpulse<dim>> &impulses);

    /// Return a row for each loaded facet: name_of(), normal impulse, effective
    /// mass, mean normal impulse, tangential impulse. Between restore() and
    /// take_restored(): return the restored rows.
    std::vector<double>
    rows() const;

    /// Replace all impulses by @p rows, see rows(). Facets without a row get no
    /// impulse; rows without a facet on this rank are ignored.
    void
    take(const std::vector<double> &rows);

    /// Store @p rows of a checkpoint until take_restored(), when facets exist.
    /// Empty @p rows delete stored ones.
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

    /// Give the restored rows, if any, to the facets.
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
