// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_column_sums_h
#define talus_maps_column_sums_h

#include <talus/maps/plan_columns.h>
#include <talus/materials/materials.h>
#include <talus/state/state.h>

#include <memory>
#include <vector>

namespace talus
{
  /// What the soil in a column adds up to.
  template <int dim>
  struct ColumnSum
  {
    double                 volume   = 0; ///< m^dim
    double                 mass     = 0; ///< kg
    double                 strength = 0; ///< times the volume, Pa m^dim
    dealii::Tensor<1, dim> momentum;     ///< kg m/s
    dealii::Tensor<1, dim> bed_force;    ///< along the bed, N
  };



  /// The soil over the plan at one time, column by column: what is called
  /// depth-integrated and depth-averaged in the literature on landslides. Each
  /// column has of a point the share of its box (see box_lengths()) that stands
  /// over the column's section, as in find_profile().
  template <int dim>
  class ColumnSums
  {
  public:
    explicit ColumnSums(std::shared_ptr<const PlanColumns<dim>> columns);

    const PlanColumns<dim> &
    columns() const
    {
      return *columns_;
    }

    /// Add up this rank's soil anew; with its strength, if there are
    /// @p materials.
    void
    sum_soil(const State<dim>     &state,
             const Materials<dim> *materials = nullptr);

    /// Add a force along the bed, N, that acts on all of @p box alike.
    void
    add_bed_force(const dealii::Tensor<1, dim> &force, const Box<dim> &box);

    /// Add up the shares of all ranks; the result is on the first one.
    /// Collective.
    void
    sum_over_ranks(MPI_Comm communicator);

    /// The columns that hold soil.
    const std::vector<unsigned int> &
    with_soil() const
    {
      return with_soil_;
    }

    const ColumnSum<dim> &
    operator[](const unsigned int column) const
    {
      return sums_[column];
    }

    /// Volume over the area of the section, m.
    double
    thickness(const unsigned int column) const
    {
      return sums_[column].volume / columns_->area();
    }

    /// Mass over the area of the section, kg/m^2.
    double
    mass(const unsigned int column) const
    {
      return sums_[column].mass / columns_->area();
    }

    /// Mean of the soil's density, kg/m^3.
    double
    density(const unsigned int column) const
    {
      return sums_[column].mass / sums_[column].volume;
    }

    /// Depth-mean velocity, by mass, m/s.
    dealii::Tensor<1, dim>
    velocity(const unsigned int column) const
    {
      return sums_[column].momentum / sums_[column].mass;
    }

    /// Depth-integrated flux of momentum rho |u|^2 h, N/m.
    double
    momentum_flux(const unsigned int column) const
    {
      return sums_[column].mass / columns_->area() *
             velocity(column).norm_square();
    }

    /// Mean of the shear strength, by volume, Pa.
    double
    strength(const unsigned int column) const
    {
      return sums_[column].strength / sums_[column].volume;
    }

    /// Shear stress that the bed passes to the soil, per area of the plan, Pa.
    double
    bed_shear_stress(const unsigned int column) const
    {
      return sums_[column].bed_force.norm() / columns_->area();
    }

  private:
    void
    clear();
    bool
    may_reach(const State<dim> &state, const Batch &batch) const;
    void
    find_footprints(const State<dim> &state, const Batch &batch);
    void
    find_strengths(const State<dim>     &state,
                   const Materials<dim> &materials,
                   const Batch          &batch);
    void
    add_batch(const State<dim> &state, const Batch &batch);
    ColumnSum<dim> &
    touch(unsigned int column);

    std::shared_ptr<const PlanColumns<dim>> columns_;
    std::vector<ColumnSum<dim>>             sums_;
    std::vector<unsigned int>               touched_, with_soil_;

    // Of one batch
    Footprints<dim>     footprints_;
    std::vector<double> volumes_;   ///< m^dim
    std::vector<double> strengths_; ///< Pa; empty if nobody asks
    ColumnShares        shares_;
  };
} // namespace talus

#endif
