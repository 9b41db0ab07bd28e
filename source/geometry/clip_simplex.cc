// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/clip_simplex.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Simplex with the inside corners first, and the cuts of edges from inside
    /// to outside corners.
    template <int dim>
    struct SortedSimplex
    {
      SortedSimplex(const Simplex<dim>                &simplex,
                    const std::array<double, dim + 1> &values)
      {
        unsigned int n = 0;
        for (const bool inside : {true, false})
          for (unsigned int v = 0; v <= dim; ++v)
            if ((values[v] <= 0.) == inside)
              {
                corner[n]  = simplex[v];
                value[n++] = values[v];
                n_inside += inside;
              }
      }

      /// Return the cut of an edge, computed from the inside corner: both
      /// simplices at the edge get bitwise the same place.
      Point<dim>
      cut(const unsigned int inside, const unsigned int outside) const
      {
        const double t = value[inside] / (value[inside] - value[outside]);
        return corner[inside] + t * (corner[outside] - corner[inside]);
      }

      Simplex<dim>                corner;
      std::array<double, dim + 1> value;
      unsigned int                n_inside = 0;
    };



    void
    clip(const SortedSimplex<2> &s, ClippedSimplex<2> &result)
    {
      const auto &x = s.corner;
      if (s.n_inside == 1)
        {
          const Point<2> a = s.cut(0, 1), b = s.cut(0, 2);
          result.parts = {{{x[0], a, b}}};
          result.facet = {a, b};
        }
      else
        {
          const Point<2> a = s.cut(0, 2), b = s.cut(1, 2);
          result.parts = {{{x[0], x[1], b}}, {{x[0], b, a}}};
          result.facet = {a, b};
        }
    }



    /// Append the three tetrahedra between two triangles.
    void
    add_prism(const std::array<Point<3>, 3> &a,
              const std::array<Point<3>, 3> &b,
              ClippedSimplex<3>             &result)
    {
      result.parts.push_back({{a[0], a[1], a[2], b[2]}});
      result.parts.push_back({{a[0], a[1], b[1], b[2]}});
      result.parts.push_back({{a[0], b[0], b[1], b[2]}});
    }



    void
    clip(const SortedSimplex<3> &s, ClippedSimplex<3> &result)
    {
      const auto &x = s.corner;
      if (s.n_inside == 1)
        {
          const Point<3> a = s.cut(0, 1), b = s.cut(0, 2), c = s.cut(0, 3);
          result.parts = {{{x[0], a, b, c}}};
          result.facet = {a, b, c};
        }
      else if (s.n_inside == 2)
        {
          const Point<3> a = s.cut(0, 2), b = s.cut(0, 3);
          const Point<3> c = s.cut(1, 2), d = s.cut(1, 3);
          add_prism({{x[0], a, b}}, {{x[1], c, d}}, result);
          result.facet = {a, b, d, c};
        }
      else
        {
          const Point<3> a = s.cut(0, 3), b = s.cut(1, 3), c = s.cut(2, 3);
          add_prism({{x[0], x[1], x[2]}}, {{a, b, c}}, result);
          result.facet = {a, b, c};
        }
    }
  } // namespace



  template <int dim>
  ClippedSimplex<dim>
  clip_simplex(const Simplex<dim>                &simplex,
               const std::array<double, dim + 1> &values)
  {
    ClippedSimplex<dim> result;
    // Most simplices are not cut.
    const auto n_inside =
      std::count_if(values.begin(), values.end(), [](const double value) {
        return value <= 0.;
      });
    if (n_inside == dim + 1)
      result.parts.push_back(simplex);
    else if (n_inside > 0)
      {
        const SortedSimplex<dim> sorted(simplex, values);
        clip(sorted, result);
        // The last corner is always outside.
        const Tensor<1, dim> outwards = sorted.corner[dim] - result.facet[0];
        if (vector_area<dim>(result.facet) * outwards < 0.)
          std::reverse(result.facet.begin(), result.facet.end());
      }
    return result;
  }



  template <int dim>
  double
  volume(const Simplex<dim> &simplex)
  {
    Tensor<2, dim> edges;
    for (unsigned int d = 0; d < dim; ++d)
      edges[d] = simplex[d + 1] - simplex[0];
    return std::abs(determinant(edges)) / (dim == 2 ? 2. : 6.);
  }



  template <int dim>
  Point<dim>
  centroid(const Simplex<dim> &simplex)
  {
    return std::accumulate(simplex.begin(), simplex.end(), Point<dim>()) /
           (dim + 1.);
  }



  namespace
  {
    /// Return the vector area of the triangle (0, e, e + 1) of a polygon.
    Tensor<1, 3>
    area_of_triangle(const Facet<3> &facet, const unsigned int e)
    {
      return 0.5 *
             cross_product_3d(facet[e] - facet[0], facet[e + 1] - facet[0]);
    }
  } // namespace



  template <>
  Tensor<1, 2>
  vector_area<2>(const Facet<2> &facet)
  {
    const Tensor<1, 2> edge = facet[1] - facet[0];
    return Tensor<1, 2>({-edge[1], edge[0]});
  }



  template <>
  Tensor<1, 3>
  vector_area<3>(const Facet<3> &facet)
  {
    Tensor<1, 3> result;
    for (unsigned int e = 1; e + 1 < facet.size(); ++e)
      result += area_of_triangle(facet, e);
    return result;
  }



  template <>
  Point<2>
  centroid<2>(const Facet<2> &facet)
  {
    return 0.5 * (facet[0] + facet[1]);
  }



  template <>
  Point<3>
  centroid<3>(const Facet<3> &facet)
  {
    Tensor<1, 3> moment;
    double       area = 0.;
    for (unsigned int e = 1; e + 1 < facet.size(); ++e)
      {
        const double part = area_of_triangle(facet, e).norm();
        moment += part / 3. * (facet[0] + facet[e] + facet[e + 1]);
        area += part;
      }
    return Point<3>(moment / area);
  }



  /// Each simplex goes along the axes from the corner nearest to @p centre to
  /// the opposite corner, in one permutation of the axes.
  template <int dim>
  std::array<Simplex<dim>, dim == 2 ? 2 : 6>
  simplices_of(const Box<dim> &box, const Point<dim> &centre)
  {
    Point<dim> nearest = box.lower, farthest = box.upper;
    for (unsigned int d = 0; d < dim; ++d)
      if (box.lower[d] + box.upper[d] < 2. * centre[d])
        std::swap(nearest[d], farthest[d]);
    std::array<Simplex<dim>, dim == 2 ? 2 : 6> result;
    std::array<unsigned int, dim>              axes;
    std::iota(axes.begin(), axes.end(), 0);
    for (Simplex<dim> &simplex : result)
      {
        simplex[0] = nearest;
        for (unsigned int d = 0; d < dim; ++d)
          {
            simplex[d + 1]          = simplex[d];
            simplex[d + 1][axes[d]] = farthest[axes[d]];
          }
        std::next_permutation(axes.begin(), axes.end());
      }
    return result;
  }



  template decltype(clip_simplex<2>) clip_simplex<2>;
  template decltype(clip_simplex<3>) clip_simplex<3>;
  template decltype(volume<2>)       volume<2>;
  template decltype(volume<3>)       volume<3>;
  template decltype(simplices_of<2>) simplices_of<2>;
  template decltype(simplices_of<3>) simplices_of<3>;

  // Facets have a function of the same name.
  template Point<2>
  centroid<2>(const Simplex<2> &);
  template Point<3>
  centroid<3>(const Simplex<3> &);
} // namespace talus
