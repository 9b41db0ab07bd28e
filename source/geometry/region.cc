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



  /// The simplex is clipped by one limit after another, each linear on the
  /// remaining parts. Edges between planes are exact, unlike for the maximum of
  /// the distances.
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
                // Otherwise round-off would cut off slivers at a surface on a
                // face of the lattice.
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
  Region<dim>::are_linear(const Box<dim> &box,
                          const Limits   &limits,
                          const double    tolerance)
  {
    for (const Limit &limit : limits)
      {
        double mean = 0.;
        for (unsigned int v = 0; v < (1u << dim); ++v)
          {
            Point<dim> corner = box.lower;
            for (unsigned int d = 0; d < dim; ++d)
              if ((v >> d) & 1)
                corner[d] = box.upper[d];
            mean += limit.signed_distance(corner) / (1u << dim);
          }
        if (std::abs(limit.signed_distance(centre_of(box)) - mean) > tolerance)
          return false;
      }
    return true;
  }



  namespace
  {
    /// Return whether two limits are one surface in @p box, seen from opposite
    /// sides: their distances at centre and corners differ only in sign, up to
    /// @p tolerance, m. Beyond the end of a layer both surfaces coincide.
    template <int dim, typename Limits>
    bool
    have_coinciding_pair(const Box<dim> &box,
                         const Limits   &limits,
                         const double    tolerance)
    {
      const auto coincide = [&](const auto &a, const auto &b) {
        const auto differ_in_sign = [&](const Point<dim> &x) {
          return std::abs(a.signed_distance(x) + b.signed_distance(x)) <=
                 tolerance;
        };
        if (!differ_in_sign(centre_of(box)))
          return false;
        for (unsigned int v = 0; v < (1u << dim); ++v)
          {
            Point<dim> corner = box.lower;
            for (unsigned int d = 0; d < dim; ++d)
              if ((v >> d) & 1)
                corner[d] = box.upper[d];
            if (!differ_in_sign(corner))
              return false;
          }
        return true;
      };
      for (std::size_t i = 0; i < limits.size(); ++i)
        for (std::size_t j = i + 1; j < limits.size(); ++j)
          if (coincide(limits[i], limits[j]))
            return true;
      return false;
    }
  } // namespace



  /// The mean of the squares over a simplex follows from the corners.
  template <int dim>
  void
  Region<dim>::Sum::add(const Simplex<dim> &simplex)
  {
    const double part = talus::volume<dim>(simplex);
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
      sum.add(box);
    else if (depth >= min_depth &&
             have_coinciding_pair(box, limits, 1e-3 * sum.tolerance))
      return; // no soil in between, however small the parts of the box
    else if (depth == largest_depth<dim> ||
             (depth >= min_depth && are_linear(box, limits, sum.tolerance)))
      {
        for (const Simplex<dim> &simplex : simplices_of(box))
          for (const auto &part : clip(simplex, limits, 1e-6 * sum.tolerance))
            sum.add(part);
      }
    else
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
