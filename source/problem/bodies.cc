// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/problem/bodies.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  // Each body has a section of parameters. The names are therefore needed
  // before the declaration, and come from the tolerant first pass over the
  // parameter file.
  template <int dim>
  Bodies<dim>::Bodies(const std::vector<std::string> &names)
    : ParameterAcceptor("/")
  {
    for (const std::string &name : names)
      list_.push_back(std::make_unique<Body<dim>>(name));
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
    add_parameter("Names",
                  listed_names_,
                  "Names of the bodies, separated by commas; each body has a "
                  "section of the same name.");
    leave_subsection();
  }



  template <int dim>
  void
  Bodies<dim>::use_surfaces(const SurfaceSource<dim> &surfaces)
  {
    for (const auto &body : list_)
      body->use_surfaces(surfaces);
  }



  template <int dim>
  std::vector<std::string>
  Bodies<dim>::names() const
  {
    std::vector<std::string> result;
    for (const auto &body : list_)
      result.push_back(body->name());
    return result;
  }



  template <int dim>
  std::vector<std::string>
  Bodies<dim>::names_of_materials() const
  {
    std::vector<std::string> result;
    for (const auto &body : list_)
      result.push_back(body->material());
    return result;
  }



  template <int dim>
  std::vector<Box<dim>>
  Bodies<dim>::bounding_boxes(const Box<dim> &domain) const
  {
    std::vector<Box<dim>> boxes;
    for (const auto &body : list_)
      boxes.push_back(body->bounding_box(domain));
    return boxes;
  }



  template <int dim>
  bool
  Bodies<dim>::are_displaced() const
  {
    return std::any_of(list_.begin(), list_.end(), [](const auto &body) {
      return body->initial_state().is_displaced();
    });
  }



  template <int dim>
  bool
  Bodies<dim>::may_leave_cells() const
  {
    return are_displaced() ||
           std::any_of(list_.begin(), list_.end(), [](const auto &body) {
             return body->is_clipped();
           });
  }



  template <int dim>
  void
  Bodies<dim>::set_velocity(Points<dim>     &points,
                            const double     t,
                            const Constants &constants) const
  {
    for (unsigned int b = 0; b < list_.size(); ++b)
      list_[b]->initial_state().set_velocity(points, b, t, constants);
  }



  // The mudline follows from the parameters alone: a resumed run computes the
  // same mudline.
  template <int dim>
  std::function<double(const Point<dim> &)>
  Bodies<dim>::find_mudline(const Box<dim> &domain)
  {
    if (mudline_)
      return {};
    mudline_ = std::make_shared<const Mudline<dim>>(mudline_of(list_, domain));
    return
      [mudline = mudline_](const Point<dim> &x) { return mudline->depth(x); };
  }



  template <int dim>
  std::function<double(const Point<dim> &)>
  Bodies<dim>::mudline() const
  {
    if (are_displaced())
      return {};
    return
      [mudline = mudline_](const Point<dim> &x) { return mudline->height(x); };
  }



  template <int dim>
  std::vector<Remark>
  Bodies<dim>::measure_thickness(const Points<dim> &points,
                                 const Grid<dim>   &grid,
                                 const bool         slides)
  {
    thickness_ = talus::measure_thickness(points, list_, grid);
    return notes_on_thickness(thickness_, slides);
  }



  template class Bodies<2>;
  template class Bodies<3>;
} // namespace talus
