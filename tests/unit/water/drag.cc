// SPDX-License-Identifier: LGPL-2.1-or-later
// Drag on bodies that move as a whole through water at rest: on layers of any
// thickness, and on noses of any slope.
#include "obstacles_setup.h"
#include "ranks_setup.h"
#include "suites.h"

#include <talus/geometry/analytic_shapes.h>
#include <talus/problem/filling.h>
#include <talus/water/free_surface.h>

#include <cmath>

namespace Utilities = dealii::Utilities;

namespace
{
  TALUS_ALSO_ON_RANKS(WaterDrag, 3);

  constexpr double degree = M_PI / 180.;

  template <int dim>
  using Sections = std::initializer_list<typename WithObstacles<dim>::Section>;

  /// Forces divided by half the density of the water, its coefficient and the
  /// square of the velocity, m^(dim-1).
  template <int dim>
  struct DragAreas
  {
    Tensor<1, dim> friction;
    Tensor<1, dim> pressure;
  };

  /// Soil in an intersection of half spaces, two points per cell and axis.
  template <int dim>
  struct ClippedSoil : Core<dim>
  {
    ClippedSoil(const std::string   &parameters,
                const Sections<dim> &sections = {})
      : Core<dim>(parameters)
      , with(sections)
      , contact(with.obstacles, this->boundaries)
    {
      contact.prepare(this->grid);
      surface.prepare(this->grid);
    }

    void
    keep_below(const Point<dim> &x, const Tensor<1, dim> &normal)
    {
      shapes.push_back(std::make_unique<HalfSpace<dim>>(x, normal));
    }

    /// Drag at velocity @p u, m/s.
    DragAreas<dim>
    drag(const Tensor<1, dim> &u)
    {
      fill(u);
      this->sort();
      this->scatter();
      this->nodes.update_momentum(0., 0.);
      contact.find_soil(*this);
      surface.find(*this, contact);
      surface.update_soil(*this);
      DragAreas<dim> result;
      for (const SurfaceFacet<dim> &facet : surface.facets())
        {
          EXPECT_LT((facet.velocity - u).norm(), 1e-12);
          const double         area    = facet.vector_area * facet.normal;
          const double         outward = u * facet.normal;
          const Tensor<1, dim> along   = u - outward * facet.normal;
          result.friction += area * along.norm() * along;
          if (outward > 0)
            result.pressure += outward * outward * facet.vector_area;
        }
      result.friction =
        Utilities::MPI::sum(result.friction, this->grid.communicator());
      result.pressure =
        Utilities::MPI::sum(result.pressure, this->grid.communicator());
      return result;
    }

    void
    fill(const Tensor<1, dim> &u)
    {
      Region<dim> region;
      for (const auto &shape : shapes)
        region.restrict_to(*shape);
      std::array<unsigned int, dim> n;
      n.fill(2);
      for (const auto &point :
           clipped_filling<dim>(this->grid, region, this->grid.domain(), n))
        {
          double volume = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            volume *= point.length[d];
          const unsigned int p = this->add(point.x, point.length);
          this->points.data(this->points.mass)[p] = 1600. * volume;
          this->set(this->points.velocity, p, u);
        }
    }

    WithObstacles<dim>                           with;
    Contact<dim>                                 contact;
    FreeSurface<dim>                             surface;
    std::vector<std::unique_ptr<HalfSpace<dim>>> shapes;
  };



  template <int dim>
  Tensor<1, dim>
  direction(const unsigned int axis, const double angle)
  {
    Tensor<1, dim> result;
    result[axis] = std::cos(angle);
    result[1]    = std::sin(angle);
    return result;
  }



  constexpr double length_of_layer = 60.; // m, or cells

  /// Friction on a layer of @p thickness cells and 60 cells in length, on a
  /// plane through (0, @p height) that rises by @p angle, compared to its top.
  double
  friction_on_layer(const double thickness,
                    const double angle,
                    const double height)
  {
    const Tensor<1, 2> along  = direction<2>(0, angle);
    const Tensor<1, 2> across = direction<2>(0, angle + 0.5 * M_PI);
    const auto         format = [](const Tensor<1, 2> &x) {
      std::ostringstream out;
      out << std::setprecision(17) << x[0] << ", " << x[1];
      return out.str();
    };
    const Point<2>    origin(0., height);
    const std::string parameters = mesh("0, 0", "68, 42");
    const std::string plane = "Shape = half-plane|Point = " + format(origin) +
                              "|Normal = " + format(across);
    auto soil =
      height > 0 ? std::make_unique<ClippedSoil<2>>(parameters,
                                                    Sections<2>{{"bed", plane}})
                 : std::make_unique<ClippedSoil<2>>(parameters);
    const Point<2> start = origin + 3.21 * along;
    soil->keep_below(origin, -across);
    soil->keep_below(origin + thickness * across, across);
    soil->keep_below(start, -along);
    soil->keep_below(start + length_of_layer * along, along);
    return soil->drag(along).friction * along / length_of_layer;
  }



