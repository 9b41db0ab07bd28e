// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_seabed_h
#define talus_boundaries_seabed_h

#include <talus/base/shear_stress_cap.h>
#include <talus/boundaries/boundary_condition.h>

#include <deal.II/base/parameter_acceptor.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// One-sided contact with Coulomb friction whose shear stress is capped, on a
  /// face of the mesh. The cap is the interface law of (@cite dong2017): soft
  /// soil cannot pass more shear to the seabed than its own remoulded strength.
  template <int dim>
  class Seabed : public dealii::ParameterAcceptor
  {
  public:
    Seabed();

    /// To be called after parsing. Throws ExcUser if the maximum shear stress
    /// cannot be understood.
    void
    prepare(const Constants &constants);

    /// Whether locate() must be called, and whether set_depth() before it.
    bool
    depends_on_place() const
    {
      return !cap_->number();
    }
    bool
    depends_on_depth() const
    {
      return cap_->depends_on_depth();
    }

    void
    set_depth(const typename ShearStressCap<dim>::Depth &depth)
    {
      cap_->set_depth(depth);
    }

    /// Find the maximum shear stress at the nodes of the seabed, those that
    /// @p is_on_seabed says yes to; @p places of all owned ones, m.
    void
    locate(const std::vector<dealii::Point<dim>>        &places,
           const std::function<bool(unsigned int node)> &is_on_seabed);

    /// Change the velocity of @p node on @p face after a step of @p dt: where
    /// it would move into the seabed, its normal velocity becomes zero with the
    /// force N = m |v_n|/dt, and friction of at most
    /// min(m |v_t|/dt, mu N, tau_max A) acts against the tangential velocity.
    /// Soil that moves away is free, and so is soil that does not cover @p gap,
    /// m, in the step. Returns normal and tangential impulse, N s.
    /// A is the area in contact, see contact_area().
    std::pair<dealii::Tensor<1, dim>, dealii::Tensor<1, dim>>
    apply(NodalFields<dim> &nodes,
          const Grid<dim>  &grid,
          unsigned int      face,
          unsigned int      node,
          double            dt,
          double            gap = 0.) const;

    /// Whether contact waits until the boxes of the points have come to the
    /// face. Else a node feels the seabed as soon as it carries soil, which may
    /// be a cell above.
    bool
    has_gap() const
    {
      return has_gap_;
    }

    /// Largest friction force on soil that is pressed onto @p area, m^(dim-1),
    /// at @p node with @p normal_force, N.
    double
    largest_friction(const unsigned int node,
                     const double       normal_force,
                     const double       area) const
    {
      return std::min(friction_factor_ * friction_coefficient_ * normal_force,
                      factor_ * maximum_shear_stress(node) * area);
    }

    /// From now on pass @p factor times the maximum shear stress [-].
    void
    scale_maximum_shear_stress(const double factor)
    {
      factor_ = factor;
    }

    /// From now on use @p factor times the friction coefficient [-].
    void
    scale_friction_coefficient(const double factor)
    {
      friction_factor_ = factor;
    }

  private:
    /// At a node, Pa.
    double
    maximum_shear_stress(const unsigned int node) const
    {
      const auto &number = cap_->number();
      return number ? *number : cap_of_node_[node];
    }

    double friction_factor_ = 1.;
    double factor_          = 1.; ///< of the maximum shear stress

    // Parameters
    double      friction_coefficient_      = 10.;
    std::string maximum_shear_stress_text_ = "1000";
    bool        has_gap_                   = false;

    std::unique_ptr<ShearStressCap<dim>> cap_;         ///< Pa
    std::vector<double>                  cap_of_node_; ///< Pa, if they differ
  };



  /// A face of the mesh that is a seabed. All such faces are the same Seabed.
  template <int dim>
  class SeabedCondition : public BoundaryCondition<dim>
  {
  public:
    explicit SeabedCondition(const FaceDescription<dim> &description)
      : BoundaryCondition<dim>(description)
      , seabed_(description.seabed)
    {}

    bool
    depends_on_place() const override
    {
      return seabed_.depends_on_place();
    }

    bool
    is_one_sided() const override
    {
      return true;
    }

    std::pair<dealii::Tensor<1, dim>, dealii::Tensor<1, dim>>
    apply_contact(NodalFields<dim>  &nodes,
                  const Grid<dim>   &grid,
                  const unsigned int node,
                  const double       dt,
                  const double       gap) const override
    {
      return seabed_.apply(nodes, grid, this->face(), node, dt, gap);
    }

  private:
    const Seabed<dim> &seabed_;
  };
} // namespace talus

#endif
