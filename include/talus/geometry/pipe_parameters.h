// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_pipe_parameters_h
#define talus_geometry_pipe_parameters_h

#include <talus/base/place_coordinates.h>
#include <talus/geometry/shape.h>
#include <talus/geometry/surface.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/point.h>

#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Point at which a route crosses the line of a section in plan.
  struct SectionCrossing
  {
    double length; ///< along the section, from its first corner, m
    double sine;   ///< sine of the angle between route and section, positive
                   ///< [-]
  };



  /// Return all places, in the order of the route, where a route crosses the
  /// line of a section. The section extends straight beyond both ends. Both
  /// lines are given by at least two corners in the same plan, m; neighbours
  /// differ.
  std::vector<SectionCrossing>
  find_crossings(const std::vector<dealii::Point<2>> &section,
                 const std::vector<dealii::Point<2>> &route);



  /// Entries of a shape for a pipe: route in plan and height of the axis above
  /// a surface. In 3-D the shape follows the route; in 2-D the shape is the
  /// disc where the route crosses the section.
  template <int dim>
  class PipeParameters : public dealii::ParameterAcceptor
  {
  public:
    /// @p section of the parent ShapeParameters, which has further entries.
    explicit PipeParameters(const std::string &section);

    /// Data for a pipe from further entries of the obstacle.
    struct Setting
    {
      PlanCoordinates           coordinates; ///< coordinates of the route
      double                    radius;      ///< m
      const SurfaceSource<dim> *surfaces;    ///< surfaces for the height
    };

    /// Make the shape. Throws ExcUser if the entries are incomplete or wrong.
    std::unique_ptr<Shape<dim>>
    make(const Setting &setting) const;

    /// Return the end of a sentence for the log with the place of the pipe; the
    /// sentence begins with the name of the pipe.
    std::string
    place_in_words(const Setting &setting) const;

    /// Return the end of a remark, beginning with the name of the pipe, if the
    /// disc in the section only approximates the pipe; empty otherwise.
    std::string
    remark(const Setting &setting) const;

  private:
    std::string
    path(const std::string &entry) const
    {
      return "'" + section_.substr(1) + "/" + entry + "'";
    }

    std::vector<dealii::Point<2>>
    corners(const Setting &setting) const;
    std::vector<dealii::Point<3>>
    axis(const Setting &setting) const;
    SectionCrossing
    crossing(const Setting &setting) const;
    double
    height(const Setting &setting, const dealii::Point<dim> &x) const;

    std::string section_;
    std::string route_          = "";
    std::string height_of_axis_ = "";
  };
} // namespace talus

#endif
