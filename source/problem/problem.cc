// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/contact/obstacle_remarks.h>
#include <talus/problem/bottom_of_mesh.h>
#include <talus/problem/geostatic.h>
#include <talus/problem/layer_ends.h>
#include <talus/problem/layer_surfaces.h>
#include <talus/problem/mudline.h>
#include <talus/problem/problem.h>
#include <talus/problem/stiffness.h>
#include <talus/problem/strength_field.h>
#include <talus/problem/surface_weakening.h>
#include <talus/transfer/send_to_owners.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  /// Names of bodies and materials must be known before the declaration of
  /// parameters, because each has a separate section: the names come from the
  /// tolerant first pass over the parameter file.
  template <int dim>
  Problem<dim>::Problem(const ParameterPreview &preview)
    : ParameterAcceptor("/")
    , inputs_(preview)
    , bodies_(preview.bodies)
    , remarks_(preview.remarks.begin(), preview.remarks.end())
    , materials(preview.materials)
    , obstacles(preview.obstacles)
    , loading(preview.folder)
    , boundaries(interactions.template add<Boundaries<dim>>())
    , contact(interactions.template add<Contact<dim>>(obstacles, boundaries))
    , damping(interactions.template add<Damping<dim>>(boundaries,
                                                      contact.feels_obstacle()))
    , water(interactions.template add<Water<dim>>(materials, contact))
    , hydroplaning(interactions.template add<Hydroplaning<dim>>(
        materials, water, boundaries, contact))
  {
    beds_.push_back(&boundaries.seabed());
    for (unsigned int k = 0; k < obstacles.size(); ++k)
      beds_.push_back(&obstacles[k].bed());
    interactions.template add<SurfaceWeakening<dim>>(trigger,
                                                     beds_,
                                                     contact.slip());
  }



  /// Consequences of the parameters alone, before there is a mesh; also called
  /// in a resumed run. Order: laws are assigned to bodies, the trigger is
  /// checked against the laws, and then columns are added. All columns must
  /// exist before the first point.
  template <int dim>
  void
  Problem<dim>::prepare(Points<dim>     &points,
                        const bool       changes_strength,
                        const double     end_time,
                        const Grid<dim> &grid)
  {
    inputs_.prepare(grid.origin(),
                    grid.box_of_parameters(),
                    grid.cell_size_of_parameters());
    bodies_.use_surfaces(inputs_.surfaces);
    const std::vector<std::string> names = bodies_.names();
    materials.assign(names, bodies_.names_of_materials());
    inputs_.tables =
      tables_of_strength(materials, bodies_.size(), inputs_.folder);
    trigger.check(names, materials, limits_shear_stress(), end_time);
    pore_pressure.check(names, end_time);
    for (const InputFile &table : pore_pressure.tables(inputs_.folder))
      inputs_.tables.push_back(table);
    pore_pressure.add_columns(points);
    // The strength factor is a column only if strengths change.
    materials.add_columns(points,
                          trigger.changes_strength() || changes_strength);
    trigger.add_columns(points);
    loading.prepare(materials, bodies_.size(), inputs_.constants, end_time);
    contact.slip().set_region(
      trigger.seabed_region(inputs_.constants, inputs_.surfaces.named()));
    boundaries.parse(inputs_.constants, &inputs_.surfaces);
    hydroplaning.check();
    obstacles.prepare(inputs_.constants, &inputs_.surfaces);
  }



  /// Body by body, as columns of a body depend on the law. Strength and K0
  /// stress come after the last body, because they need the depth below, and
  /// the weight of, all bodies. Displaced points and points of clipped bodies
  /// may have left the cells of the rank, and are sent to the owners. Finally
  /// the trigger chooses points by the undeformed places. Collective.
  template <int dim>
  void
  Problem<dim>::create_points(State<dim> &state)
  {
    Points<dim>         &points = state.points;
    const LayerSite<dim> site{state.grid.domain_before_growth(),
                              state.grid.cell_size(),
                              obstacles.shapes(),
                              faces_that_may_move()};
    for (unsigned int b = 0; b < bodies_.size(); ++b)
      {
        const MaterialModel<dim> &material = materials.of_body(b);
        const Body<dim>          &body     = *bodies_.list()[b];
        const InitialState<dim>  &initial  = body.initial_state();
        const unsigned int        begin    = points.size();
        initial.check(material);
        add_remarks(std::vector<Remark>{
          check_layer_surfaces(body, site.domain, site.cell_size),
          check_cut_by_mesh(body, site),
          note_on_free_end(bodies_.list(), b, site),
          body.create_points(
            state.grid, b, material.density(), points, site.solids)});
        // At t = 0; set_velocity() corrects the velocity for half a step before
        // the start.
        initial.set_velocity(points, b, 0., inputs_.constants);
        material.initialize(points, begin, points.size());
        initial.deform(points,
                       begin,
                       points.size(),
                       material,
                       state.constants.box_shape.rule,
                       inputs_.constants);
      }
    set_strength_and_stress(state);
    look_at_geometry(state);
    if (bodies_.may_leave_cells())
      send_points_to_owners(points, state.grid);
    trigger.choose_points(points,
                          inputs_.constants,
                          inputs_.surfaces.named(),
                          state.communicator());
    trigger.check_seabed_region(
      Utilities::MPI::sum(contact.slip().n_triggered(), state.communicator()));
  }



  /// The K0 stress needs the pressure, and the preconsolidation pressure the
  /// stress. Collective.
  template <int dim>
  void
  Problem<dim>::set_strength_and_stress(State<dim> &state)
  {
    Points<dim> &points = state.points;
    set_undrained_strength(points,
                           bodies_.list(),
                           materials,
                           inputs_,
                           state.grid.domain_before_growth(),
                           state.communicator());
    set_pore_pressure(state);
    set_geostatic_stress(points,
                         bodies_.list(),
                         materials,
                         loading.share_of_gravity(0.) * loading.gravity(),
                         Ground<dim>(state.grid.domain(), &obstacles),
                         state.communicator());
    add_remarks(set_preconsolidation(
      state, bodies_.list(), materials, inputs_, loading.gravity()));
    auto on_stress = notes_on_stress_at_rest(points,
                                             bodies_.list(),
                                             materials,
                                             state.communicator());
    // Without a trigger a slide begins where the soil cannot bear its stress.
    for (Remark &remark : on_stress)
      if (trigger.end_time() <= 0. && pore_pressure.end_time() <= 0.)
        remark.severity = Severity::information;
    add_remarks(on_stress);
    if (loading.gravity().norm() > 0.)
      add_remarks(notes_on_undrained_soil(
        bodies_.list(),
        materials,
        pore_pressure.changes(0., std::numeric_limits<double>::max())));
  }



  /// Collective.
  template <int dim>
  void
  Problem<dim>::set_pore_pressure(State<dim> &state) const
  {
    Points<dim> &points = state.points;
    if (!points.have_pore_pressure())
      return;
    std::vector<double> density;
    for (unsigned int b = 0; b < bodies_.size(); ++b)
      density.push_back(materials.of_body(b).submerged_density());
    const auto overburden =
      normal_stress_at_rest(points,
                            density,
                            loading.gravity(),
                            Ground<dim>(state.grid.domain(), &obstacles),
                            state.communicator());
    std::copy(overburden.begin(),
              overburden.end(),
              points.data(points.overburden()));
    if (pore_pressure.exists())
      pore_pressure.set(points,
                        inputs_,
                        mudline_of(bodies_.list(),
                                   state.grid.domain_before_growth()),
                        state.communicator());
  }



  /// Check bodies and obstacles against each other and against the cells.
  /// Collective.
  template <int dim>
  void
  Problem<dim>::look_at_geometry(const State<dim> &state)
  {
    const Box<dim> domain = state.grid.domain_before_growth();
    add_remarks(obstacles.remarks());
    add_remarks(check_obstacle_sizes(obstacles, state.grid));
    add_remarks(notes_on_hidden_obstacles(obstacles, domain));
    bool   has_strength = false;
    double from = domain.upper[0], to = domain.lower[0]; // x of the soil
    for (unsigned int b = 0; b < bodies_.size(); ++b)
      has_strength |= materials.of_body(b).has_strength();
    for (const Box<dim> &box : bodies_.bounding_boxes(domain))
      {
        from = std::min(from, box.lower[0]);
        to   = std::max(to, box.upper[0]);
      }
    if (has_strength)
      add_remarks(notes_on_uncapped_beds(obstacles));
    add_remarks(inputs_.surfaces.notes_on_rising(from, to));
    // Without weight no slide shears in layers.
    const auto   on_thickness = bodies_.measure_thickness(state.points,
                                                        state.grid,
                                                        limits_shear_stress());
    const double gravity      = loading.gravity().norm();
    if (gravity > 0.)
      add_remarks(on_thickness);
    add_remarks(notes_on_stiffness(state.points,
                                   materials,
                                   bodies_.thickness(),
                                   gravity,
                                   state.communicator()));
    // Face 2 is the bottom in 2-D and 3-D.
    if (boundaries.is_free(2))
      add_remarks(std::vector<Remark>{
        note_on_bottom(obstacles, domain, state.grid.cell_size())});
  }



  /// From the parameters alone: a resumed run has the same mudline.
  template <int dim>
  void
  Problem<dim>::find_mudline(const Grid<dim> &grid)
  {
    const auto depth = bodies_.find_mudline(grid.domain_before_growth());
    if (depth)
      for (Bed<dim> *const bed : beds_)
        bed->set_depth(depth);
  }



  /// A free face carries no load, and may lie farther out than requested. The
  /// place of an outflow face decides which soil is counted.
  template <int dim>
  std::array<bool, 2 * dim>
  Problem<dim>::faces_that_may_move() const
  {
    std::array<bool, 2 * dim> result;
    for (unsigned int face = 0; face < 2 * dim; ++face)
      result[face] = boundaries.is_free(face) && !boundaries.is_outflow(face);
    return result;
  }



  template <int dim>
  double
  Problem<dim>::time_of_last_change() const
  {
    if (obstacles.move() || boundaries.has_expressions())
      return std::numeric_limits<double>::infinity();
    return std::max({trigger.end_time(),
                     pore_pressure.end_time(),
                     loading.time_of_last_change()});
  }



  /// The minimum mass of an active node follows from the minimum density.
  template <int dim>
  double
  Problem<dim>::min_density() const
  {
    double result = materials.of_body(0).density();
    for (unsigned int b = 1; b < bodies_.size(); ++b)
      result = std::min(result, materials.of_body(b).density());
    return result;
  }



  /// By the number of the body. The transfer gets only the flags: the rooms
  /// transfer and materials do not include each other.
  template <int dim>
  std::vector<bool>
  Problem<dim>::bodies_with_bbar() const
  {
    std::vector<bool> result;
    for (unsigned int b = 0; b < bodies_.size(); ++b)
      result.push_back(materials.of_body(b).uses_bbar());
    return result;
  }



  template <int dim>
  std::vector<std::string>
  Problem<dim>::facts() const
  {
    std::vector<std::string> result = inputs_.surfaces.notes();
    for (const std::string &note :
         {trigger.note(), pore_pressure.note(), loading.note()})
      if (!note.empty())
        result.push_back(note);
    const auto on_obstacles = obstacles.facts();
    result.insert(result.end(), on_obstacles.begin(), on_obstacles.end());
    return result;
  }



  /// The cell size is needed because softening depends on it.
  template <int dim>
  std::vector<Remark>
  Problem<dim>::remarks(const double cell_size) const
  {
    std::vector<Remark> result       = remarks_;
    const auto          on_materials = materials.notes(cell_size);
    result.insert(result.end(), on_materials.begin(), on_materials.end());
    const auto on_interactions = interactions.notes();
    result.insert(result.end(), on_interactions.begin(), on_interactions.end());
    return joined(result);
  }



  template class Problem<2>;
  template class Problem<3>;
} // namespace talus
