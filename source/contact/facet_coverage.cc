// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/boundaries/contact_area.h>
#include <talus/contact/box_extent.h>
#include <talus/contact/facet_coverage.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Coordinate axis nearest to the normal of a facet.
    template <int dim>
    unsigned int
    axis_across(const ContactFacet<dim> &facet)
    {
      unsigned int axis = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(facet.normal[d]) > std::abs(facet.normal[axis]))
          axis = d;
      return axis;
    }



    /// Number @p k of the dim-1 axes across @p axis.
    constexpr unsigned int
    across(const unsigned int axis, const unsigned int k)
    {
      return k < axis ? k : k + 1;
    }



    bool
    is_thin(const double volume_fraction)
    {
      return volume_fraction > 0 &&
             volume_fraction < volume_fraction_of_full_cells;
    }
  } // namespace



  // Points of this rank may cover facets in ghost cells. So each rank samples
  // the facets in owned and ghost cells with its own points, and sends the
  // samples covered in ghost cells to the owners.
  template <int dim>
  void
  FacetCoverage<dim>::find(const State<dim>     &state,
                           const VolumeFraction &volume_fraction)
  {
    const auto &owned = facets_.owned();
    reached_.assign(owned.size(), {});
    n_samples_.assign(owned.size(), 0);
    shares_.assign(owned.size(), 1.);
    for (unsigned int f = 0; f < owned.size(); ++f)
      if (is_thin(volume_fraction(owned[f])))
        {
          const unsigned int axis    = axis_across(owned[f]);
          const Samples      samples = samples_of(state.grid, owned[f], axis);
          n_samples_[f]              = samples.size();
          reached_[f] = reached_samples(state, owned[f], axis, samples);
        }
    if (!state.grid.neighbor_ranks().empty())
      {
        pack_ghosts(state, volume_fraction);
        messages_.exchange(state.grid.neighbor_ranks(),
                           outgoing_,
                           [&](const NeighborExchange::Message &message) {
                             receive(state.grid, message);
                           });
      }
    for (unsigned int f = 0; f < owned.size(); ++f)
      if (n_samples_[f] > 0)
        shares_[f] =
          double(__builtin_popcount(reached_[f].covered())) / n_samples_[f];
  }



  /// Whether the cell of the facet contains the surface of a second obstacle.
  template <int dim>
  bool
  FacetCoverage<dim>::shares_cell(const ContactFacet<dim> &facet) const
  {
    bool result = false;
    if (obstacles_.size() > 1)
      facets_.for_each_in_cell(facet.cell, [&](const ContactFacet<dim> &other) {
        result = result || other.obstacle != facet.obstacle;
      });
    return result;
  }



  /// Return the sample points of a facet, m: places of its plane at the centres
  /// of columns of the cell along @p axis, inside the cell and outside of all
  /// obstacles. The centroid if no place is left.
  template <int dim>
  typename FacetCoverage<dim>::Samples
  FacetCoverage<dim>::samples_of(const Grid<dim>         &grid,
                                 const ContactFacet<dim> &facet,
                                 const unsigned int       axis) const
  {
    const Cell<dim> &cell      = grid.cells()[facet.cell];
    const double     tolerance = 1e-6 * cell.size;
    const bool       is_shared = shares_cell(facet);
    Samples          samples;
    for (unsigned int i = 0; i < power(n_columns, dim - 1); ++i)
      {
        Point<dim>   y    = facet.centroid;
        unsigned int rest = i;
        for (unsigned int d = 0; d < dim; ++d)
          if (d != axis)
            {
              y[d] = cell.lower[d] +
                     (rest % n_columns + 0.5) * cell.size / n_columns;
              rest /= n_columns;
            }
        y[axis] -= (y - facet.centroid) * facet.normal / facet.normal[axis];
        if (y[axis] < cell.lower[axis] - tolerance ||
            y[axis] > cell.lower[axis] + cell.size + tolerance)
          continue;
        // The surface of the facet itself may deviate from the plane.
        bool is_open = true;
        if (is_shared)
          for (const unsigned int k : obstacles_.near(y, 0.))
            is_open =
              is_open && obstacles_[k].signed_distance(y) >
                           -(k == facet.obstacle
                               ? std::min(facet.deviation, 0.05 * cell.size)
                               : tolerance);
        if (is_open)
          samples.push_back(y);
      }
    if (samples.empty())
      samples.push_back(facet.centroid);
    return samples;
  }



  /// Return the samples reached by boxes in the cell of the facet and the cells
  /// around. The cell of the facet comes first: its points nearly always cover
  /// all.
  template <int dim>
  typename FacetCoverage<dim>::Reached
  FacetCoverage<dim>::reached_samples(const State<dim>        &state,
                                      const ContactFacet<dim> &facet,
                                      const unsigned int       axis,
                                      const Samples           &samples) const
  {
    const Grid<dim> &grid  = state.grid;
    const Cell<dim> &cell  = grid.cells()[facet.cell];
    const auto      &cells = facets_.touching_cells(facet.cell);
    const Mask       all   = (Mask(1) << samples.size()) - 1;
    Reached          reached;
    for (unsigned int i = 0; i <= cells.size() && reached.covered() != all; ++i)
      {
        const unsigned int c = (i == 0 ? facet.cell : cells[i - 1]);
        if (c >= grid.n_owned_cells() || (i > 0 && c == facet.cell))
          continue;
        // Across a periodic face the neighbour lies at the opposite end.
        Tensor<1, dim> shift;
        for (unsigned int d = 0; d < dim; ++d)
          if (grid.periodicity().along(d))
            {
              const double length = grid.domain().length(d);
              shift[d] =
                length *
                std::round((cell.lower[d] - grid.cells()[c].lower[d]) / length);
            }
        add_points_of(state, c, shift, facet, axis, samples, reached);
      }
    return reached;
  }



  /// Add the samples reached by boxes of the points in cell @p c, moved by
  /// @p shift, m. A box counts if the lower side is near the surface and the
  /// upper side above. A box reaches a quarter of a cell beyond its ends, from
  /// one side only: a hole between two boxes counts as covered, but the end of
  /// a layer is not moved.
  template <int dim>
  void
  FacetCoverage<dim>::add_points_of(const State<dim>        &state,
                                    const unsigned int       c,
                                    const Tensor<1, dim>    &shift,
                                    const ContactFacet<dim> &facet,
                                    const unsigned int       axis,
                                    const Samples           &samples,
                                    Reached                 &reached) const
  {
    const Points<dim> &points   = state.points;
    const auto        &segments = points.segments();
    const double       h        = state.grid.cells()[facet.cell].size;
    const double       n_axis   = facet.normal[axis];
    const double       outwards = (n_axis > 0 ? 1. : -1.);
    const double       largest_gap =
      largest_gap_of_covering_box * h / std::abs(n_axis);
    for (auto segment =
           std::lower_bound(segments.begin(),
                            segments.end(),
                            c,
                            [](const Segment &s, const unsigned int cell) {
                              return s.cell < cell;
                            });
         segment != segments.end() && segment->cell == c;
         ++segment)
      for (unsigned int p = segment->begin; p < segment->end; ++p)
        {
          const Point<dim> x = load_place(points, points.position, p) + shift;
          const Tensor<1, dim> half =
            half_lengths_of_box(points, state.constants.box_shape, p);
          for (unsigned int i = 0; i < samples.size(); ++i)
            {
              const Tensor<1, dim> from   = x - samples[i];
              const double         height = outwards * from[axis];
              if (height - half[axis] < largest_gap && height + half[axis] > 0)
                add_sample(i, from, half, axis, 0.25 * h, reached);
            }
        }
  }



  /// Add sample @p i to @p reached if a box reaches the sample.
  /// @param from centre of the box less sample, m
  /// @param half half lengths of the box, m
  /// @param axis across the facet
  /// @param beyond reach beyond the ends of the box, m
  template <int dim>
  void
  FacetCoverage<dim>::add_sample(const unsigned int    i,
                                 const Tensor<1, dim> &from,
                                 const Tensor<1, dim> &half,
                                 const unsigned int    axis,
                                 const double          beyond,
                                 Reached              &reached) const
  {
    for (unsigned int k = 0; k < dim - 1; ++k)
      {
        const unsigned int d     = across(axis, k);
        const unsigned int other = (dim == 2 ? d : across(axis, 1 - k));
        if (d != other && std::abs(from[other]) > half[other])
          continue;
        if (from[d] <= half[d] && -from[d] <= half[d] + beyond)
          reached.from[2 * k] |= Mask(1) << i;
        if (-from[d] <= half[d] && from[d] <= half[d] + beyond)
          reached.from[2 * k + 1] |= Mask(1) << i;
      }
  }



  namespace
  {
    /// Number of facet @p f among the facets in the same cell.
    template <int dim>
    unsigned int
    number_in_cell(const std::vector<ContactFacet<dim>> &facets,
                   const unsigned int                    f)
    {
      unsigned int first = f;
      while (first > 0 && facets[first - 1].cell == facets[f].cell)
        --first;
      return f - first;
    }
  } // namespace



  /// Fill the messages to the owners of ghost cells. Per facet: key of the
  /// cell, number_in_cell(), masks.
  template <int dim>
  void
  FacetCoverage<dim>::pack_ghosts(const State<dim>     &state,
                                  const VolumeFraction &volume_fraction)
  {
    const Grid<dim> &grid   = state.grid;
    const auto      &ranks  = grid.neighbor_ranks();
    const auto      &ghosts = facets_.ghosts();
    outgoing_.resize(ranks.size());
    for (auto &message : outgoing_)
      message.clear();
    for (unsigned int f = 0; f < ghosts.size(); ++f)
      {
        if (!is_thin(volume_fraction(ghosts[f])))
          continue;
        const unsigned int axis    = axis_across(ghosts[f]);
        const Samples      samples = samples_of(grid, ghosts[f], axis);
        const Reached      reached =
          reached_samples(state, ghosts[f], axis, samples);
        const auto to = std::lower_bound(ranks.begin(),
                                         ranks.end(),
                                         grid.owner_of_cell(ghosts[f].cell)) -
                        ranks.begin();
        double key;
        static_assert(sizeof(key) == sizeof(ghosts[f].key));
        std::memcpy(&key, &ghosts[f].key, sizeof(key));
        outgoing_[to].push_back(key);
        outgoing_[to].push_back(number_in_cell(ghosts, f));
        for (const Mask mask : reached.from)
          outgoing_[to].push_back(mask);
      }
  }



  template <int dim>
  void
  FacetCoverage<dim>::receive(const Grid<dim>                 &grid,
                              const NeighborExchange::Message &message)
  {
    constexpr unsigned int n_masks = 2 * (dim - 1);
    const auto            &owned   = facets_.owned();
    for (std::size_t i = 0; i < message.size(); i += 2 + n_masks)
      {
        unsigned long key;
        std::memcpy(&key, &message[i], sizeof(key));
        const unsigned int c     = grid.cell_of_key(key);
        const auto         first = std::lower_bound(owned.begin(),
                                            owned.end(),
                                            c,
                                            [](const ContactFacet<dim> &facet,
                                               const unsigned int       cell) {
                                              return facet.cell < cell;
                                            });
        Reached           &reached =
          reached_[first - owned.begin() + (unsigned int)(message[i + 1])];
        for (unsigned int k = 0; k < n_masks; ++k)
          reached.from[k] |= Mask(message[i + 2 + k]);
      }
  }



  template class FacetCoverage<2>;
  template class FacetCoverage<3>;
} // namespace talus