  /// Pressure on a nose 20 cells high that slopes by @p angle towards the lower
  /// or the upper end of @p axis, compared to that of a plane.
  template <int dim>
  double
  pressure_on_nose(const double angle, const unsigned int axis, const bool up)
  {
    const double   height = 20.;
    const double   length = height / std::tan(angle) + 12.;
    const double   extent = std::ceil(length + 5.);
    Tensor<1, dim> sense;
    sense[axis] = (up ? 1. : -1.);
    std::string upper;
    for (unsigned int d = 0; d < dim; ++d)
      upper += (d > 0 ? ", " : "") + std::to_string(d == axis ? extent
                                                    : d == 1  ? 23.
                                                              : 2.);
    ClippedSoil<dim> soil(mesh(dim == 2 ? "0, 0" : "0, 0, 0", upper));
    Point<dim>       toe, top;
    toe[axis]             = (up ? length : extent - length);
    top[1]                = height;
    Tensor<1, dim> normal = std::sin(angle) * sense;
    normal[1]             = std::cos(angle);
    soil.keep_below(toe, normal);
    soil.keep_below(top, direction<dim>(axis, 0.5 * M_PI));
    const double width = (dim == 2 ? 1. : 2.);
    return soil.drag(sense).pressure * sense /
           (width * height * std::pow(std::sin(angle), 2));
  }
} // namespace



// The sharp edges of the layer are cut off: at its ends friction misses less
// than a cell, of 60, as soon as the layer is as thick as a cell.
TEST(WaterDrag, LayersOfAnyThickness)
{
  for (const double thickness : {0.125, 0.25, 0.5, 0.75, 1., 2.})
    {
      EXPECT_NEAR(friction_on_layer(thickness, 0., 0.), 1., 0.02) << thickness;
      EXPECT_NEAR(friction_on_layer(thickness, 0., 1.), 1., 0.02) << thickness;
      EXPECT_NEAR(friction_on_layer(thickness, 0., 0.37), 1., 0.02)
        << thickness;
      for (const double angle : {5., 17.})
        EXPECT_NEAR(friction_on_layer(thickness, angle * degree, 0.37),
                    1.,
                    0.02)
          << thickness << " at " << angle;
    }
}



// On a steeper plane boxes of one eighth of a cell in height leave gaps.
TEST(WaterDrag, LayersOnSteepPlane)
{
  for (const double thickness : {0.25, 0.5, 0.75, 1., 2.})
    EXPECT_NEAR(friction_on_layer(thickness, 30. * degree, 0.37), 1., 0.02)
      << thickness;
  EXPECT_NEAR(friction_on_layer(0.125, 30. * degree, 0.37), 1., 0.05);
}



// 1/2 rho_w C_P (u.n)^2 A, whatever the slope and the direction.
TEST(WaterDrag, NosesOfAnySlope)
{
  for (const double angle : {90., 63., 45., 30., 20., 15.})
    {
      const double right = pressure_on_nose<2>(angle * degree, 0, true);
      const double left  = pressure_on_nose<2>(angle * degree, 0, false);
      EXPECT_NEAR(right, 1., 0.04) << angle;
      EXPECT_NEAR(left, right, 0.005 * right) << angle;
    }
}



TEST(WaterDrag, NosesInSpace)
{
  for (const double angle : {90., 45., 20.})
    {
      const double right = pressure_on_nose<3>(angle * degree, 0, true);
      EXPECT_NEAR(right, 1., 0.04) << angle;
      for (const unsigned int axis : {0, 2})
        for (const bool up : {true, false})
          EXPECT_NEAR(pressure_on_nose<3>(angle * degree, axis, up),
                      right,
                      0.005 * right)
            << angle << " along axis " << axis;
    }
}



// Soil on a plane through the cells, from wall to wall: the free surface lies
// above the ground of the mesh, and goes along the plane.
TEST(WaterDrag, SurfaceAlongAPlane)
{
  const Tensor<1, 2> along  = direction<2>(0, std::atan(0.2));
  const Tensor<1, 2> across = direction<2>(0, std::atan(0.2) + 0.5 * M_PI);
  ClippedSoil<2>     soil(
    slab<2>() + in_section("Grid", "set Cell size = 0.25"),
    {{"bed", "Shape = half-plane|Point = 0, 0.43|Normal = -0.2, 1"}});
  const Point<2> origin(0., 0.43);
  soil.keep_below(origin, -across);
  soil.keep_below(origin + 1. * across, across);
  const double friction = soil.drag(along).friction * along;
  Tensor<1, 2> vector_area;
  for (unsigned int c = 0; c < soil.grid.n_owned_cells(); ++c)
    vector_area += soil.surface.vector_area_of_cell(c);
  vector_area = Utilities::MPI::sum(vector_area, soil.grid.communicator());
  EXPECT_NEAR(vector_area[1], 6., 0.01);
  EXPECT_NEAR(friction, 6. * std::hypot(1., 0.2), 0.02 * 6.);
}
