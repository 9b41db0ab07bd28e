// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/clip_simplex.h>
#include <talus/geometry/contour.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Boxes are halved until the distance is linear within a box, or the box is
    // small. Relative to the requested size: largest box, smallest box, and
    // tolerance of linearity.
    constexpr double largest = 16., contour_tolerance = 0.01;
    template <int dim>
    constexpr double smallest = (dim == 2 ? 0.25 : 0.5);



    /// Return place number @p i of the 3^dim corners and middles of edges,
    /// faces and box.
    template <int dim>
    Point<dim>
    place_in(const Box<dim> &box, unsigned int i)
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d, i /= 3)
        x[d] = box.lower[d] + 0.5 * (i % 3) * box.length(d);
      return x;
    }



    /// Return whether the distance agrees with the distance to a plane at all
    /// 3^dim places. The distance grows by at most 1 m per m; therefore it is
    /// linear between the places, too, if the slope there is 1.
    template <int dim>
    bool
    is_linear(const Box<dim>              &box,
              const DistanceFunction<dim> &distance,
              const double                 error)
    {
      constexpr unsigned int                n      = (dim == 2 ? 9 : 27);
      constexpr std::array<unsigned int, 3> stride = {{1, 3, 9}};
      std::array<double, n>                 values;
      for (unsigned int i = 0; i < n; ++i)
        values[i] = distance(place_in<dim>(box, i));
      const double at_middle = values[n / 2];
      for (unsigned int i = 0; i < n; ++i)
        {
          double linear = at_middle;
          for (unsigned int d = 0; d < dim; ++d)
            linear += (int(i / stride[d] % 3) - 1) * 0.5 *
                      (values[n / 2 + stride[d]] - values[n / 2 - stride[d]]);
          if (std::abs(values[i] - linear) > error)
            return false;
        }
      return true;
    }



    /// Append the plane part of the surface in each simplex of the box.
    template <int dim>
    void
    add_elements(const Box<dim>                   &box,
                 const DistanceFunction<dim>      &distance,
                 std::vector<SurfaceElement<dim>> &elements)
    {
      for (const Simplex<dim> &simplex : simplices_of(box, box.lower))
        {
          std::array<double, dim + 1> values;
          for (unsigned int v = 0; v < dim + 1; ++v)
            {
              values[v] = distance(simplex[v]);
              // Otherwise round-off would decide whether a surface on the face
              // of a box belongs to the box.
              if (std::abs(values[v]) < 1e-9 * box.length(0))
                values[v] = 0.;
            }
          const Facet<dim> facet = clip_simplex<dim>(simplex, values).facet;
          if (facet.empty() || vector_area<dim>(facet).norm() == 0)
            continue;
          // Quadrilaterals become two triangles.
          for (unsigned int i = dim - 1; i < facet.size(); ++i)
            {
              SurfaceElement<dim> element;
              element[0] = facet[0];
              for (unsigned int v = 1; v < dim; ++v)
                element[v] = facet[i + v + 1 - dim];
              elements.push_back(element);
            }
        }
    }



    /// Halve the box recursively, and skip boxes farther from the surface than
    /// the size of the box.
    template <int dim>
    void
    halve(const Box<dim>                   &box,
          const DistanceFunction<dim>      &distance,
          const double                      size,
          std::vector<SurfaceElement<dim>> &elements)
    {
      const Point<dim> middle = place_in<dim>(box, dim == 2 ? 4 : 13);
      if (std::abs(distance(middle)) >
          1.5 * 0.5 * box.lower.distance(box.upper))
        return;
      if (box.length(0) <= smallest<dim> * size ||
          is_linear<dim>(box, distance, contour_tolerance * size))
        {
          add_elements<dim>(box, distance, elements);
          return;
        }
      for (unsigned int i = 0; i < (1u << dim); ++i)
        {
          Box<dim> part{box.lower, middle};
          for (unsigned int d = 0; d < dim; ++d)
            if ((i >> d) & 1)
              {
                part.lower[d] = middle[d];
                part.upper[d] = box.upper[d];
              }
          halve<dim>(part, distance, size, elements);
        }
    }
  } // namespace



  template <int dim>
  std::vector<SurfaceElement<dim>>
  contour(const Box<dim>              &box,
          const Box<dim>              &bounds,
          const DistanceFunction<dim> &distance,
          const double                 size)
  {
    // Boxes per axis: n boxes from number first on, one more on each side than
    // the bounds of the surface.
    std::array<double, dim>       length;
    std::array<unsigned int, dim> first, n;
    unsigned int                  n_boxes = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double n_all = std::ceil(box.length(d) / (largest * size));
        length[d]          = box.length(d) / n_all;
        const auto box_at  = [&](const double x) {
          return std::floor((x - box.lower[d]) / length[d]);
        };
        first[d] = std::clamp(box_at(bounds.lower[d]) - 1., 0., n_all);
        n[d] = std::clamp(box_at(bounds.upper[d]) + 2., 1. * first[d], n_all) -
               first[d];
        n_boxes *= n[d];
      }
    std::vector<SurfaceElement<dim>> elements;
    for (unsigned int i = 0; i < n_boxes; ++i)
      {
        Box<dim> part;
        for (unsigned int d = 0, rest = i; d < dim; rest /= n[d], ++d)
          {
            part.lower[d] = box.lower[d] + (first[d] + rest % n[d]) * length[d];
            part.upper[d] = part.lower[d] + length[d];
          }
        halve<dim>(part, distance, size, elements);
      }
    return elements;
  }



  template decltype(contour<2>) contour<2>;
  template decltype(contour<3>) contour<3>;
} // namespace talus
