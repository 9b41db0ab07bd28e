// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_shape_parameters_h
#define talus_geometry_shape_parameters_h

#include <talus/base/place_coordinates.h>
#include <talus/geometry/pipe_parameters.h>
#include <talus/geometry/shape.h>
#include <talus/geometry/side_of_surface.h>
#include <talus/geometry/surface.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Parameters of a shape, in the section of a body or obstacle. Entries that
  /// the shape does not use are ignored.
  template <int dim>
  class ShapeParameters : public dealii::ParameterAcceptor
  {
  public:
    /// @p section, for instance /Bodies/NAME, may have further entries.
    explicit ShapeParameters(const std::string &section);

    /// Set the surfaces for terrains and layers, after parsing and before the
    /// first make(). @p surfaces must outlive this object.
    void
    use_surfaces(const SurfaceSource<dim> *surfaces)
    {
      surfaces_ = surfaces;
    }

    /// Make the shape. Prisms and cylinders without given ends extend over
    /// @p domain; an infinite domain makes them endless. Throws ExcUser if the
    /// entries are incomplete or wrong.
    std::unique_ptr<Shape<dim>>
    make(const Box<dim> &domain) const;

    /// Coordinates of the places among the entries.
    PlaceCoordinates
    coordinates() const;

    /// Return the end of a sentence for the log with the place of the shape,
    /// beginning with the name of the shape; empty if the parameters give the
    /// place.
    std::string
    place_in_words() const
    {
      return is_pipe() ? pipe_.place_in_words(setting_of_pipe()) : "";
    }

    /// Return the end of a remark, beginning with the name of the shape, if the
    /// shape only approximates the requested shape; empty otherwise.
    std::string
    remark() const
    {
      return is_pipe() ? pipe_.remark(setting_of_pipe()) : "";
    }

  private:
    bool
    is_pipe() const
    {
      return shape_ == "pipe";
    }

    typename PipeParameters<dim>::Setting
    setting_of_pipe() const;
    std::string
    path(const std::string &entry) const;
    void
    declare_parameters_of_boxes();
    void
    declare_parameters_of_round_shapes();
    void
    declare_parameters_of_polygon_and_half_plane();

    void
    declare_parameters_of_surfaces();

    /// Corners in elevation, or of an outline in plan; in the axes of the mesh.
    std::vector<dealii::Point<2>>
    vertices(bool are_in_plan) const;
    std::array<double, 2>
    extent_z(const Box<dim> &domain) const;
    std::unique_ptr<Shape<dim>>
    make_half_space() const;
    std::unique_ptr<Shape<dim>>
    make_box() const;
    std::unique_ptr<Shape<dim>>
    make_frustum() const;
    std::unique_ptr<Shape<dim>>
    make_side(const std::string                &entry,
              const std::string                &expression,
              typename SideOfSurface<dim>::Side side) const;
    std::unique_ptr<Shape<dim>>
    make_layer(const Box<dim> &domain) const;
    void
    check_top(const Shape<dim> &layer, const Box<dim> &domain) const;
    void
    check_radii() const;

    std::string         section_;
    PipeParameters<dim> pipe_;
    std::string         shape_       = ""; ///< no default
    std::string         coordinates_ = "mesh";
    std::string         vertices_    = "";
    bool                is_open_     = false;
    std::string         extent_z_    = "";
    dealii::Point<dim>  lower_corner_, upper_corner_;
    dealii::Point<dim>  centre_;
    double              radius_       = 1.;
    double              inner_radius_ = 0.;
    double              end_radius_   = 0.;

    std::vector<dealii::Point<dim>> axis_; ///< two ends, or empty

    dealii::Point<dim>        point_;
    dealii::Tensor<1, dim>    normal_ = dealii::Point<dim>::unit_vector(1);
    std::string               surface_, upper_surface_, lower_surface_;
    const SurfaceSource<dim> *surfaces_ = nullptr;
  };
} // namespace talus

#endif
