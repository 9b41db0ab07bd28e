// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_body_h
#define talus_problem_body_h

#include <talus/base/remark.h>
#include <talus/geometry/region.h>
#include <talus/geometry/shape_parameters.h>
#include <talus/grid/grid.h>
#include <talus/points/points.h>
#include <talus/problem/filling.h>
#include <talus/problem/initial_state.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Body of one material: shape and initial state.
  template <int dim>
  class Body : public dealii::ParameterAcceptor
  {
  public:
    explicit Body(const std::string &name);

    /// Set the surfaces for the shape. Call before any query of the shape.
    void
    use_surfaces(const SurfaceSource<dim> &surfaces)
    {
      shape_.use_surfaces(&surfaces);
    }

    /// Solids that exclude soil.
    using Solids = std::vector<const Shape<dim> *>;

    /// Fill the body with points: a given number per axis in each cell of the
    /// mesh, by centres or clipped by the surface of the body, and by @p solids
    /// unless the parameters forbid it. Sets all columns independent of the
    /// material, with the mass as @p density times volume, but not the id.
    /// Points of a clipped body may lie in cells of other ranks. Throws ExcUser
    /// if the body is not inside the mesh, gets no points, or overlaps other
    /// bodies or solids. Returns a note for the log on the volume removed by
    /// solids; empty if none. Collective.
    Remark
    create_points(const Grid<dim> &grid,
                  unsigned int     index,
                  double           density,
                  Points<dim>     &points,
                  const Solids    &solids = {}) const;

    bool
    is_clipped() const
    {
      return filling_ == "clipped";
    }

    /// Smallest box around the body in a mesh that fills @p domain.
    Box<dim>
    bounding_box(const Box<dim> &domain) const;

    /// Shape of the body in a mesh that fills @p domain.
    std::unique_ptr<Shape<dim>>
    shape(const Box<dim> &domain) const
    {
      return shape_.make(domain);
    }

    /// Displacement, velocity and stress of the body at the start.
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

    /// Name of the face of the mesh through which soil of the body enters, or
    /// `none`.
    const std::string &
    inflow_face() const
    {
      return inflow_face_;
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
    check_apart(const Region<dim> &region, const Points<dim> &points) const;
    void
    check_clear_of(const Solids                     &solids,
                   const std::vector<NewPoint<dim>> &points) const;
    std::array<unsigned int, dim>
    points_per_axis() const;
    /// Points on this rank, and total volumes over all ranks, m^dim: with
    /// solids cut away, and without. Volumes are 0 without solids.
    struct Places
    {
      std::vector<NewPoint<dim>> points;
      double                     volume = 0., uncut_volume = 0.;
    };

    Places
    places_of_points(const Grid<dim>   &grid,
                     const Solids      &solids,
                     const Points<dim> &others) const;
    void
    add_point(Points<dim>         &points,
              unsigned int         index,
              const NewPoint<dim> &point,
              double               density) const;

    std::string               name_;
    ShapeParameters<dim>      shape_;
    std::string               material_ = "";
    std::vector<unsigned int> points_per_cell_{2};
    std::string               filling_          = "clipped";
    bool                      cut_by_obstacles_ = true;
    bool                      cut_by_mesh_      = false;
    std::string               inflow_face_      = "none";
    InitialState<dim>         initial_state_;
  };
} // namespace talus

#endif
