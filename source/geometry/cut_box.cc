// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/clip_simplex.h>
#include <talus/geometry/cut_box.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <numeric>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Parts along each axis. The surface is a plane in each simplex of a part:
    // the area of a circle that crosses a box in an arc of half the radius has
    // an error of 2e-4 (with one part per axis: of a per cent).
    constexpr unsigned int n_coarse_parts = 4;

    // Parts along each axis of a box with surfaces in opposite directions.
    constexpr unsigned int n_fine_parts = 16;



    template <int dim>
    Tensor<1, dim>
    gradient(const DistanceFunction<dim> &distance,
             const Point<dim>            &x,
             const double                 step)
    {
      Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        {
          Point<dim> before = x, after = x;
          before[d] -= step;
          after[d] += step;
          result[d] = (distance(after) - distance(before)) / (2. * step);
        }
      return result;
    }



    /// Return whether the outward normals at the corners of @p box turn by more
    /// than 120 degrees: both sides of a wall thinner than the box, or a body
    /// smaller than the box, which a coarse lattice may miss.
    template <int dim>
    bool
    faces_opposite_ways(const Box<dim>              &box,
                        const DistanceFunction<dim> &distance)
    {
      std::array<Tensor<1, dim>, (1u << dim)> outwards;
      for (unsigned int v = 0; v < outwards.size(); ++v)
        {
          Point<dim> x = box.lower;
          for (unsigned int d = 0; d < dim; ++d)
            if ((v >> d) & 1)
              x[d] = box.upper[d];
          // Deep inside a body the nearest surface may lie in another box.
          if (distance(x) > -0.125 * box.length(0))
            outwards[v] = gradient<dim>(distance, x, 1e-6 * box.length(0));
          for (unsigned int w = 0; w < v; ++w)
            if (outwards[v] * outwards[w] <
                -0.5 * outwards[v].norm() * outwards[w].norm())
              return true;
        }
      return false;
    }



    /// Split a box into @p n_parts parts per axis. Call action(simplex, values)
    /// for the simplices of parts that the surface may cross, with the
    /// distances at the corners, and uncut(part, distance) for all remaining
    /// parts, with the distance at the middle. Distances below round-off become
    /// zero; otherwise round-off would decide whether a surface on the face of
    /// a box has facets.
    template <int dim, typename Action, typename Uncut>
    void
    for_each_simplex(const Box<dim>              &box,
                     const DistanceFunction<dim> &distance,
                     const unsigned int           n_parts,
                     const Action                &action,
                     const Uncut                 &uncut)
    {
      const double     size     = box.length(0);
      const double     diagonal = box.lower.distance(box.upper);
      const Point<dim> centre   = box.lower + 0.5 * (box.upper - box.lower);
      const auto       value    = [&](const Point<dim> &x) {
        const double d = distance(x);
        return std::abs(d) < 1e-9 * size ? 0. : d;
      };
      for (unsigned int i = 0; i < std::pow(n_parts, dim); ++i)
        {
          Box<dim>   part;
          Point<dim> middle;
          for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= n_parts)
            {
              const unsigned int at = rest % n_parts;
              const auto         x  = [&](const double k) {
                return box.lower[d] + k / n_parts * box.length(d);
              };
              part.lower[d] = x(at);
              part.upper[d] = x(at + 1);
              middle[d]     = x(at + 0.5);
            }
          if (const double d = distance(middle);
              std::abs(d) > 1.5 * 0.5 * diagonal / n_parts)
            uncut(part, d);
          else
            {
              // The simplices share the corners of the box.
              std::array<double, (1u << dim)> at_corners;
              for (unsigned int v = 0; v < at_corners.size(); ++v)
                {
                  Point<dim> corner;
                  for (unsigned int d = 0; d < dim; ++d)
                    corner[d] = ((v >> d) & 1 ? part.upper : part.lower)[d];
                  at_corners[v] = value(corner);
                }
              for (const Simplex<dim> &simplex : simplices_of(part, centre))
                {
                  std::array<double, dim + 1> values;
                  for (unsigned int v = 0; v <= dim; ++v)
                    {
                      unsigned int corner = 0;
                      for (unsigned int d = 0; d < dim; ++d)
                        corner |= (simplex[v][d] == part.upper[d]) << d;
                      values[v] = at_corners[corner];
                    }
                  action(simplex, values);
                }
            }
        }
    }



    /// Add the integrals of the shape functions of @p box over a simplex, times
    /// @p factor. The rule is exact for products of dim linear factors.
    template <int dim>
    void
    add_integrals(const Box<dim>                  &box,
                  const Simplex<dim>              &simplex,
                  const double                     factor,
                  std::array<double, (1u << dim)> &integrals)
    {
      static const QGaussSimplex<dim> rule(dim == 2 ? 2 : 3);
      static const double sum  = std::accumulate(rule.get_weights().begin(),
                                                rule.get_weights().end(),
                                                0.);
      const double        size = volume(simplex);
      for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const double weight = factor * size * rule.weight(q) / sum;
          Point<dim>   x      = simplex[0];
          for (unsigned int d = 0; d < dim; ++d)
            x += rule.point(q)[d] * (simplex[d + 1] - simplex[0]);
          const auto N = shape_values_at(box, x);
          for (unsigned int v = 0; v < N.size(); ++v)
            integrals[v] += weight * N[v];
        }
    }
  } // namespace



  template <int dim>
  std::array<double, (1u << dim)>
  shape_values_at(const Box<dim> &box, const Point<dim> &x)
  {
    std::array<double, (1u << dim)> result;
    result.fill(1.);
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double xi    = (x[d] - box.lower[d]) / box.length(d);
        const double at[2] = {1. - xi, xi};
        for (unsigned int v = 0; v < result.size(); ++v)
          result[v] *= at[(v >> d) & 1];
      }
    return result;
  }



  // Plane pieces: simplices are cut where the linear interpolation of the
  // distance is zero. A bilinear interpolation would have a curved surface, and
  // two surfaces where the corners have alternating signs.
  template <int dim>
  std::vector<Facet<dim>>
  surface_pieces(const Box<dim>              &box,
                 const DistanceFunction<dim> &distance,
                 const bool                   is_thin)
  {
    std::vector<Facet<dim>> pieces;
    for_each_simplex(
      box,
      distance,
      is_thin || faces_opposite_ways(box, distance) ? n_fine_parts
                                                    : n_coarse_parts,
      [&](const Simplex<dim>                &simplex,
          const std::array<double, dim + 1> &values) {
        const Facet<dim> facet = clip_simplex<dim>(simplex, values).facet;
        // A single corner on the surface gives a facet without area.
        if (!facet.empty() && vector_area<dim>(facet).norm_square() > 0)
          pieces.push_back(facet);
      },
      [](const Box<dim> &, double) {});
    return pieces;
  }



  template <int dim>
  CutSurface<dim>
  sum_of_pieces(const std::vector<Facet<dim>> &pieces)
  {
    CutSurface<dim> result;
    for (const Facet<dim> &piece : pieces)
      {
        const Tensor<1, dim> vector_area = talus::vector_area<dim>(piece);
        const double         area        = vector_area.norm();
        result.area += area;
        result.vector_area += vector_area;
        result.centroid += area * centroid<dim>(piece);
      }
    if (result.area > 0)
      result.centroid /= result.area;
    return result;
  }



  // Integral over the whole box minus the closed part, which clip_simplex()
  // gives.
  template <int dim>
  std::array<double, (1u << dim)>
  open_shape_integrals(const Box<dim>              &box,
                       const DistanceFunction<dim> &distance)
  {
    std::array<double, (1u << dim)> result;
    double                          whole = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      whole *= box.length(d);
    result.fill(whole / result.size());
    for_each_simplex(
      box,
      distance,
      faces_opposite_ways(box, distance) ? n_fine_parts : n_coarse_parts,
      [&](const Simplex<dim>                &simplex,
          const std::array<double, dim + 1> &values) {
        for (const Simplex<dim> &closed :
             clip_simplex<dim>(simplex, values).parts)
          add_integrals(box, closed, -1., result);
      },
      [&](const Box<dim> &part, const double at_middle) {
        if (at_middle < 0)
          for (const Simplex<dim> &closed : simplices_of(part, part.lower))
            add_integrals(box, closed, -1., result);
      });
    // Removes round-off of boxes that are completely closed.
    for (double &integral : result)
      integral = std::max(0., integral);
    return result;
  }



  template decltype(shape_values_at<2>)      shape_values_at<2>;
  template decltype(shape_values_at<3>)      shape_values_at<3>;
  template decltype(surface_pieces<2>)       surface_pieces<2>;
  template decltype(surface_pieces<3>)       surface_pieces<3>;
  template decltype(sum_of_pieces<2>)        sum_of_pieces<2>;
  template decltype(sum_of_pieces<3>)        sum_of_pieces<3>;
  template decltype(open_shape_integrals<2>) open_shape_integrals<2>;
  template decltype(open_shape_integrals<3>) open_shape_integrals<3>;
} // namespace talus
