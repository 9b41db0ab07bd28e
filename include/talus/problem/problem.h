// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_problem_h
#define talus_problem_problem_h

#include <talus/boundaries/boundaries.h>
#include <talus/boundaries/damping.h>
#include <talus/contact/facet_contact.h>
#include <talus/contact/seabed_coverage.h>
#include <talus/interaction/nodal_interactions.h>
#include <talus/problem/bodies.h>
#include <talus/problem/inputs.h>
#include <talus/problem/loading.h>
#include <talus/problem/parameter_preview.h>
#include <talus/problem/trigger.h>
#include <talus/state/state.h>
#include <talus/water/water.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <string>
#include <vector>

namespace talus
{
  /// What is simulated: bodies of soil and what they are made of, what bounds
  /// and loads them, and what sets them in motion.
  template <int dim>
  class Problem : public dealii::ParameterAcceptor
  {
  public:
    explicit Problem(const ParameterPreview &preview);

    /// To be called after parsing. Throws ExcUser if parameters contradict each
    /// other. Declares the columns that laws and trigger need, and that of the
    /// strength factor also if somebody else @p changes_strength. @p origin of the
    /// mesh on the map: easting, northing, height, m.
    void
    prepare(Points<dim>            &points,
            bool                    changes_strength,
            double                  end_time,
            const dealii::Point<3> &origin);

    /// Open the accounts of all that exchanges energy with the soil; to be called
    /// after prepare().
    void
    open_accounts(Accounts<dim> &accounts)
    {
      interactions.open_accounts(accounts);
      accounts.open_energy("gravity work", Accounts<dim>::EnergyKind::supplied);
    }

    /// Fill the bodies with points and set all they start with. Points are in
    /// no order then. Collective.
    void
    create_points(State<dim> &state);

    /// Bodies of soil at the start.
    const Bodies<dim> &
    bodies() const
    {
      return bodies_;
    }

    /// Set the velocities that the points start with to those of time @p t, s.
    void
    set_velocity(Points<dim> &points, const double t) const
    {
      bodies_.set_velocity(points, t, inputs_.constants);
    }

    /// Whether each face of the mesh may be moved outwards: those that are free,
    /// and not of outflow.
    std::array<bool, 2 * dim>
    faces_that_may_move() const;

    /// The least of the bodies, kg/m^3.
    double
    min_density() const;

    /// For which bodies the dilatation is averaged over the cells.
    std::vector<bool>
    bodies_with_bbar() const;

    /// Whether a body is made of a hyperelastic law.
    bool
    has_hyperelastic_body() const;

    /// Whether soil can slide on something: a face that is a seabed, or an
    /// obstacle.
    bool
    has_seabed() const
    {
      return boundaries.has_seabed() || !obstacles.empty();
    }

    /// From now on all that resists sliding there is @p factor times its
    /// parameter [-].
    void
    scale_seabed_strength(const double factor)
    {
      boundaries.scale_seabed_strength(factor);
      obstacles.scale_strength(factor);
    }

    /// When loads and strengths stop to change in time, s; infinity if an
    /// obstacle moves, or where walls or tractions follow expressions.
    double
    time_of_last_change() const;

    /// Sentences for the log at the start of a run: what follows from the
    /// parameters, as meant.
    std::vector<std::string>
    facts() const;

    /// Sentences on what the user may not have meant, or what the results
    /// suffer from, on cells of @p cell_size m. To be called after
    /// create_points().
    std::vector<std::string>
    remarks(double cell_size) const;

    /// Find what depends on cells and nodes; to be called after each change of
    /// the mesh or its partition. Collective.
    void
    locate(const Grid<dim> &grid)
    {
      find_mudline(grid);
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
      loading.list_state(list);
      obstacles.list_state(list);
      interactions.list_state(list);
    }

  private:
    void
    add_remarks(const std::vector<std::string> &remarks);
    void
    look_at_geometry(const State<dim> &state);
    void
    find_mudline(const Grid<dim> &grid);

    Inputs<dim>              inputs_;
    Bodies<dim>              bodies_;
    std::vector<std::string> remarks_; ///< on the initial state

  public:
    // The parts, for those who work with them.
    Materials<dim> materials;
    Obstacles<dim> obstacles;
    Loading<dim>   loading;
    Trigger<dim>   trigger;

    /// Everything that acts at the nodes; the references below lead to those
    /// members of the list that other parts of the program ask by themselves.
    NodalInteractions<dim> interactions;
    Boundaries<dim>       &boundaries;
    SeabedCoverage<dim>   &seabed_coverage;
    FacetContact<dim>     &contact; ///< with the obstacles
    Damping<dim>          &damping;
    Water<dim>            &water;
  };
} // namespace talus

#endif
