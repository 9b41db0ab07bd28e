// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/geometry/contour.h>
#include <talus/observers/obstacles_output.h>
#include <talus/observers/state_cells.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Element of the surface of an obstacle.
    template <int dim>
    struct Element
    {
      unsigned int        obstacle;
      SurfaceElement<dim> corners;

      Point<dim>
      middle() const
      {
        Point<dim> x;
        for (const Point<dim> &corner : corners)
          x += corner / dim;
        return x;
      }
    };



    /// Surface elements, about @p size m long, of all obstacles inside @p box.
    /// Uses signed distances only, so new shapes need no further code.
    template <int dim>
    std::vector<Element<dim>>
    elements_in(const Box<dim>       &box,
                const Obstacles<dim> &obstacles,
                const double          size)
    {
      std::vector<Element<dim>> result;
      for (unsigned int k = 0; k < obstacles.size(); ++k)
        for (const SurfaceElement<dim> &corners : contour<dim>(
               box,
               obstacles[k].bounding_box(),
               [&](const Point<dim> &x) {
                 return obstacles[k].signed_distance(x);
               },
               size))
          result.push_back({k, corners});
      return result;
    }



    /// Fields of surface elements by element number. The arguments must outlive
    /// the fields.
    template <int dim>
    std::vector<Field>
    surface_fields(const Obstacles<dim>            &obstacles,
                   const std::vector<Element<dim>> &elements)
    {
      return {
        scalar_field("obstacle",
                     "",
                     [&elements](const unsigned int i) {
                       return elements[i].obstacle;
                     }),
        vector_field<dim>("normal",
                          "",
                          [&](const unsigned int i) {
                            return obstacles[elements[i].obstacle].normal(
                              elements[i].middle());
                          }),
        scalar_field("maximum shear stress", "Pa", [&](const unsigned int i) {
          // An infinite value would spoil the colour scale of ParaView.
          const double limit =
            obstacles[elements[i].obstacle].maximum_shear_stress(
              elements[i].middle());
          return std::isfinite(limit)
                   ? limit
                   : std::numeric_limits<double>::quiet_NaN();
        })};
    }
  } // namespace



  /// The first rank writes all surfaces: every rank knows the obstacles, and
  /// distributing the elements has no benefit. The domain is the mesh as
  /// requested: mesh faces may have moved far away to make space for large
  /// cells.
  template <int dim>
  void
  ObstaclesOutput<dim>::observe(const State<dim> &state)
  {
    if (!this->series_.is_empty() && !obstacles_.move())
      return;
    std::vector<Element<dim>> elements;
    if (is_first_rank(state.communicator()))
      elements = elements_in(state.grid.domain_before_growth(),
                             obstacles_,
                             state.grid.finest_size());
    OutputCells cells =
      state_cells(state,
                  surface_fields(obstacles_, elements),
                  ItemsAt::cells,
                  dim == 2 ? CellShape::line : CellShape::triangle);
    for (unsigned int i = 0; i < elements.size(); ++i)
      {
        for (const Point<dim> &corner : elements[i].corners)
          cells.add_vertex(corner);
        cells.items.push_back(i);
      }
    this->series_.write(cells);
  }



  template class ObstaclesOutput<2>;
  template class ObstaclesOutput<3>;
} // namespace talus
