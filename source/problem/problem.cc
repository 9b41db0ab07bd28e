// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/contact/obstacle_remarks.h>
#include <talus/contact/obstacle_sizes.h>
#include <talus/contact/seabed_gaps.h>
#include <talus/problem/bottom_of_mesh.h>
#include <talus/problem/geostatic.h>
#include <talus/problem/layer_surfaces.h>
#include <talus/problem/problem.h>
#include <talus/problem/strength_field.h>
#include <talus/problem/surface_weakening.h>
#include <talus/transfer/send_to_owners.h>

#include <algorithm>
#include <iterator>

namespace talus
{
  using namespace dealii;

  /// Names of bodies and materials must be known before the parameters are
  /// declared, as each has a section of its own: they come from the tolerant
  /// first pass over the parameter file.
  template <int dim>
  Problem<dim>::Problem(const ParameterPreview &preview)
    : ParameterAcceptor("/")
    , folder_(preview.folder)
    , surfaces_(preview.surfaces)
    , remarks_(preview.remarks)
    , materials(preview.materials)
    , obstacles(preview.obstacles)
    , loading(preview.folder)
    , boundaries(interactions.template add<Boundaries<dim>>())
    , seabed_coverage(
        interactions.template add<SeabedCoverage<dim>>(boundaries))
    , contact(
        interactions.template add<FacetContact<dim>>(obstacles, boundaries))
    , damping(interactions.template add<Damping<dim>>(boundaries,
                                                      contact.feels_obstacle()))
    , water(interactions.template add<Water<dim>>(materials, contact))
  {
    interactions.template add<SeabedGaps<dim>>(boundaries);
    interactions.template add<SurfaceWeakening<dim>>(trigger,
                                                     boundaries,
                                                     obstacles);

    for (const std::string &name : preview.bodies)
      bodies_.push_back(std::make_unique<Body<dim>>(name));
    add_parameter(
      "Initial velocity time",
      initial_velocity_time_,
      "Velocities live between the steps. 'start': take the initial "
      "velocity at t = 0; 'half step': at t = -dt/2, which keeps "
      "second order where the acceleration is not zero at the "
      "start.",
      this->prm,
      Patterns::Selection("start|half step"));
    enter_subsection("Bodies");
    add_parameter(
      "Names",
      listed_names_,
      "Names of the bodies, separated by commas; each has a section "
      "of that name.");
    leave_subsection();
  }



  /// What follows from the parameters alone, before there is a mesh; a resumed
  /// run goes through it, too. The order: laws are given to bodies, the trigger
  /// is checked against them, and then columns are added, which must be all
  /// there before the first point is.
  template <int dim>
  void
  Problem<dim>::prepare(Points<dim>    &points,
                        const bool      changes_strength,
                        const double    end_time,
                        const Point<3> &origin)
  {
    constants_.values(); // throws, also where no expression needs them
    surfaces_.prepare(constants_, folder_, origin);
    for (const auto &body : bodies_)
      body->use_surfaces(surfaces_);
    const std::vector<std::string> names = names_of_bodies();
    std::vector<std::string>       materials_of_bodies;
    for (const auto &body : bodies_)
      materials_of_bodies.push_back(body->material());
    materials.assign(names, materials_of_bodies);
    strength_tables_ = tables_of_strength(materials, bodies_.size(), folder_);
    trigger.check(names,
                  materials,
                  boundaries.has_seabed() || obstacles.limit_shear_stress(),
                  end_time);
    // The strength factor is a column only if somebody changes strengths.
    materials.add_columns(points,
                          trigger.changes_strength() || changes_strength);
    trigger.add_columns(points);
    loading.prepare(materials, bodies_.size(), constants_, end_time);
    boundaries.parse(constants_);
    obstacles.prepare(constants_, &surfaces_);
  }



  /// Body by body, as columns of a body depend on its law. Strength and K0
  /// stress come after the last body: they need the depth below, and the weight
  /// of, all. Displaced points
  /// and those of clipped bodies may have left the cells of their rank, and go
  /// to their owners. The trigger chooses its points at the end, by the
  /// undeformed places. Collective.
  template <int dim>
  void
  Problem<dim>::create_points(State<dim> &state)
  {
    Points<dim> &points = state.points;
    for (unsigned int b = 0; b < bodies_.size(); ++b)
      {
        const MaterialModel<dim> &material = materials.of_body(b);
        const InitialState<dim>  &initial  = bodies_[b]->initial_state();
        const unsigned int        begin    = points.size();
        initial.check(material);
        add_remarks(
          {check_layer_surfaces(*bodies_[b],
                                state.grid.domain_before_growth(),
                                state.grid.cell_size()),
           bodies_[b]->create_points(
             state.grid, b, material.density(), points, obstacles.shapes())});
        // At t = 0; set_velocity() sets it anew where it belongs to half a step
        // before.
        initial.set_velocity(points, b, 0., constants_);
        initial.deform(points,
                       begin,
                       points.size(),
                       material,
                       state.constants.box_shape.rule,
                       constants_);
        material.initialize(points, begin, points.size());
      }
    set_undrained_strength(points,
                           bodies_,
                           materials,
                           constants_,
                           folder_,
                           state.grid.domain_before_growth(),
                           state.communicator());
    add_remarks(
      set_geostatic_stress(points,
                           bodies_,
                           materials,
                           loading.share_of_gravity(0.) * loading.gravity(),
                           Ground<dim>(state.grid.domain(), &obstacles),
                           state.communicator()));
    look_at_geometry(state);
    if (std::any_of(bodies_.begin(), bodies_.end(), [](const auto &body) {
          return body->initial_state().is_displaced() || body->is_clipped();
        }))
      send_points_to_owners(points, state.grid);
    trigger.choose_points(points, constants_, state.communicator());
  }



