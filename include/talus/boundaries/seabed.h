// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_seabed_h
#define talus_boundaries_seabed_h

#include <talus/base/shear_stress_cap.h>
#include <talus/boundaries/boundary_condition.h>
#include <talus/boundaries/interface_friction.h>
#include <talus/boundaries/normal_force_memory.h>

#include <deal.II/base/parameter_acceptor.h>

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// One-sided contact with friction on faces of the mesh, node by node.
  template <int dim>
  class Seabed : public dealii::ParameterAcceptor
  {
  public:
    Seabed();

    /// Read the maximum shear stress and check the parameters, after parsing.
    /// Throws ExcUser.
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

    /// Area of @p face that the boxes of points near it cover at @p node,
    /// m^(dim-1), as SeabedCoverage finds it; at most a little more than the
    /// node's share of the face. Until set_covered_area() boxes cover all.
    using CoveredArea =
      std::function<double(unsigned int face, unsigned int node)>;

    void
    set_covered_area(const CoveredArea &covered_area)
    {
      covered_area_ = covered_area;
    }

    /// Area of @p face in contact with soil at @p node, m^(dim-1).
    double
    contact_area(const NodalFields<dim> &nodes,
                 const Grid<dim>        &grid,
                 unsigned int            face,
                 unsigned int            node) const;

    /// Begin a step, before apply().
    void
    begin_step()
    {
      memory_.begin_step();
      area_in_contact_ = 0;
    }

    /// Area in which soil pressed on a seabed at the bottom of the mesh in the
    /// last step, on the nodes of this rank, m^(dim-1); 0 before the first step of
    /// a run or a resumed run.
    double
    area_in_contact() const
    {
      return area_in_contact_;
    }

    /// Change the velocity of @p node on @p face after a step of @p dt, s: where
    /// the node would move into the seabed, its normal velocity v_n becomes zero,
    /// which takes the force N = m v_n/dt. Friction, limited by the running mean
    /// of N, acts against the tangential velocity, also in steps in which the
    /// node moves away. Soil farther than @p gap, m, from the face than it moves
    /// in the step is free. Returns normal and tangential impulse, N s.
    std::pair<dealii::Tensor<1, dim>, dealii::Tensor<1, dim>>
    apply(NodalFields<dim> &nodes,
          const Grid<dim>  &grid,
          unsigned int      face,
          unsigned int      node,
          double            dt,
          double            gap = 0.);

    /// Whether contact waits until the boxes of the points have come to the
    /// face. Else a node feels the seabed as soon as it carries soil, which may
    /// be a cell above.
    bool
    has_gap() const
    {
      return has_gap_;
    }

    /// Largest friction force on soil at rest that is pressed onto @p area,
    /// m^(dim-1), at @p node with @p normal_force, N.
    double
    largest_friction(const unsigned int node,
                     const double       normal_force,
                     const double       area) const
    {
      return friction_.largest_force(normal_force,
                                     maximum_shear_stress(node),
                                     area);
    }

    InterfaceFriction &
    friction()
    {
      return friction_;
    }

    /// Find the nodes of @p faces (bit f for face f), after each change of the
    /// mesh or its partition. Collective.
    void
    prepare_nodes(const Grid<dim> &grid, const unsigned char faces)
    {
      memory_.prepare(grid, faces);
    }

    void
    list_state(StateList &list)
    {
      memory_.list_state(list);
    }

  private:
    /// At a node, Pa.
    double
    maximum_shear_stress(const unsigned int node) const
    {
      const auto &number = cap_->number();
      return number ? *number : cap_of_node_[node];
    }

    // Parameters
    std::string maximum_shear_stress_text_ = "1000";
    bool        has_gap_                   = false;

    InterfaceFriction      friction_;
    NormalForceMemory<dim> memory_;
    CoveredArea            covered_area_ = [](unsigned int, unsigned int) {
      return std::numeric_limits<double>::max();
    };
    double                               area_in_contact_ = 0; ///< m^(dim-1)
    std::unique_ptr<ShearStressCap<dim>> cap_;                 ///< Pa
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
                  const double       gap) override
    {
      return seabed_.apply(nodes, grid, this->face(), node, dt, gap);
    }

  private:
    Seabed<dim> &seabed_;
  };
} // namespace talus

#endif
