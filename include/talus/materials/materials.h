// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_materials_h
#define talus_materials_materials_h

#include <talus/materials/material_model.h>

#include <memory>
#include <string>
#include <vector>

namespace talus
{
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
    /// One material for each entry, with its parameters in /Materials/name.
    explicit Materials(const std::vector<MaterialName> &names);

    /// Check all parameters and note which material each body is made of.
    /// Throws ExcUser if there is none of that name; @p names_of_bodies are
    /// named in the message.
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

    /// The notes of all materials that bodies are made of, see
    /// MaterialModel::note(). @p cell_size in m.
    std::vector<std::string>
    notes(double cell_size) const;

    /// Declare the internal variables of all laws and, if
    /// @p with_strength_factor, the column that multiplies the strength of each
    /// point. It costs memory and time in each step, so only those who change
    /// it ask for it.
    void
    add_columns(Points<dim> &points, bool with_strength_factor = false);

    /// The column `strength factor` [-], 1 at the start, for those laws that
    /// have a strength; invalid_unsigned_int if there is none. See
    /// MaterialModel::use_strength_factor().
    unsigned int
    strength_factor() const
    {
      return strength_factor_;
    }

    /// Column `undrained shear strength`, Pa, of soil that has another one at
    /// each point; invalid_unsigned_int if no material does. Whoever makes
    /// points sets it.
    unsigned int
    undrained_strength() const
    {
      return undrained_strength_;
    }

    /// Least and largest value of that column in the soil of @p body; {1, 1} if
    /// its material has none. Collective.
    StrengthRange
    strength_range(const Points<dim> &points,
                   unsigned int       body,
                   MPI_Comm           communicator) const;

    /// Least MaterialModel::largest_strength_factor() of those that bodies are
    /// made of. Collective.
    double
    largest_strength_factor(const Points<dim> &points,
                            MPI_Comm           communicator) const;

    /// Advance deformation and stress of the points, whose workspace it is.
    void
    update_stress(Points<dim>              &points,
                  const StepWorkspace<dim> &workspace,
                  const Batch              &batch,
                  double                    dt) const;

    /// Call action(model, begin, end) for each run of points of the same
    /// material.
    template <typename Action>
    void
    for_each_material_range(const Points<dim> &points,
                            const Batch       &batch,
                            const Action      &action) const
    {
      const auto &segments = points.segments();
      for (unsigned int s = batch.first_segment; s < batch.last_segment;)
        {
          const unsigned int begin    = segments[s].begin;
          const unsigned int material = material_of_body_[segments[s].body];
          while (s < batch.last_segment &&
                 material_of_body_[segments[s].body] == material)
            ++s;
          action(*models_[material], begin, segments[s - 1].end);
        }
    }

  private:
    std::vector<MaterialName>                        names_;
    std::vector<std::string>                         listed_names_;
    std::vector<std::unique_ptr<MaterialModel<dim>>> models_;
    std::vector<unsigned int>                        material_of_body_;
    unsigned int strength_factor_    = dealii::numbers::invalid_unsigned_int;
    unsigned int undrained_strength_ = dealii::numbers::invalid_unsigned_int;
  };
} // namespace talus

#endif