  /// Empty ones are left out.
  template <int dim>
  void
  Problem<dim>::add_remarks(const std::vector<std::string> &remarks)
  {
    std::copy_if(remarks.begin(),
                 remarks.end(),
                 std::back_inserter(remarks_),
                 [](const std::string &remark) { return !remark.empty(); });
  }



  /// Bodies and obstacles against each other and against the cells. Collective.
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
      {
        has_strength |= materials.of_body(b).has_strength();
        const Box<dim> box = bodies_[b]->bounding_box(domain);
        from               = std::min(from, box.lower[0]);
        to                 = std::max(to, box.upper[0]);
      }
    if (has_strength)
      add_remarks(notes_on_uncapped_beds(obstacles));
    add_remarks(surfaces_.notes_on_rising(from, to));
    thickness_of_bodies_ = measure_thickness(state.points, bodies_, state.grid);
    add_remarks(notes_on_thickness(thickness_of_bodies_));
    // Face 2 is the bottom, in both dimensions.
    if (boundaries.is_free(2))
      add_remarks({note_on_bottom(obstacles, domain, state.grid.cell_size())});
  }



  /// From the parameters alone, so that a resumed run has the same.
  template <int dim>
  void
  Problem<dim>::find_mudline(const Grid<dim> &grid)
  {
    if (mudline_)
      return;
    mudline_ = std::make_shared<const Mudline<dim>>(
      mudline_of(bodies_, grid.domain_before_growth()));
    if (!obstacles.depend_on_depth() && !boundaries.seabed().depends_on_depth())
      return;
    const auto depth = [mudline = mudline_](const Point<dim> &x) {
      return mudline->depth(x);
    };
    obstacles.set_depth(depth);
    boundaries.set_depth(depth);
  }



  template <int dim>
  std::function<double(const Point<dim> &)>
  Problem<dim>::mudline() const
  {
    if (std::any_of(bodies_.begin(), bodies_.end(), [](const auto &body) {
          return body->initial_state().is_displaced();
        }))
      return {};
    return
      [mudline = mudline_](const Point<dim> &x) { return mudline->height(x); };
  }



  /// For velocities of the time @p t, s.
  template <int dim>
  void
  Problem<dim>::set_velocity(Points<dim> &points, const double t) const
  {
    for (unsigned int b = 0; b < bodies_.size(); ++b)
      bodies_[b]->initial_state().set_velocity(points, b, t, constants_);
  }



  /// A free face holds nothing, so it may lie farther out than asked for. At a
  /// face of outflow the place says which soil is counted.
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
    return std::max(trigger.end_time(), loading.time_of_last_change());
  }



  /// From this the mass follows below which a node carries nothing.
  template <int dim>
  double
  Problem<dim>::min_density() const
  {
    double result = materials.of_body(0).density();
    for (unsigned int b = 1; b < bodies_.size(); ++b)
      result = std::min(result, materials.of_body(b).density());
    return result;
  }



  /// In the order of their numbers, as the column "body" of the points has
  /// them.
  template <int dim>
  std::vector<std::string>
  Problem<dim>::names_of_bodies() const
  {
    std::vector<std::string> names;
    for (const auto &body : bodies_)
      names.push_back(body->name());
    return names;
  }



  /// Where the mesh must be fine before there are points.
  template <int dim>
  std::vector<Box<dim>>
  Problem<dim>::bounding_boxes(const Box<dim> &domain) const
  {
    std::vector<Box<dim>> boxes;
    for (const auto &body : bodies_)
      boxes.push_back(body->bounding_box(domain));
    return boxes;
  }



  /// By the number of the body. The transfer gets this and no law: the two
  /// rooms do not know each other.
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
  bool
  Problem<dim>::has_hyperelastic_body() const
  {
    for (unsigned int b = 0; b < bodies_.size(); ++b)
      if (materials.of_body(b).is_hyperelastic())
        return true;
    return false;
  }



  template <int dim>
  std::vector<std::string>
  Problem<dim>::facts() const
  {
    std::vector<std::string> result = surfaces_.notes();
    if (const std::string note = trigger.note(); !note.empty())
      result.push_back(note);
    const auto on_obstacles = obstacles.facts();
    result.insert(result.end(), on_obstacles.begin(), on_obstacles.end());
    return result;
  }



  /// The cell size, as softening depends on it.
  template <int dim>
  std::vector<std::string>
  Problem<dim>::remarks(const double cell_size) const
  {
    std::vector<std::string> result = remarks_;
    if (const std::string note = loading.note(); !note.empty())
      result.push_back(note);
    const auto on_materials = materials.notes(cell_size);
    result.insert(result.end(), on_materials.begin(), on_materials.end());
    const auto on_interactions = interactions.notes();
    result.insert(result.end(), on_interactions.begin(), on_interactions.end());
    return result;
  }



  template class Problem<2>;
  template class Problem<3>;
} // namespace talus
