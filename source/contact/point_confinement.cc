// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/simd.h>
#include <talus/contact/box_extent.h>
#include <talus/contact/point_confinement.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Half lengths of the box of point @p p, m, at most half of a cell: if a
    /// limit prevents a point from being split, the box may be longer than the
    /// clipped box used for weights.
    template <int dim>
    Tensor<1, dim>
    half_lengths_in_cell(const State<dim>  &state,
                         const unsigned int cell,
                         const unsigned int p)
    {
      Tensor<1, dim> half = half_lengths_of_box(state.points, p);
      for (unsigned int d = 0; d < dim; ++d)
        half[d] = std::min(half[d], 0.5 * state.grid.cells()[cell].size);
      return half;
    }
  } // namespace



  /// Points are selected by the planes of the facets: the distance from a
  /// terrain is expensive, and most points of a cut cell are not at the
  /// surface. The factor 2 is a margin, since points move with the velocity of
  /// the grid, not with their own; a missed point is found in the next step.
  template <int dim>
  void
  PointConfinement<dim>::note(const State<dim> &state, const Batch &batch)
  {
    candidates_.clear();
    if (obstacles_.empty())
      return;
    tables_.limit(state.points.size());
    const Points<dim> &points = state.points;
    for (const Segment &segment : points.segments(batch))
      note_contained(state, segment);
    for (const Segment &segment : points.segments(batch))
      facets_.for_each_in_cell(segment.cell,
                               [&](const ContactFacet<dim> &facet) {
                                 note_at_facet(state, segment, facet);
                               });
  }



  namespace
  {
    /// Half lengths of the boxes of as many points as a register holds, from
    /// @p p on, m, without the limit of half_lengths_in_cell().
    template <int dim>
    TALUS_ALWAYS_INLINE std::array<Simd<simd_width>, dim>
    load_half_lengths(const Points<dim> &points, const unsigned int p)
    {
      using Number = Simd<simd_width>;
      std::array<Number, dim> half;
      for (unsigned int d = 0; d < dim; ++d)
        half[d] = 0.5 * load<Number>(points.data(points.box_length, d) + p);
      return half;
    }
  } // namespace



  /// Note the points of a cell which may reach @p facet within the step.
  template <int dim>
  void
  PointConfinement<dim>::note_at_facet(const State<dim>        &state,
                                       const Segment           &segment,
                                       const ContactFacet<dim> &facet)
  {
    using Number                = Simd<simd_width>;
    const Points<dim> &points   = state.points;
    const Cell<dim>   &cell     = state.grid.cells()[segment.cell];
    const std::size_t  n_before = candidates_.size();
    const Number       longest(0.5 * cell.size);
    for (unsigned int p = segment.begin; p < segment.end; p += simd_width)
      {
        const unsigned int n    = std::min(simd_width, segment.end - p);
        const auto         half = load_half_lengths(points, p);
        Number             distance(0.), speed(0.), support(0.);
        for (unsigned int d = 0; d < dim; ++d)
          {
            distance += (load<Number>(points.data(points.position, d) + p) -
                         facet.centroid[d]) *
                        facet.normal[d];
            speed += load<Number>(points.data(points.velocity, d) + p) *
                     facet.normal[d];
            support += min(half[d], longest) * std::abs(facet.normal[d]);
          }
        const auto is_near =
          distance + min(Number(0.), 2. * state.time_step * speed) <
          support + facet.deviation;
        for (unsigned int i = 0; i < n; ++i)
          if (is_near[i])
            candidates_.push_back(
              {p + i,
               facet.obstacle,
               &facet,
               nullptr,
               load_place(points, points.position, p + i),
               half_lengths_in_cell(state, segment.cell, p + i)});
      }
    if (candidates_.size() > n_before && !facet.is_flat)
      {
        const SurfaceTable<dim> *const of_cell = tables_.table(cell, facet);
        for (std::size_t i = n_before; i < candidates_.size(); ++i)
          candidates_[i].table = of_cell;
      }
  }



  /// Note all points of a cell which lies wholly inside an obstacle: no facet
  /// is there to select points by its plane.
  template <int dim>
  void
  PointConfinement<dim>::note_contained(const State<dim> &state,
                                        const Segment    &segment)
  {
    const Points<dim> &points = state.points;
    for (const unsigned int k : facets_.containing(segment.cell))
      for (unsigned int p = segment.begin; p < segment.end; ++p)
        candidates_.push_back({p,
                               k,
                               nullptr,
                               nullptr,
                               load_place(points, points.position, p),
                               half_lengths_in_cell(state, segment.cell, p)});
  }



  // The correction by one surface may lead into a second surface: soil that
  // runs down a bed against a structure would be held by the structure and sink
  // into the bed. So moved points are examined again, in up to three passes.
  template <int dim>
  void
  PointConfinement<dim>::confine(State<dim> &state)
  {
    constexpr unsigned int     n_passes = 3;
    Points<dim>               &points   = state.points;
    std::vector<unsigned int> &listed   = state.workspace.points_out_of_cell();
    is_moved_.resize(points.size(), 0);
    for (unsigned int pass = 0; pass < n_passes; ++pass)
      {
        bool has_moved_one = false;
        for (const Candidate &candidate : candidates_)
          {
            const unsigned int p = candidate.point;
            if (pass > 0 && !is_moved_[p])
              continue;
            Point<dim> x = load_place(points, points.position, p);
            if (!confine(candidate, state.time, state.time_step, x))
              continue;
            for (unsigned int d = 0; d < dim; ++d)
              points.data(points.position, d)[p] = x[d];
            has_moved_one = true;
            if (!is_moved_[p])
              listed.push_back(p);
            is_moved_[p] = 1;
          }
        if (!has_moved_one)
          break;
      }
    for (const Candidate &candidate : candidates_)
      is_moved_[candidate.point] = 0;
  }



  /// Return distance from the obstacle of a candidate, m, and normal at @p x.
  /// The distance from a terrain is costly, and most of the bed is flat within
  /// a cell. The facet has moved by @p drift, m, with the obstacle.
  template <int dim>
  std::pair<double, Tensor<1, dim>>
  PointConfinement<dim>::distance_and_normal(const Candidate      &candidate,
                                             const Point<dim>     &x,
                                             const Tensor<1, dim> &drift) const
  {
    const ContactFacet<dim> *const facet = candidate.facet;
    if (facet && facet->is_flat)
      return {facet->distance_from_plane(x - drift), facet->normal};
    if (candidate.table && candidate.table->reaches(x))
      return candidate.table->distance_and_normal(x);
    return obstacles_[candidate.obstacle].distance_and_normal(x);
  }



  /// Correct the new position @p x, m, of a candidate; return whether it
  /// changed. The step of @p dt, s, begins at @p time, s; obstacles are at
  /// their positions at the end. A moving obstacle takes points at its surface
  /// along.
  template <int dim>
  bool
  PointConfinement<dim>::confine(const Candidate &candidate,
                                 const double     time,
                                 const double     dt,
                                 Point<dim>      &x) const
  {
    const ContactFacet<dim> *const facet = candidate.facet;
    if (facet &&
        facet->distance_from_plane(x) >
          facet->deviation + support_of_box(candidate.half, facet->normal))
      return false;
    const Tensor<1, dim> drift =
      dt * obstacles_[candidate.obstacle].velocity_at(x, time + 0.5 * dt);
    const auto [of_centre, normal] = distance_and_normal(candidate, x, drift);
    const double distance = of_centre - support_of_box(candidate.half, normal);
    if (distance >= 0)
      return false;
    const double inwards = (drift - (x - candidate.place)) * normal;
    if (inwards <= 0)
      return false;
    x += std::min(inwards, -distance) * normal;
    return true;
  }



  template class PointConfinement<2>;
  template class PointConfinement<3>;
} // namespace talus
