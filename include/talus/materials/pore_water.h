// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_pore_water_h
#define talus_materials_pore_water_h

#include <talus/materials/moduli.h>
#include <talus/points/points.h>
#include <talus/points/step_workspace.h>

#include <deal.II/base/parameter_acceptor.h>

#include <limits>
#include <string>
#include <vector>

namespace talus
{
  template <int dim>
  struct StressTangent;



  /// Pore water of a material. In drained soil water flows as the soil needs
  /// it. In undrained soil water and soil move together: the volume change of
  /// the soil compresses the water,
  ///   du = -K_f d(ln J),
  /// and the excess pore pressure u, Pa, follows. K_f is the bulk modulus of
  /// water over the porosity; a smaller one, from an undrained Poisson's ratio
  /// below 1/2, allows longer time steps.
  class PoreWater : public dealii::ParameterAcceptor
  {
  public:
    /// @p section of the material.
    explicit PoreWater(const std::string &section);

    /// Throw ExcUser if the water would have no stiffness beside soil of
    /// Poisson's ratio @p poisson_ratio.
    void
    check(double poisson_ratio) const;

    bool
    is_undrained() const
    {
      return drainage_ == "undrained";
    }

    /// K_f, Pa, beside soil with the bulk modulus @p bulk, Pa; 0 if drained:
    /// K_f = 3 (nu_u - nu)/((1 - 2 nu_u)(1 + nu)) K.
    double
    stiffness(double poisson_ratio, double bulk) const;

    /// Suction at which the water cavitates, Pa; infinite without a limit.
    double
    largest_suction() const
    {
      return largest_suction_.empty() ? std::numeric_limits<double>::infinity()
                                      : largest_suction_.front();
    }

    /// Coefficient of consolidation c_v, m^2/s; 0 if not given.
    double
    consolidation() const
    {
      return consolidation_.empty() ? 0. : consolidation_.front();
    }

  private:
    std::string drainage_                = "drained";
    double      undrained_poisson_ratio_ = 0.49;
    // Empty or one number.
    std::vector<double> stiffness_, largest_suction_, consolidation_;
  };



  /// How the excess pore pressure u of points answers to their volume.
  /// Undrained: du = -K_f d(ln J); below -@p largest_suction, Pa, the pressure
  /// stays and the volume is free. Drained: u is given, but where no effective
  /// stress is left a pressure above the total stress would blow the soil up:
  /// there expansion takes pressure away, du = -K d(ln J).
  template <int dim>
  struct WaterResponse
  {
    double stiffness; ///< K_f, Pa; 0: drained
    double largest_suction;
    double soil_bulk;          ///< K, Pa
    double consolidation = 0.; ///< c_v, m^2/s; 0: not known

    /// Advance the excess pore pressure of the points [begin, end) over a step
    /// of @p dt seconds with the velocity gradient in the workspace.
    void
    advance(Points<dim>              &points,
            const StepWorkspace<dim> &workspace,
            unsigned int              begin,
            unsigned int              end,
            double                    dt) const;

    /// Subtract the pressure at the end of a static load step from the
    /// effective stress of the points [begin, end) in @p linearization, and its
    /// derivative from the tangent. The workspace holds the displacement
    /// gradient. Without stiffness the pressure stays.
    void
    linearize(const Points<dim>        &points,
              const StepWorkspace<dim> &workspace,
              unsigned int              begin,
              unsigned int              end,
              StressTangent<dim>       *linearization) const;

    /// Set the pressure to that at the end of the load step.
    void
    commit_load_step(Points<dim>              &points,
                     const StepWorkspace<dim> &workspace,
                     unsigned int              begin,
                     unsigned int              end) const;
  };
} // namespace talus

#endif
