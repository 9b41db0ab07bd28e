// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/region.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Number of halvings of a box.
    constexpr unsigned int min_depth = 2;

    template <int dim>
    constexpr unsigned int largest_depth = (dim == 2 ? 6 : 4);



    template <int dim>
    Point<dim>
    centre_of(const Box<dim> &box)
    {
      return box.lower + 0.5 * (box.upper - box.lower);
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
  void
  Region<dim>::cut_away(const std::vector<const Shape<dim> *> &solids)
  {
    solids_ = solids;
    std::vector<Box<dim>> boxes;
    for (const Shape<dim> *solid : solids)
      boxes.push_back(solid->bounding_box());
    index_ = BoxIndex<dim>(boxes);
  }



  template <int dim>
  typename Region<dim>::Limits
  Region<dim>::limits_near(const Point<dim> &x, const double distance) const
  {
    Limits limits = limits_;
    for (const unsigned int k : index_.near(x, distance))
      limits.push_back({solids_[k], -1.});
    return limits;
  }



  template <int dim>
  bool
  Region<dim>::contains(const Point<dim> &x) const
  {
    const Limits limits = limits_near(x, 0.);
    return std::all_of(limits.begin(), limits.end(), [&x](const Limit &limit) {
      return limit.sign > 0. ? limit.shape->contains(x)
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
    for (const Shape<dim> *solid : solids_)
      result = std::max(result, -solid->signed_distance(x));
    return result;
  }



  /// Drop the limits that @p box lies within. Returns false if no part of the
  /// box lies within all limits: the distance at the centre decides for the
  /// whole ball around the box.
  template <int dim>
  bool
  Region<dim>::keep_those_that_cut(const Box<dim> &box, Limits &limits)
  {
    const Point<dim> centre = centre_of(box);
    const double     radius = 0.5 * box.lower.distance(box.upper);
    Limits           cutting;
    for (const Limit &limit : limits)
      {
        if (limit.shape->may_cut_ball(centre, radius))
          cutting.push_back(limit);
        else if (limit.signed_distance(centre) > 0.)
          return false;
      }
    limits = cutting;
    return true;
  }



  template <int dim>
  typename Region<dim>::DistancesOfLimits
  Region<dim>::distances_in(const Box<dim> &box, const Limits &limits)
  {
    DistancesOfLimits result;
    for (const Limit &limit : limits)
      {
        Distances distances;
        distances.at_centre = limit.signed_distance(centre_of(box));
        for (unsigned int v = 0; v < (1u << dim); ++v)
          {
            Point<dim> corner = box.lower;
            for (unsigned int d = 0; d < dim; ++d)
              if ((v >> d) & 1)
                corner[d] = box.upper[d];
            distances.at_corners[v] = limit.signed_distance(corner);
          }
        result.push_back(distances);
      }
    return result;
  }



  namespace
  {
    /// Return the number of the corner of @p box at @p x, as in distances_in();
    /// 2^dim at all places that are no corner.
    template <int dim>
    unsigned int
    corner_at(const Box<dim> &box, const Point<dim> &x)
    {
      unsigned int v = 0;
      for (unsigned int d = 0; d < dim; ++d)
        if (x[d] == box.upper[d])
          v |= 1u << d;
        else if (x[d] != box.lower[d])
          return 1u << dim;
      return v;
    }
  } // namespace



  /// Add the part of @p box within all limits. The simplices of the box are
  /// clipped by one limit after another, each linear on the remaining parts.
  /// Edges between planes are exact, unlike for the maximum of the distances.
  /// The mean over the tilings around all diagonals of the box is symmetric.
  template <int dim>
  void
  Region<dim>::add_clipped(const Box<dim>          &box,
                           const Limits            &limits,
                           const DistancesOfLimits &distances,
                           Sum                     &sum)
  {
    constexpr unsigned int n_diagonals = 1u << (dim - 1);
    for (unsigned int v = 0; v < n_diagonals; ++v)
      {
        Point<dim> begin = box.lower;
        for (unsigned int d = 0; d < dim; ++d)
          if ((v >> d) & 1)
            begin[d] = box.upper[d];
        for (const Simplex<dim> &simplex : simplices_of(box, begin))
          for (const Simplex<dim> &part :
               clip(simplex, box, limits, distances, 1e-6 * sum.tolerance))
            sum.add(part, 1. / n_diagonals);
      }
  }



  /// Return the parts of a simplex of @p box within all limits. Distances below
  /// @p tolerance, m, count as zero: otherwise round-off would cut off slivers
  /// at a surface on a face of the lattice.
  template <int dim>
  std::vector<Simplex<dim>>
  Region<dim>::clip(const Simplex<dim>      &simplex,
                    const Box<dim>          &box,
                    const Limits            &limits,
                    const DistancesOfLimits &distances,
                    const double             tolerance)
  {
    std::vector<Simplex<dim>> parts{simplex};
    for (std::size_t i = 0; i < limits.size(); ++i)
      {
        std::vector<Simplex<dim>> clipped;
        for (const Simplex<dim> &part : parts)
          {
            std::array<double, dim + 1> values;
            for (unsigned int v = 0; v <= dim; ++v)
              {
                const unsigned int corner = corner_at(box, part[v]);
                if (corner < distances[i].at_corners.size())
                  values[v] = distances[i].at_corners[corner];
                else
                  values[v] = limits[i].signed_distance(part[v]);
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



  /// Return whether the distance at the centre is the mean of the distances at
  /// the corners. False where a surface is curved or has a corner, and where
  /// two surfaces are near.
  template <int dim>
  bool
  Region<dim>::are_linear(const DistancesOfLimits &distances,
                          const double             tolerance)
  {
    return std::all_of(distances.begin(),
                       distances.end(),
                       [tolerance](const Distances &limit) {
                         double mean = 0.;
                         for (const double distance : limit.at_corners)
                           mean += distance / limit.at_corners.size();
                         return std::abs(limit.at_centre - mean) <= tolerance;
                       });
  }



  /// Return whether two limits are one surface in a box, seen from opposite
  /// sides: their distances at centre and corners differ only in sign, up to
  /// @p tolerance, m. Beyond the end of a layer both surfaces coincide.
  template <int dim>
  bool
  Region<dim>::have_coinciding_pair(const DistancesOfLimits &distances,
                                    const double             tolerance)
  {
    const auto differ_in_sign = [tolerance](const double a, const double b) {
      return std::abs(a + b) <= tolerance;
    };
    for (auto a = distances.begin(); a != distances.end(); ++a)
      for (auto b = a + 1; b != distances.end(); ++b)
        if (differ_in_sign(a->at_centre, b->at_centre) &&
            std::equal(a->at_corners.begin(),
                       a->at_corners.end(),
                       b->at_corners.begin(),
                       differ_in_sign))
          return true;
    return false;
  }



  /// The mean of the squares over a simplex follows from the corners.
  template <int dim>
  void
  Region<dim>::Sum::add(const Simplex<dim> &simplex, const double weight)
  {
    const double part = weight * talus::volume<dim>(simplex);
    volume += part;
    for (unsigned int d = 0; d < dim; ++d)
      {
        double sum = 0., squares = 0.;
        for (const Point<dim> &corner : simplex)
          {
            const double x = corner[d] - origin[d];
            sum += x;
            squares += x * x;
          }
        first[d] += part / (dim + 1) * sum;
        second[d] += part / ((dim + 1) * (dim + 2)) * (squares + sum * sum);
      }
  }



  template <int dim>
  void
  Region<dim>::Sum::add(const Box<dim> &box)
  {
    const double part = volume_of(box);
    volume += part;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double x = centre_of(box)[d] - origin[d], length = box.length(d);
        first[d] += part * x;
        second[d] += part * (x * x + length * length / 12.);
      }
  }



  /// @p depth is the number of halvings so far.
  template <int dim>
  void
  Region<dim>::add_part(const Box<dim>    &box,
                        Limits             limits,
                        const unsigned int depth,
                        Sum               &sum)
  {
    if (!keep_those_that_cut(box, limits))
      return;
    if (limits.empty())
      {
        sum.add(box);
        return;
      }
    if (depth >= min_depth)
      {
        const auto distances = distances_in(box, limits);
        if (have_coinciding_pair(distances, 1e-3 * sum.tolerance))
          return; // no soil in between, however small the parts of the box
        if (depth == largest_depth<dim> || are_linear(distances, sum.tolerance))
          {
            add_clipped(box, limits, distances, sum);
            return;
          }
      }
    for (unsigned int v = 0; v < (1u << dim); ++v)
      {
        Box<dim>         half   = box;
        const Point<dim> centre = centre_of(box);
        for (unsigned int d = 0; d < dim; ++d)
          ((v >> d) & 1 ? half.lower : half.upper)[d] = centre[d];
        add_part(half, limits, depth + 1, sum);
      }
  }



  template <int dim>
  bool
  Region<dim>::may_overlap(const Box<dim> &box) const
  {
    Limits limits =
      limits_near(centre_of(box), 0.5 * box.lower.distance(box.upper));
    return keep_those_that_cut(box, limits);
  }



  template <int dim>
  PartInside<dim>
  Region<dim>::part_inside(const Box<dim> &box) const
  {
    Sum sum;
    sum.origin    = centre_of(box);
    sum.tolerance = 1e-3 * box.lower.distance(box.upper);
    add_part(box,
             limits_near(sum.origin, 0.5 * box.lower.distance(box.upper)),
             0,
             sum);
    // Round-off is neither a sliver nor a hole.
    const double whole = volume_of(box);
    if (sum.volume <= 1e-12 * whole)
      return {};
    const bool      is_whole = sum.volume >= (1. - 1e-12) * whole;
    PartInside<dim> result;
    result.volume   = is_whole ? whole : sum.volume;
    result.centroid = sum.origin;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double shift = is_whole ? 0. : sum.first[d] / sum.volume;
        result.centroid[d] += shift;
        result.variance[d] = is_whole
                               ? box.length(d) * box.length(d) / 12.
                               : sum.second[d] / sum.volume - shift * shift;
      }
    return result;
  }



  template class Region<2>;
  template class Region<3>;
} // namespace talus
