// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/box_extent.h>
#include <talus/contact/point_confinement.h>

#include <algorithm>

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
      Tensor<1, dim> half =
        half_lengths_of_box(state.points, state.constants.box_shape, p);
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
    const Points<dim> &points = state.points;
    for (const Segment &segment : points.segments(batch))
      note_contained(state, segment);
    for (const Segment &segment : points.segments(batch))
      facets_.for_each_in_cell(
        segment.cell, [&](const ContactFacet<dim> &facet) {
          for (unsigned int p = segment.begin; p < segment.end; ++p)
            {
              const Point<dim> x = load_place(points, points.position, p);
              const double     later =
                2. * state.time_step *
                (load_vector(points, points.velocity, p) * facet.normal);
              const Tensor<1, dim> half =
                half_lengths_in_cell(state, segment.cell, p);
              if (facet.distance_from_plane(x) + std::min(0., later) <
                  facet.deviation + support_of_box(half, facet.normal))
                candidates_.push_back({p, facet.obstacle, &facet, x, half});
            }
        });
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
    // The distance from a terrain is expensive, and most of the bed is flat
    // within a cell. An obstacle that moves has left the plane of the facet.
    const Obstacle<dim> &obstacle = obstacles_[candidate.obstacle];
    const auto [of_centre, normal] =
      facet && facet->is_flat && !obstacle.moves()
        ? std::make_pair(facet->distance_from_plane(x), facet->normal)
        : obstacle.distance_and_normal(x);
    const double distance = of_centre - support_of_box(candidate.half, normal);
    if (distance >= 0)
      return false;
    const Tensor<1, dim> drift   = dt * obstacle.velocity(time + 0.5 * dt);
    const double         inwards = (drift - (x - candidate.place)) * normal;
    if (inwards <= 0)
      return false;
    x += std::min(inwards, -distance) * normal;
    return true;
  }



  template class PointConfinement<2>;
  template class PointConfinement<3>;
} // namespace talus
