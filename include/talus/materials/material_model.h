// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_material_model_h
#define talus_materials_material_model_h

#include <talus/materials/undrained_strength.h>
#include <talus/points/points.h>
#include <talus/points/step_workspace.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// What is taken as the strain of a quasi-static load step.
  enum class StrainMeasure
  {
    small, ///< symmetric part of the displacement gradient; soil stays in place
    large  ///< that of the dynamics; soil, volumes and boxes follow
  };



  /// The stress at the end of a quasi-static load step and its derivative.
  template <int dim>
  struct StressTangent
  {
    /// First Piola-Kirchhoff stress seen from the start of the step, row by
    /// row, Pa; with small strain the Cauchy stress.
    std::array<double, dim * dim> stress;
    /// Its derivative by the displacement gradient H of the step, Pa.
    std::array<std::array<double, dim * dim>, dim * dim> tangent;
  };



  /// A constitutive law with the parameters of one material. Laws work on
  /// batches of points, [begin, end) in the sorted order; they see points and
  /// never a weight or a node.
  template <int dim>
  class MaterialModel : public dealii::ParameterAcceptor
  {
  public:
    /// @p section is the material's section in the parameter file, for example
    /// "/Materials/clay".
    MaterialModel(const std::string &section);

    virtual ~MaterialModel() = default;

    /// Throw ExcUser, naming the section, if parameters contradict each other.
    /// Called once, after parsing. Laws that override it call this one.
    virtual void
    check() const;

    /// Declare the law's internal variables as columns of the points.
    virtual void
    add_columns(Points<dim> & /*points*/)
    {}

    /// Set reference state dependent columns of newly made points: the
    /// strength factor, to 1, if there is one. Laws that override it call this
    /// one.
    virtual void
    initialize(Points<dim> &points, unsigned int begin, unsigned int end) const;

    /// The same as has_strength(), for those who have no object.
    static constexpr bool is_plastic = false;

    /// True if the law has a strength, that is a yield stress.
    virtual bool
    has_strength() const
    {
      return false;
    }

    /// Largest shear stress sqrt(s:s/2) that point @p p bears without viscosity
    /// in its present state, its strength factor included, Pa; infinite for
    /// laws without strength.
    virtual double
    shear_strength(const Points<dim> &points, unsigned int p) const;

    /// The strength of undisturbed soil as the user gave it, if the law has one.
    virtual const UndrainedStrength *
    undrained_strength() const
    {
      return nullptr;
    }

    /// True if the strength is another one at each point: then the law has the
    /// column `undrained shear strength`, which whoever makes points must set.
    bool
    has_strength_column() const
    {
      const UndrainedStrength *strength = undrained_strength();
      return strength != nullptr && !strength->is_number();
    }

    /// Throw ExcUser if the law cannot have undrained shear strengths in this
    /// range.
    virtual void
    check_strength(const StrengthRange & /*range*/) const
    {}

    /// What the strength may be multiplied by at most [-]: with more of it soil
    /// that softens would do so faster than it can unload elastically. Infinite
    /// for laws that do not soften. @p range of the strengths counts if
    /// has_strength_column().
    virtual double
    largest_strength_factor(const StrengthRange & /*range*/ = {1., 1.}) const
    {
      return std::numeric_limits<double>::infinity();
    }

    /// From now on multiply the whole strength (not viscosity) of each point by
    /// its value in @p column [-], from 0 to largest_strength_factor(); laws
    /// without strength ignore it. It may change at any time: a stress that
    /// is then outside the yield surface is returned in the next step, and what
    /// elastic energy this releases is plastic work.
    void
    use_strength_factor(const unsigned int column)
    {
      strength_factor_ = column;
    }

    /// Advance deformation gradient, stress, elastic energy, plastic work and
    /// internal variables over one step of @p dt seconds with the velocity
    /// gradient in the workspace. Throws ExcPoint if a point is turned
    /// inside out. With @p dt = 0 and any finite velocity gradient, a
    /// hyperelastic law sets stress and energy to those of the deformation
    /// gradient.
    virtual void
    update_stress(Points<dim>              &points,
                  const StepWorkspace<dim> &workspace,
                  unsigned int              begin,
                  unsigned int              end,
                  double                    dt) const = 0;

    // For the search for equilibrium. The workspace holds the displacement
    // gradient of a load step in the place of the velocity gradient. Laws whose stress
    // depends on the rate take the slowest one.

    /// Stress of the points at the end of the load step and its derivative,
    /// written to
    /// linearization[p - begin]; the points stay as they are. Returns false
    /// if a point would be turned inside out.
    virtual bool
    linearize(const Points<dim>        &points,
              const StepWorkspace<dim> &workspace,
              unsigned int              begin,
              unsigned int              end,
              StrainMeasure             measure,
              StressTangent<dim>       *linearization) const = 0;

    /// Make the end of the load step the state of the points: as
    /// update_stress(); with small strain the deformation gradient stays.
    virtual void
    commit_load_step(Points<dim>              &points,
                     const StepWorkspace<dim> &workspace,
                     unsigned int              begin,
                     unsigned int              end,
                     StrainMeasure             measure) const = 0;

    /// Shear modulus of the undeformed material, Pa.
    virtual double
    shear_modulus() const = 0;

    /// The largest of that at the points [begin, end), Pa.
    virtual double
    largest_shear_modulus(const Points<dim> & /*points*/,
                          unsigned int /*begin*/,
                          unsigned int /*end*/) const
    {
      return shear_modulus();
    }

    /// Modulus M = rho c^2 of the fastest wave at each point of the batch, c its
    /// speed and rho the present density, Pa; written to modulus[p - begin].
    virtual void
    wave_modulus(const Points<dim> &points,
                 unsigned int       begin,
                 unsigned int       end,
                 double            *modulus) const = 0;

    /// Speed of the fastest wave at point @p p, m/s.
    double
    wave_speed(const Points<dim> &points, unsigned int p) const;

    /// True if the stress is a function of the deformation gradient, so that an
    /// initial stress cannot be prescribed.
    virtual bool
    is_hyperelastic() const = 0;

    /// True if cells would lock, so that B-bar should be on unless the user
    /// decides.
    virtual bool
    is_nearly_incompressible() const = 0;

    /// What the user should know of the material on cells of @p cell_size
    /// metres before the run starts: whole sentences, or nothing.
    virtual std::string
    note(double /*cell_size*/) const
    {
      return "";
    }

    /// True if B-bar, the mean over cells against locking, is on: the parameter
    /// `Cell mean`, or is_nearly_incompressible().
    bool
    uses_bbar() const;

    /// Density that gives inertia, kg/m^3.
    double
    density() const
    {
      return density_;
    }

    /// Density that gives weight, kg/m^3; equal to density() unless set.
    double
    submerged_density() const;

    const std::string &
    section() const
    {
      return section_;
    }

  protected:
    /// Column of the strength factor, or invalid_unsigned_int.
    unsigned int
    strength_factor() const
    {
      return strength_factor_;
    }

    /// Strength factor of point @p p; 1 if there is none.
    double
    strength_factor(const Points<dim> &points, const unsigned int p) const
    {
      return strength_factor_ == dealii::numbers::invalid_unsigned_int
               ? 1.
               : points.data(strength_factor_)[p];
    }

  private:
    std::string section_;
    double      density_ = 1000.;
    // One number, or none where the user gave nothing.
    std::vector<double> submerged_density_;
    std::string         bbar_     = "auto";
    unsigned int strength_factor_ = dealii::numbers::invalid_unsigned_int;
  };

  /// The laws by the name used in the parameter file, in the order listed.
  template <int dim>
  std::vector<std::string>
  material_names();

  /// Of those, the laws that have a strength, as the end of a sentence asks for
  /// them: "'von Mises' or 'Bingham'".
  template <int dim>
  std::string
  names_of_laws_with_strength();

  /// Make the law @p name with its parameters declared in @p section. Throws
  /// ExcUser, listing the known laws, if there is none of that name.
  template <int dim>
  std::unique_ptr<MaterialModel<dim>>
  make_material(const std::string &name, const std::string &section);
} // namespace talus

#endif
