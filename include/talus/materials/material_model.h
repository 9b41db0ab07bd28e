// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_material_model_h
#define talus_materials_material_model_h

#include <talus/base/remark.h>
#include <talus/base/state_list.h>
#include <talus/materials/pore_water.h>
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
  /// Stress at the end of a quasi-static load step, and its derivative.
  template <int dim>
  struct StressTangent
  {
    /// Cauchy stress, row by row, Pa.
    std::array<double, dim * dim> stress;
    /// Derivative of the stress by the displacement gradient H of the step, Pa.
    std::array<std::array<double, dim * dim>, dim * dim> tangent;
  };



  /// Constitutive law with the parameters of one material. Laws work on batches
  /// of points, [begin, end) in the sorted order, and know nothing of weights
  /// and nodes.
  template <int dim>
  class MaterialModel : public dealii::ParameterAcceptor
  {
  public:
    /// Declare the common parameters of a material in @p section of the
    /// parameter file, for example "/Materials/clay".
    MaterialModel(const std::string &section);

    virtual ~MaterialModel() = default;

    /// Throw ExcUser, naming the section, if parameters contradict each other.
    /// Called once, after parsing. Overrides must call the base version.
    virtual void
    check() const;

    /// Declare the law's internal variables as columns of the points.
    virtual void
    add_columns(Points<dim> & /*points*/)
    {}

    /// Set the columns of new points that describe the reference state: the
    /// strength factor, if used, to 1, and the deformation gradient, if the law
    /// needs it, to I. Overrides must call the base version.
    virtual void
    initialize(Points<dim> &points, unsigned int begin, unsigned int end) const;

    /// Static version of has_strength().
    static constexpr bool is_plastic = false;

    /// Return whether the law has a strength, that is a yield stress.
    virtual bool
    has_strength() const
    {
      return false;
    }

    /// Largest shear stress sqrt(s:s/2) that point @p p bears without viscosity
    /// in its current state, strength factor included, Pa; infinite without
    /// strength.
    virtual double
    shear_strength(const Points<dim> &points, unsigned int p) const;

    /// Shear stress sqrt(s:s/2) at point @p p over shear_strength() [-]: 1 if
    /// soil yields (at the critical state, where the law has one), more by
    /// viscosity; 0 without strength.
    double
    mobilized_strength(const Points<dim> &points, unsigned int p) const;

    /// Strength of undisturbed soil as given by the user; null for laws without
    /// the column `undrained shear strength`, to be set for new points.
    virtual const UndrainedStrength *
    undrained_strength() const
    {
      return nullptr;
    }

    /// Overconsolidation ratio as given by the user; null for laws without a
    /// preconsolidation pressure, to be set by consolidate() for new points.
    virtual const std::string *
    overconsolidation_ratio() const
    {
      return nullptr;
    }

    /// Set the preconsolidation pressure of point @p p from its effective
    /// stress, with @p vertical_stress, Pa, compression positive, and the
    /// overconsolidation @p ratio there. Returns the undrained shear strength
    /// that follows, Pa.
    virtual double
    consolidate(Points<dim> & /*points*/,
                unsigned int /*p*/,
                double /*vertical_stress*/,
                double /*ratio*/) const
    {
      return 0.;
    }

    /// Use the @p largest mean effective stress of the soil at the start, Pa,
    /// for the stiffness of the water.
    virtual void
    use_initial_pressure(double /*largest*/)
    {}

    /// Add the state of the law besides the columns of the points.
    virtual void
    list_state(StateList & /*list*/)
    {}

    /// Throw ExcUser if the law does not allow undrained shear strengths in the
    /// range.
    virtual void
    check_strength(const StrengthRange & /*range*/) const
    {}

    /// Largest allowed strength factor [-]: stronger softening soil would
    /// soften faster than it can unload elastically. Infinite without
    /// softening. @p range is the range of undrained shear strengths.
    virtual double
    largest_strength_factor(const StrengthRange & /*range*/) const
    {
      return std::numeric_limits<double>::infinity();
    }

    /// Return whether plastic flow reduces the strength.
    virtual bool
    softens() const
    {
      return false;
    }

    /// Fraction of the strength loss by softening that point @p p has suffered
    /// [-], from 0 to 1, at the residual strength.
    virtual double
    fraction_of_strength_loss(const Points<dim> & /*points*/,
                              unsigned int /*p*/) const
    {
      return 0.;
    }

    /// Return whether the law softens with the displacement across a shear band
    /// as wide as a cell. The law then has the column `cell size`, to be set
    /// before each step, see Materials::set_cell_sizes().
    virtual bool
    softens_by_displacement() const
    {
      return false;
    }

    /// Largest edge of cells with soil, m, for the limits of softening.
    void
    use_cell_size(const double largest)
    {
      largest_cell_size_ = largest;
    }

    /// Multiply the whole strength (not viscosity) of each point from now on by
    /// the value in @p column [-], between 0 and largest_strength_factor();
    /// ignored by laws without strength. The factor may change at any time: a
    /// stress then outside the yield surface is returned in the next step, and
    /// the elastic energy released becomes plastic work.
    void
    use_strength_factor(const unsigned int column)
    {
      strength_factor_ = column;
    }

    /// Advance edges, stress, elastic energy, plastic work and internal
    /// variables of the points [begin, end) over one step of @p dt seconds with
    /// the velocity gradient in the workspace. Throws ExcPoint if a point is
    /// inverted.
    virtual void
    update_stress(Points<dim>              &points,
                  const StepWorkspace<dim> &workspace,
                  unsigned int              begin,
                  unsigned int              end,
                  double                    dt) const = 0;

    // For the search for equilibrium, the workspace holds the displacement
    // gradient of a load step in place of the velocity gradient. The strain is
    // the symmetric part; points and boxes stay. Laws with a rate-dependent
    // stress take the limit of zero rate. Laws with is_hyperelastic(), whose
    // stress follows from the deformation, take no load steps.

    /// Compute the stress of the points [begin, end) at the end of the load
    /// step and its derivative, stored in linearization[p - begin]; points do
    /// not change.
    virtual void
    linearize(const Points<dim> & /*points*/,
              const StepWorkspace<dim> & /*workspace*/,
              unsigned int /*begin*/,
              unsigned int /*end*/,
              StressTangent<dim> * /*linearization*/) const
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    /// Set stress, energies and internal variables of the points [begin, end)
    /// to the end of the load step.
    virtual void
    commit_load_step(Points<dim> & /*points*/,
                     const StepWorkspace<dim> & /*workspace*/,
                     unsigned int /*begin*/,
                     unsigned int /*end*/) const
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    /// Largest shear modulus of the undeformed material at the points
    /// [begin, end), Pa.
    virtual double
    largest_shear_modulus(const Points<dim> &points,
                          unsigned int       begin,
                          unsigned int       end) const = 0;

    /// Compute the modulus M = rho c^2 of the fastest wave at the points
    /// [begin, end), Pa, with wave speed c and current density rho; stored in
    /// modulus[p - begin].
    virtual void
    wave_modulus(const Points<dim> &points,
                 unsigned int       begin,
                 unsigned int       end,
                 double            *modulus) const = 0;

    /// Speed of the fastest wave at point @p p, m/s.
    double
    wave_speed(const Points<dim> &points, unsigned int p) const;

    /// Return whether the stress is a function of the deformation gradient,
    /// which is a column of the law, so that no initial stress can be
    /// prescribed.
    virtual bool
    is_hyperelastic() const = 0;

    /// Return whether cells would lock, so that B-bar is on by default.
    virtual bool
    is_nearly_incompressible() const = 0;

    /// Return the pore water; without stiffness if the soil is drained.
    virtual WaterResponse<dim>
    pore_water() const
    {
      return {0., 0., 0.};
    }

    /// Return whether the derivatives of linearize() are symmetric.
    virtual bool
    has_symmetric_tangent() const
    {
      return true;
    }

    /// Let plastic flow be normal to the yield surface, with the strength
    /// reduced by Davis' factor; see MohrCoulombFlow. Laws whose flow is normal
    /// anyway do nothing.
    virtual void
    use_associated_flow(bool /*is_associated*/)
    {}

    /// Return a remark on the factor of safety, if plastic flow is not normal
    /// to the yield surface; may be empty.
    virtual Remark
    note_on_safety() const
    {
      return "";
    }

    /// Return a remark on the material in cells of @p cell_size, m; may be
    /// empty.
    virtual Remark
    note(double /*cell_size*/) const
    {
      return "";
    }

    /// Return whether B-bar, the cell mean against locking, is on, by the
    /// parameter `Cell mean` or is_nearly_incompressible().
    bool
    uses_bbar() const;

    /// Density for inertia, kg/m^3.
    double
    density() const
    {
      return density_;
    }

    /// Density for weight, kg/m^3; equal to density() by default.
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

    /// Strength factor of point @p p [-]; 1 if not used.
    double
    strength_factor(const Points<dim> &points, const unsigned int p) const
    {
      return strength_factor_ == dealii::numbers::invalid_unsigned_int
               ? 1.
               : points.data(strength_factor_)[p];
    }

    /// See use_cell_size(), m.
    double
    largest_cell_size() const
    {
      return largest_cell_size_;
    }

  private:
    std::string section_;
    double      largest_cell_size_ = 0.;
    double      density_           = 1000.;
    // A single number, or empty if the parameter is not given.
    std::vector<double> submerged_density_;
    std::string         bbar_     = "auto";
    unsigned int strength_factor_ = dealii::numbers::invalid_unsigned_int;
  };

  /// Names of all laws as used in the parameter file, in the order of
  /// registration.
  template <int dim>
  std::vector<std::string>
  material_names();

  /// Names of the laws with strength, formatted for the end of a sentence:
  /// "'von Mises' or 'Bingham'".
  template <int dim>
  std::string
  names_of_laws_with_strength();

  /// Make the law @p name with its parameters declared in @p section. Throws
  /// ExcUser, listing the known laws, if the name is unknown.
  template <int dim>
  std::unique_ptr<MaterialModel<dim>>
  make_material(const std::string &name, const std::string &section);
} // namespace talus

#endif
