#include <talus/base/errors.h>
#include <talus/boundaries/boundaries.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    FaceCondition
    condition_by_name(const std::string &name)
    {
      return name == "roller"     ? FaceCondition::roller
             : name == "fixed"    ? FaceCondition::fixed
             : name == "seabed"   ? FaceCondition::seabed
             : name == "periodic" ? FaceCondition::periodic
                                  : FaceCondition::free;
    }
  } // namespace



  template <int dim>
  Boundaries<dim>::Boundaries()
    : ParameterAcceptor("/Boundaries")
  {
    names_.fill("free");
    conditions_.fill(FaceCondition::free);
    for (unsigned int face = 0; face < 2 * dim; ++face)
      add_parameter(
        face_names[face],
        names_[face],
        "Condition on this face of the mesh: 'free' (a point that crosses it "
        "has left, which is an error), 'roller' (no motion along the normal), "
        "'fixed' (no motion), 'seabed' (contact with friction, see the "
        "section Seabed) or 'periodic' (what leaves here enters through the "
        "opposite face, which must be periodic, too). In 3-D there are Back "
        "(lower z) and Front (upper z), "
        "too.",
        this->prm,
        Patterns::Selection("free|roller|fixed|seabed|periodic"));
    parse_parameters_call_back.connect([this]() {
      for (unsigned int face = 0; face < 2 * dim; ++face)
        conditions_[face] = condition_by_name(names_[face]);
    });
  }



  template <int dim>
  std::array<bool, dim>
  Boundaries<dim>::periodic_axes() const
  {
    std::array<bool, dim> axes;
    for (unsigned int face = 0; face < 2 * dim; ++face)
      {
        const unsigned int opposite = face ^ 1;
        axes[face / 2] = (conditions_[face] == FaceCondition::periodic);
        AssertThrow(!axes[face / 2] ||
                      conditions_[opposite] == FaceCondition::periodic,
                    ExcUser("The face '" + face_names[face] +
                            "' is periodic, but the opposite one is not: "
                            "'Boundaries/" +
                            face_names[opposite] + "' is '" + names_[opposite] +
                            "'. Make both faces periodic or neither."));
      }
    return axes;
  }



  template <int dim>
  void
  Boundaries<dim>::apply_to_node(NodalFields<dim>  &nodes,
                                 const Grid<dim>   &grid,
                                 const unsigned int node,
                                 const double       dt,
                                 BoundaryWork<dim> &work) const
  {
    const unsigned char faces = grid.faces_of_node(node);
    Tensor<1, dim>      contact, friction, wall;
    const auto          for_faces_with = [&](const FaceCondition condition,
                                    const auto         &action) {
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if ((faces & (1u << face)) && conditions_[face] == condition)
          action(face);
    };
    bool is_fixed = false;
    for_faces_with(FaceCondition::fixed,
                   [&](const unsigned int) { is_fixed = true; });
    if (is_fixed)
      wall += nodes.set_velocity(node, Tensor<1, dim>());
    else
      {
        // Rollers first: what they hold must not use up the friction. The
        // seabed's impulses have no component along their normals.
        for_faces_with(FaceCondition::roller, [&](const unsigned int face) {
          Tensor<1, dim> velocity = nodes.velocity(node);
          velocity[face / 2]      = 0;
          wall += nodes.set_velocity(node, velocity);
        });
        for_faces_with(FaceCondition::seabed, [&](const unsigned int face) {
          const auto [normal, tangential] =
            seabed_.apply(nodes, grid, face, node, dt);
          contact += normal;
          friction += tangential;
        });
      }

    const Tensor<1, dim> v = nodes.mean_velocity(node);
    work.friction -= friction * v;
    work.contact -= (contact + wall) * v;
    work.seabed_impulse += contact + friction;
    work.wall_impulse += wall;
  }



  template <int dim>
  BoundaryWork<dim>
  Boundaries<dim>::apply(NodalFields<dim> &nodes,
                         const Grid<dim>  &grid,
                         const double      dt,
                         const double      least_mass) const
  {
    BoundaryWork<dim> work;
    for (const unsigned int node : nodes.active_boundary_nodes())
      if (nodes.mass(node) > least_mass)
        apply_to_node(nodes, grid, node, dt, work);
    return work;
  }



  template class Boundaries<2>;
  template class Boundaries<3>;
} // namespace talus
