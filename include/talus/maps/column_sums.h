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
  /// Integrals over the soil in a column.
  template <int dim>
  struct ColumnSum
  {
    double                 volume   = 0; ///< m^dim
    double                 mass     = 0; ///< kg
    double                 strength = 0; ///< strength times volume, Pa m^dim
    dealii::Tensor<1, dim> momentum;     ///< kg m/s
    dealii::Tensor<1, dim> bed_force;    ///< along the bed, N
  };



  /// Find the columns overlapped by the boxes (see box_lengths()) of the points
  /// of @p batch, numbered from the first point of the batch.
  template <int dim>
  void
  find_shares(const State<dim>       &state,
              const Batch            &batch,
              const PlanColumns<dim> &columns,
              Footprints<dim>        &footprints,
              ColumnShares           &shares);



  /// Soil summed over columns in plan at a given time: the depth-integrated and
  /// depth-averaged quantities of the literature on landslides. A point
  /// contributes to each column by the fraction of the box (see box_lengths())
  /// over the section of the column, as in find_profile().
  template <int dim>
  class ColumnSums
  {
  public:
    explicit ColumnSums(std::shared_ptr<const PlanColumns<dim>> columns)
      : columns_(std::move(columns))
      , sums_(columns_->size())
    {}

    const PlanColumns<dim> &
    columns() const
    {
      return *columns_;
    }

    /// Replace all sums by the sums over the soil of the local rank; shear
    /// strength is included only if @p materials is not null.
    void
    sum_soil(const State<dim>     &state,
             const Materials<dim> *materials = nullptr);

    /// Add a force along the bed, N, distributed uniformly over @p box.
    void
    add_bed_force(const dealii::Tensor<1, dim> &force, const Box<dim> &box);

    /// Add up the sums of all ranks on the first rank. Collective.
    void
    sum_over_ranks(MPI_Comm communicator);

    /// Columns with soil.
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

    /// Thickness of the soil: volume over the area of the section, m.
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

    /// Mean density of the soil, kg/m^3.
    double
    density(const unsigned int column) const
    {
      return sums_[column].mass / sums_[column].volume;
    }

    /// Depth-averaged velocity, weighted by mass, m/s.
    dealii::Tensor<1, dim>
    velocity(const unsigned int column) const
    {
      return sums_[column].momentum / sums_[column].mass;
    }

    /// Depth-integrated momentum flux rho |u|^2 h, N/m.
    double
    momentum_flux(const unsigned int column) const
    {
      return sums_[column].mass / columns_->area() *
             velocity(column).norm_square();
    }

    /// Mean shear strength, weighted by volume, Pa.
    double
    strength(const unsigned int column) const
    {
      return sums_[column].strength / sums_[column].volume;
    }

    /// Shear stress of the bed on the soil, per plan area, Pa.
    double
    bed_shear_stress(const unsigned int column) const
    {
      return sums_[column].bed_force.norm() / columns_->area();
    }

  private:
    void
    clear()
    {
      // Only the touched columns are cleared: a map is larger than the slide.
      for (const unsigned int column : touched_)
        sums_[column] = ColumnSum<dim>();
      touched_.clear();
      with_soil_.clear();
    }
    void
    find_strengths(const State<dim>     &state,
                   const Materials<dim> &materials,
                   const Batch          &batch);
    void
    add_batch(const State<dim> &state, const Batch &batch);
    ColumnSum<dim> &
    touch(const unsigned int column)
    {
      // A column may receive a force before soil, or a force only.
      if (sums_[column].mass == 0)
        touched_.push_back(column);
      return sums_[column];
    }

    std::shared_ptr<const PlanColumns<dim>> columns_;
    std::vector<ColumnSum<dim>>             sums_;
    std::vector<unsigned int>               touched_, with_soil_;

    // Scratch data of the current batch
    Footprints<dim>     footprints_;
    std::vector<double> volumes_;   ///< m^dim
    std::vector<double> strengths_; ///< Pa; empty if not requested
    ColumnShares        shares_;
  };
} // namespace talus

#endif
