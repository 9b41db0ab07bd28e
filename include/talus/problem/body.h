// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_body_h
#define talus_problem_body_h

#include <talus/geometry/shape_parameters.h>
#include <talus/grid/grid.h>
#include <talus/points/points.h>
#include <talus/problem/initial_state.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// A body of one material: where it is at the start and how it starts.
  template <int dim>
  class Body : public dealii::ParameterAcceptor
  {
  public:
    explicit Body(const std::string &name);

    /// Fill the body with points: the given number per axis in each cell of the
    /// mesh, those whose centre lies in the shape. Sets everything that does not
    /// depend on the material but mass, which is @p density times the volume,
    /// and the id. Throws ExcUser if the body does not lie in the mesh or gets
    /// no points. Collective.
    void
    create_points(const Grid<dim> &grid,
                  unsigned int     index,
                  double           density,
                  Points<dim>     &points) const;

    /// Smallest box around the body in a mesh that fills @p domain.
    Box<dim>
    bounding_box(const Box<dim> &domain) const;

    /// How it is displaced, moves and is stressed at the start.
    const InitialState<dim> &
    initial_state() const
    {
      return initial_state_;
    }

    const std::string &
    name() const
    {
      return name_;
    }

    const std::string &
    material() const
    {
      return material_;
    }

  private:
    std::string
    path(const std::string &entry) const
    {
      return "'Bodies/" + name_ + "/" + entry + "'";
    }

    void
    check_inside(const Box<dim> &box, const Box<dim> &domain) const;
    void
    check_apart(const Shape<dim> &shape, const Points<dim> &points) const;
    void
    add_point(Points<dim>              &points,
              unsigned int              index,
              const dealii::Point<dim> &x,
              double                    cell_size,
              double                    density) const;

    std::string               name_;
    ShapeParameters<dim>      shape_;
    std::string               material_ = "";
    std::vector<unsigned int> points_per_cell_{2};
    InitialState<dim>         initial_state_;
  };
} // namespace talus

#endif
