// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_water_hydroplaning_h
#define talus_water_hydroplaning_h

#include <talus/contact/contact.h>
#include <talus/interaction/nodal_interaction.h>
#include <talus/materials/materials.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <string>
#include <vector>

namespace talus
{
  template <int dim>
  class Water;

  /// Rule of the user for the film of water below the nose of a fast slide, not
  /// a model of the film: the maximum shear stress of the seabed at the bottom
  /// of the mesh is multiplied by a factor at a node if
  ///
  /// 1. the local densimetric Froude number U/sqrt((rho_s/rho_w - 1) g h cos a)
  ///    exceeds a value: U depth-mean speed in plan, h thickness, g cos a
  ///    gravity along -y, all of the soil above the node; and
  /// 2. the soil ends within a distance ahead of the node, along the depth-mean
  ///    velocity.
  ///
  /// The soil is summed in columns as wide as the smallest cells. A column has
  /// soil if the soil is thicker than a tenth of a cell.
  template <int dim>
  class Hydroplaning : public dealii::ParameterAcceptor,
                       public NodalInteraction<dim>
  {
  public:
    /// @p materials give the densities of the soil, @p water its density; the
    /// rule changes the friction on the seabed of @p boundaries by @p contact.
    Hydroplaning(const Materials<dim>  &materials,
                 const Water<dim>      &water,
                 const Boundaries<dim> &boundaries,
                 Contact<dim>          &contact);

    /// Whether the rule is switched on.
    bool
    is_enabled() const
    {
      return factor_ < 1;
    }

    /// Check the parameters. Throws ExcUser.
    void
    check() const;

    void
    prepare(const Grid<dim> &grid) override;

    /// Choose the nodes for the present step. Collective.
    void
    begin_step(State<dim> &state) override;

    /// Whether the rule acts at owned node @p node in this step.
    bool
    acts_at(const unsigned int node) const
    {
      return is_enabled() && acts_[node];
    }

    /// Area of the seabed where the rule acts in this step, and its extent.
    void
    list_quantities(const State<dim> &state, Quantities &list) const override;

    /// Return a sentence on the rule, if enabled.
    std::vector<std::string>
    notes() const override;

    /// Return a sentence on time and place if the rule acts in this step, empty
    /// otherwise; the same on all ranks. Collective.
    std::string
    report(const State<dim> &state) const;

  private:
    static constexpr unsigned int n_axes = dim - 1; ///< in plan

    /// Sums over the soil in a column.
    struct Column
    {
      double                        volume = 0; ///< m^dim
      double                        mass   = 0; ///< kg
      double                        weight = 0; ///< submerged mass, kg
      std::array<double, n_axes>    momentum{}; ///< kg m/s
      static constexpr unsigned int n_values = 3 + n_axes;
    };

    /// Position of a column, by axis in plan.
    using Place = std::array<long, n_axes>;

    /// Part of the seabed where the rule acts.
    struct Extent
    {
      double area; ///< m^(dim-1)
      double from; ///< smallest x of a node, m
      double to;   ///< largest x of a node, m
    };

    void
    sum_columns(const State<dim> &state);
    void
    add_point(const State<dim> &state, unsigned int p);
    Column
    column_at(const Place &place) const;
    bool
    has_soil(const Column &column) const;
    bool
    is_at_nose(const State<dim> &state, const dealii::Point<dim> &x) const;
    Extent
    extent(const State<dim> &state) const;

    const Materials<dim>  &materials_;
    const Water<dim>      &water_;
    const Boundaries<dim> &boundaries_;
    Contact<dim>          &contact_;

    // Parameters
    double factor_   = 1.;
    double distance_ = 0.;
    double froude_   = 0.;

    std::vector<dealii::Point<dim>> places_;   ///< places of owned nodes, m
    std::vector<unsigned int>       nodes_;    ///< owned nodes of the seabed
    std::vector<unsigned char>      acts_;     ///< 1 or 0, by owned node
    double                          size_ = 0; ///< width of a column, m
    dealii::Point<dim>              origin_;   ///< lower corner of columns, m
    std::array<long, n_axes>        n_{};      ///< columns along each axis
    std::vector<double>             sums_;     ///< see Column, by column
  };
} // namespace talus

#endif
