// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_seabed_h
#define talus_boundaries_seabed_h

#include <talus/boundaries/bed.h>
#include <talus/boundaries/bed_slip.h>
#include <talus/boundaries/boundary_condition.h>
#include <talus/surface/place_table.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace talus
{
  /// Running mean of the normal force at a node of a seabed face, for the limit
  /// of friction (InterfaceFriction). A mean without update() in a step is
  /// dropped.
  struct MeanNormalForce
  {
    double force    = -1; ///< N; negative: no update() in this step
    double previous = -1; ///< N; negative: no update() in the previous step

    void
    begin_step()
    {
      previous = force;
      force    = -1;
    }

    /// Update the mean by the normal force of the step, @p current, N, with
    /// @p weight [-], and return the mean, N. After a step without update() the
    /// mean is @p current.
    double
    update(const double current, const double weight)
    {
      force =
        (previous < 0 ? current : previous + weight * (current - previous));
      return force;
    }

    // Row of a PlaceTable
    static constexpr unsigned int n_keys = 3;
    static constexpr const char  *columns =
      "key of the place of the node: upper and lower 32 bits; face; mean "
      "normal force [N]";

    bool
    is_kept() const
    {
      return force >= 0;
    }

    auto
    values()
    {
      return std::tie(force);
    }
  };



  /// One-sided contact with friction on faces of the mesh, node by node.
  template <int dim>
  class Seabed : public dealii::ParameterAcceptor
  {
  public:
    Seabed();

    /// Parse the maximum shear stress and check the parameters. Call after
    /// parsing. Throws ExcUser.
    void
    prepare(const Constants &constants);

    /// Whether places must be passed to prepare_nodes().
    bool
    depends_on_place() const
    {
      return bed_.depends_on_place() || keeps_slip();
    }
    /// Area of @p face at @p node covered by boxes of points, m^(dim-1), from
    /// FaceCoverage; may slightly exceed the node's share of the face. Until
    /// set_covered_area() everything counts as covered.
    using CoveredArea =
      std::function<double(unsigned int face, unsigned int node)>;

    void
    set_covered_area(const CoveredArea &covered_area)
    {
      covered_area_ = covered_area;
    }

    /// Share of the maximum shear stress [-] that a rule beyond slip and
    /// trigger leaves at an owned node of a face. Until set_share_left(): 1.
    using ShareLeft =
      std::function<double(unsigned int face, unsigned int node)>;

    void
    set_share_left(const ShareLeft &share_left)
    {
      share_left_ = share_left;
    }

    /// Area of @p face in contact with soil at @p node, m^(dim-1).
    double
    contact_area(const NodalFields<dim> &nodes,
                 const Grid<dim>        &grid,
                 unsigned int            face,
                 unsigned int            node) const;

    /// Begin a step. Call before apply(). Collective in the first step of a
    /// resumed run.
    void
    begin_step(MPI_Comm communicator);

    /// Whether slip() matters: the seabed softens, or the trigger has a region.
    bool
    keeps_slip() const
    {
      return bed_.softens() || slip_.has_region();
    }

    /// Slip of soil over the nodes.
    BedSlip<dim> &
    slip()
    {
      return slip_;
    }

    const BedSlip<dim> &
    slip() const
    {
      return slip_;
    }

    /// Number of the place of @p node on @p face, also in slip().
    unsigned int
    place_of(const unsigned int face, const unsigned int node) const
    {
      return place_of_[face].at(node);
    }

    /// Area on which soil pressed on a seabed at the bottom of the mesh in the
    /// last step, sum over the nodes of this rank, m^(dim-1); 0 before the
    /// first step of a run or a resumed run.
    double
    area_in_contact() const
    {
      return area_in_contact_;
    }

    /// Change the velocity of @p node on @p face after the momentum update of a
    /// step of @p dt, s. If the node moves into the seabed, its normal velocity
    /// v_n becomes zero by the force N = m v_n/dt. Friction, limited by the
    /// running mean of N, acts against the tangential velocity, also in steps
    /// in which the node moves away. @p gap: clearance between soil and face,
    /// m; soil that does not close the gap in the step is free. The slip of a
    /// softening seabed grows where friction is at the limit. Returns the
    /// normal and the tangential impulse on the soil, N s.
    std::pair<dealii::Tensor<1, dim>, dealii::Tensor<1, dim>>
    apply(NodalFields<dim> &nodes,
          const Grid<dim>  &grid,
          unsigned int      face,
          unsigned int      node,
          double            dt,
          double            gap = 0.);

    /// Whether contact begins when the boxes of points reach the face.
    /// Otherwise contact begins as soon as a node on the face carries soil, up
    /// to a cell above the face.
    bool
    has_gap() const
    {
      return has_gap_;
    }

    /// Limit of friction on soil at rest at @p node on @p face, for an area in
    /// contact, m^(dim-1).
    CoulombLimit
    limit(unsigned int face, unsigned int node, double area) const;

    Bed<dim> &
    bed()
    {
      return bed_;
    }

    const Bed<dim> &
    bed() const
    {
      return bed_;
    }

    /// List the nodes of @p faces (bit f for face f) and evaluate the maximum
    /// shear stress there. @p places: places of all owned nodes, m, if
    /// depends_on_place(). Call after each change of the mesh or its partition.
    /// Collective.
    void
    prepare_nodes(const Grid<dim>                       &grid,
                  unsigned char                          faces,
                  const std::vector<dealii::Point<dim>> &places);

    void
    list_state(StateList &list)
    {
      forces_.list_state("mean normal forces on the seabed", list);
      if (bed_.softens())
        slip_.list_state("slip of the seabed", list);
    }

  private:
    /// Maximum shear stress at a node, Pa.
    double
    maximum_shear_stress(const unsigned int node) const
    {
      return bed_.depends_on_place() ? cap_of_node_[node] : cap_;
    }

    // Parameters
    bool has_gap_ = true;

    Bed<dim> bed_;
    std::array<std::unordered_map<unsigned int, unsigned int>, 2 * dim>
                                place_of_; ///< place of a node, by face
    PlaceTable<MeanNormalForce> forces_;   ///< by place
    BedSlip<dim>                slip_;     ///< by place
    CoveredArea                 covered_area_ = [](unsigned int, unsigned int) {
      return std::numeric_limits<double>::max();
    };
    ShareLeft           share_left_;
    double              area_in_contact_ = 0; ///< m^(dim-1)
    double              cap_ = 0;     ///< maximum shear stress if constant, Pa
    std::vector<double> cap_of_node_; ///< otherwise, Pa
  };



  /// Face of the mesh as a seabed. All seabed faces share a Seabed.
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
