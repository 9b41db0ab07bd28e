// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_problem_h
#define talus_problem_problem_h

#include <talus/boundaries/boundaries.h>
#include <talus/boundaries/damping.h>
#include <talus/contact/contact.h>
#include <talus/interaction/nodal_interactions.h>
#include <talus/problem/bodies.h>
#include <talus/problem/excess_pore_pressure.h>
#include <talus/problem/inputs.h>
#include <talus/problem/loading.h>
#include <talus/problem/parameter_preview.h>
#include <talus/problem/trigger.h>
#include <talus/state/state.h>
#include <talus/water/hydroplaning.h>
#include <talus/water/water.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <string>
#include <vector>

namespace talus
{
  /// Physical problem: bodies of soil with materials, boundaries and loads, and
  /// the trigger of the motion.
  template <int dim>
  class Problem : public dealii::ParameterAcceptor
  {
  public:
    explicit Problem(const ParameterPreview &preview);

    /// Prepare all parts; call after parsing. Declares the columns needed by
    /// laws and trigger. Throws ExcUser if parameters contradict each other.
    /// @param points get the columns
    /// @param changes_strength whether a further object needs the strength
    ///   factor
    /// @param end_time end of the run, s
    /// @param grid with its parameters, before the cells are made
    void
    prepare(Points<dim>     &points,
            bool             changes_strength,
            double           end_time,
            const Grid<dim> &grid);

    /// Open the accounts of all parts that exchange energy with the soil. Call
    /// after prepare().
    void
    open_accounts(Accounts<dim> &accounts)
    {
      interactions.open_accounts(accounts);
      accounts.open_energy("gravity work", Accounts<dim>::EnergyKind::supplied);
      if (pore_pressure.exists() || materials.are_undrained())
        accounts.open_energy("pore pressure work",
                             Accounts<dim>::EnergyKind::supplied);
      if (materials.are_undrained())
        accounts.open_stored_energy("water energy",
                                    [this](const Points<dim> &points) {
                                      return materials.water_energy(points);
                                    });
    }

    /// Fill the bodies with points and set the initial state. Points are
    /// unordered afterwards. Collective.
    void
    create_points(State<dim> &state);

    /// Bodies of soil at the start.
    const Bodies<dim> &
    bodies() const
    {
      return bodies_;
    }

    /// Set the initial velocities of the points to the velocities at time @p t,
    /// s.
    void
    set_velocity(Points<dim> &points, const double t) const
    {
      bodies_.set_velocity(points, t, inputs_.constants);
    }

    /// Return for each face of the mesh whether the face may be moved outwards:
    /// free faces without outflow.
    std::array<bool, 2 * dim>
    faces_that_may_move() const;

    /// Minimum density of the bodies, kg/m^3.
    double
    min_density() const;

    /// Return for each body whether the dilatation is averaged over the cells.
    std::vector<bool>
    bodies_with_bbar() const;

    /// Return whether soil can slide on a surface: a seabed face, or an
    /// obstacle.
    bool
    has_seabed() const
    {
      return boundaries.has_seabed() || !obstacles.empty();
    }

    /// All surfaces on which soil slides: the seabed, and the obstacles in
    /// their order.
    const std::vector<Bed<dim> *> &
    beds() const
    {
      return beds_;
    }

    /// Return whether the shear stress on a surface has a maximum: on a seabed
    /// face, or on an obstacle with the parameter.
    bool
    limits_shear_stress() const
    {
      return boundaries.has_seabed() ||
             std::any_of(beds_.begin() + 1, beds_.end(), [](const auto *bed) {
               return bed->limits_shear_stress();
             });
    }

    /// Multiply all resistance to sliding on beds() by @p factor [-], relative
    /// to the parameters.
    void
    scale_seabed_strength(const double factor)
    {
      for (Bed<dim> *const bed : beds_)
        bed->scale_strength(factor);
    }

    /// Time after which loads and strengths are constant, s; infinity if an
    /// obstacle moves, or if walls or tractions follow expressions.
    double
    time_of_last_change() const;

    /// Return sentences for the log at the start of a run: intended
    /// consequences of the parameters.
    std::vector<std::string>
    facts() const;

    /// Return remarks on possible mistakes in the input, and on impairments of
    /// the results, for cells of @p cell_size, m. Call after create_points().
    std::vector<Remark>
    remarks(double cell_size) const;

    /// Update all data that depend on cells and nodes. Call after each change
    /// of the mesh or of the partition. Collective.
    void
    locate(const Grid<dim> &grid)
    {
      find_mudline(grid);
      materials.use_cell_size(grid.cell_size());
      interactions.prepare(grid);
    }

    const Surfaces<dim> &
    surfaces() const
    {
      return inputs_.surfaces;
    }

    /// Easting, northing and height of the mesh's origin on the map, m.
    const dealii::Point<3> &
    origin() const
    {
      return inputs_.surfaces.origin();
    }

    void
    list_state(StateList &list)
    {
      inputs_.list_state(list);
      materials.list_state(list);
      loading.list_state(list);
      obstacles.list_state(list);
      interactions.list_state(list);
    }

    /// Append remarks for the start of the log.
    template <typename List>
    void
    add_remarks(const List &remarks)
    {
      remarks_.insert(remarks_.end(), remarks.begin(), remarks.end());
    }

  private:
    void
    set_strength_and_stress(State<dim> &state);
    void
    set_pore_pressure(State<dim> &state) const;
    void
    look_at_geometry(const State<dim> &state);
    void
    find_mudline(const Grid<dim> &grid);

    Inputs<dim>             inputs_;
    Bodies<dim>             bodies_;
    std::vector<Remark>     remarks_; ///< remarks on the initial state
    std::vector<Bed<dim> *> beds_;

  public:
    // Parts of the problem, for direct use.
    Materials<dim>          materials;
    Obstacles<dim>          obstacles;
    Loading<dim>            loading;
    Trigger<dim>            trigger;
    ExcessPorePressure<dim> pore_pressure;

    /// All interactions at the nodes; the references below lead to members of
    /// the list that are used directly.
    NodalInteractions<dim> interactions;
    Boundaries<dim>       &boundaries;
    Contact<dim>          &contact; ///< contact with obstacles
    Damping<dim>          &damping;
    Water<dim>            &water;
    Hydroplaning<dim>     &hydroplaning;
  };
} // namespace talus

#endif
