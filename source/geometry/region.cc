// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/region.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  template <int dim>
  bool
  Region<dim>::contains(const Point<dim> &x) const
  {
    return std::all_of(limits_.begin(),
                       limits_.end(),
                       [&x](const Limit &limit) {
                         return limit.sign > 0.
                                  ? limit.shape->contains(x)
                                  : limit.signed_distance(x) <= 0.;
                       });
  }



  template <int dim>
  double
  Region<dim>::signed_distance(const Point<dim> &x) const
  {
    double result = -std::numeric_limits<double>::infinity();
    for (const Limit &limit : limits_)
      result = std::max(result, limit.signed_distance(x));
    return result;
  }



  /// Drops the limits that @p box lies within, and says whether it may have a
  /// part within all: distances are Euclidean, so one evaluation tells for a
  /// whole ball.
  template <int dim>
  bool
  Region<dim>::keep_those_that_cut(const Box<dim> &box, Limits &limits)
  {
    const Point<dim> centre = box.lower + 0.5 * (box.upper - box.lower);
    const double     radius = 0.5 * box.lower.distance(box.upper);
    Limits           cutting;
    for (const Limit &limit : limits)
      {
        const double distance = limit.signed_distance(centre);
        if (distance >= radius)
          return false;
        if (distance > -radius)
          cutting.push_back(limit);
      }
    limits = cutting;
    return true;
  }



  /// Limit by limit, each linear in what the ones before left: so where two
  /// planes meet, the edge is exact, which it would not be for the maximum of
  /// their distances.
  template <int dim>
  std::vector<Simplex<dim>>
  Region<dim>::clip(const Simplex<dim> &simplex,
                    const Limits       &limits,
                    const double        tolerance)
  {
    std::vector<Simplex<dim>> parts{simplex};
    for (const Limit &limit : limits)
      {
        std::vector<Simplex<dim>> clipped;
        for (const Simplex<dim> &part : parts)
          {
            std::array<double, dim + 1> values;
            for (unsigned int v = 0; v <= dim; ++v)
              {
                values[v] = limit.signed_distance(part[v]);
                // Else round-off would cut slivers off at a surface that lies
                // on a face of the lattice.
                if (std::abs(values[v]) < tolerance)
                  values[v] = 0.;
              }
            const auto left = clip_simplex<dim>(part, values).parts;
            clipped.insert(clipped.end(), left.begin(), left.end());
          }
        parts = std::move(clipped);
      }
    return parts;
  }



  namespace
  {
    /// Box number @p i of the @p n^dim that tile @p box, the first axis
    /// fastest.
    template <int dim>
    Box<dim>
    part_of(const Box<dim> &box, unsigned int i, const unsigned int n)
    {
      Box<dim> part;
      for (unsigned int d = 0; d < dim; ++d, i /= n)
        {
          part.lower[d] = box.lower[d] + i % n * box.length(d) / n;
          part.upper[d] = box.lower[d] + (i % n + 1) * box.length(d) / n;
        }
      return part;
    }



    template <int dim>
    double
    volume_of(const Box<dim> &box)
    {
      double volume = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        volume *= box.length(d);
      return volume;
    }
  } // namespace



  template <int dim>
  PartInside<dim>
  Region<dim>::part_inside(const Box<dim> &box, const unsigned int n) const
  {
    const Point<dim> centre = box.lower + 0.5 * (box.upper - box.lower);
    const double     whole  = volume_of(box);
    Limits           near   = limits_;
    if (!keep_those_that_cut(box, near))
      return {};
    if (near.empty())
      return {whole, centre};

    double         volume_inside = 0.;
    Tensor<1, dim> moment; // about the centre
    const auto     add = [&](const double volume, const Point<dim> &centroid) {
      volume_inside += volume;
      moment += volume * (centroid - centre);
    };
    const double tolerance = 1e-9 * box.lower.distance(box.upper);
    for (unsigned int i = 0; i < std::pow(n, dim); ++i)
      {
        const Box<dim> part    = part_of(box, i, n);
        Limits         cutting = near;
        if (!keep_those_that_cut(part, cutting))
          continue;
        if (cutting.empty())
          {
            add(volume_of(part), part.lower + 0.5 * (part.upper - part.lower));
            continue;
          }
        for (const Simplex<dim> &simplex : simplices_of(part))
          for (const auto &inside : clip(simplex, cutting, tolerance))
            add(volume<dim>(inside), centroid<dim>(inside));
      }
    // Round-off is neither a sliver nor a hole.
    if (volume_inside <= 1e-12 * whole)
      return {};
    if (volume_inside >= (1. - 1e-12) * whole)
      return {whole, centre};
    return {volume_inside, centre + moment / volume_inside};
  }



  template class Region<2>;
  template class Region<3>;
} // namespace talus
