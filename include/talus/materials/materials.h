// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_materials_h
#define talus_materials_materials_h

#include <talus/materials/material_model.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Range of the soil of all ranks. Collective.
  StrengthRange
  over_ranks(const StrengthRange &range, MPI_Comm communicator);



  /// Name of a material and of its constitutive law.
  struct MaterialName
  {
    std::string name;
    std::string law;
  };

  /// The materials of all bodies.
  template <int dim>
  class Materials : public dealii::ParameterAcceptor
  {
  public:
    /// Make one material for each entry, with its parameters in
    /// /Materials/name.
    explicit Materials(const std::vector<MaterialName> &names);

    /// Check all parameters and assign a material to each body. Throws ExcUser,
    /// naming the body, if its material does not exist.
    void
    assign(const std::vector<std::string> &names_of_bodies,
           const std::vector<std::string> &materials_of_bodies);

    const MaterialModel<dim> &
    of_body(const unsigned int body) const
    {
      return *models_[material_of_body_[body]];
    }

    unsigned int
    n_bodies() const
    {
      return material_of_body_.size();
    }

    /// Remarks on all materials used by bodies, see MaterialModel::note().
    /// @p cell_size in m.
    std::vector<Remark>
    notes(double cell_size) const;

    /// Declare the internal variables of all laws, the pore pressure of
    /// undrained soil, and, if @p with_strength_factor, the column of factors
    /// of the strength. The factor costs memory and time in each step, so
    /// request it only if it changes.
    void
    add_columns(Points<dim> &points, bool with_strength_factor = false);

    /// Column `strength factor` [-], initially 1, used by laws with strength;
    /// invalid_unsigned_int if not declared. See
    /// MaterialModel::use_strength_factor().
    unsigned int
    strength_factor() const
    {
      return strength_factor_;
    }

    /// Column `undrained shear strength`, Pa; invalid_unsigned_int if no
    /// material uses it. To be set for new points.
    unsigned int
    undrained_strength() const
    {
      return undrained_strength_;
    }

    /// Energy of the water compressed in undrained soil, J: the sum of
    /// V u^2/(2 K_f).
    double
    water_energy(const Points<dim> &points) const;

    /// Whether the pore water of a material is undrained.
    bool
    are_undrained() const;

    /// Range of undrained_strength() in the soil of @p body, Pa; {0, 0} if the
    /// material does not use the column. Collective.
    StrengthRange
    strength_range(const Points<dim> &points,
                   unsigned int       body,
                   MPI_Comm           communicator) const;

    /// Smallest MaterialModel::largest_strength_factor() of the materials used
    /// by bodies [-]. Collective.
    double
    largest_strength_factor(const Points<dim> &points,
                            MPI_Comm           communicator) const;

    /// Return whether the derivatives of all laws are symmetric.
    bool
    has_symmetric_tangents() const
    {
      return std::all_of(models_.begin(), models_.end(), [](const auto &model) {
        return model->has_symmetric_tangent();
      });
    }

    /// See MaterialModel::use_associated_flow().
    void
    use_associated_flow(const bool is_associated)
    {
      for (const auto &model : models_)
        model->use_associated_flow(is_associated);
    }

    /// Remarks on the factor of safety of all materials.
    std::vector<Remark>
    notes_on_safety() const
    {
      std::vector<Remark> result;
      for (const auto &model : models_)
        result.push_back(model->note_on_safety());
      return joined(result);
    }

    /// Tell all laws the largest mean effective stress of their points, Pa, at
    /// the start. Collective.
    void
    use_initial_pressure(const Points<dim> &points, MPI_Comm communicator);

    /// See MaterialModel::list_state().
    void
    list_state(StateList &list)
    {
      for (const auto &model : models_)
        model->list_state(list);
    }

    /// Tell all laws the largest edge of cells with soil, m.
    void
    use_cell_size(const double largest)
    {
      for (const auto &model : models_)
        model->use_cell_size(largest);
    }

    /// Set the column of cell sizes, if a law needs it, at the points of
    /// @p batch. @p size_of maps the index of a cell to its edge, m.
    template <typename Function>
    void
    set_cell_sizes(Points<dim>    &points,
                   const Batch    &batch,
                   const Function &size_of) const
    {
      if (cell_size_ == dealii::numbers::invalid_unsigned_int)
        return;
      double *const size = points.data(cell_size_);
      for (const Segment &segment : points.segments(batch))
        std::fill(size + segment.begin,
                  size + segment.end,
                  size_of(segment.cell));
    }

    /// Advance deformation and stress of a batch of points over @p dt seconds.
    /// @param points Points of this rank.
    /// @param workspace Velocity gradients of the batch.
    /// @param batch Points to advance.
    /// @param dt Time step, s.
    void
    update_stress(Points<dim>              &points,
                  const StepWorkspace<dim> &workspace,
                  const Batch              &batch,
                  double                    dt) const;

    /// Call action(model, begin, end) for each range of points of the same
    /// material.
    template <typename Action>
    void
    for_each_material_range(const Points<dim> &points,
                            const Batch       &batch,
                            const Action      &action) const
    {
      const auto material_of = [this](const Segment &segment) {
        return material_of_body_[segment.body];
      };
      points.for_each_part(batch, material_of, [&](const Batch &part) {
        const Segment &segment = points.segments()[part.first_segment];
        action(*models_[material_of(segment)], part.begin, part.end);
      });
    }

  private:
    std::vector<MaterialName>                        names_;
    std::vector<std::string>                         listed_names_;
    std::vector<std::unique_ptr<MaterialModel<dim>>> models_;
    std::vector<unsigned int>                        material_of_body_;
    unsigned int strength_factor_    = dealii::numbers::invalid_unsigned_int;
    unsigned int undrained_strength_ = dealii::numbers::invalid_unsigned_int;
    unsigned int cell_size_          = dealii::numbers::invalid_unsigned_int;
  };
} // namespace talus

#endif
