// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/box_extent.h>
#include <talus/contact/contact_area.h>
#include <talus/contact/facet_coverage.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Return whether @p axis is nearest to the normal of a facet. The edge of
    /// a box may have several nearest axes.
    template <int dim>
    bool
    is_across(const ContactFacet<dim> &facet, const unsigned int axis)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (std::abs(facet.normal[axis]) <
            (1. - 1e-6) * std::abs(facet.normal[d]))
          return false;
      return true;
    }



    /// Number @p k of the dim-1 axes across @p axis.
    constexpr unsigned int
    across(const unsigned int axis, const unsigned int k)
    {
      return k < axis ? k : k + 1;
    }



    /// Return the set of places for each set of columns of a lattice of
    /// n^(dim-1) places, by axis of the lattice: bit j is column j.
    template <int dim, unsigned int n>
    constexpr std::array<std::array<unsigned int, power(2, n)>, dim - 1>
    places_of_columns()
    {
      std::array<std::array<unsigned int, power(2, n)>, dim - 1> places{};
      for (unsigned int k = 0; k < dim - 1; ++k)
        for (unsigned int columns = 0; columns < power(2, n); ++columns)
          for (unsigned int i = 0; i < power(n, dim - 1); ++i)
            places[k][columns] |= ((columns >> (i / power(n, k) % n)) & 1u)
                                  << i;
      return places;
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
  FacetCoverage<dim>::find(const State<dim>          &state,
                           const std::vector<double> &fractions,
                           const std::vector<double> &fractions_of_ghosts)
  {
    const auto &owned = facets_.owned();
    index_segments(state);
    if (obstacles_.move())
      samples_.clear();
    samples_.resize(dim * owned.size());
    reached_.assign(dim * owned.size(), {});
    n_samples_.assign(dim * owned.size(), 0);
    shares_.assign(owned.size(), 1.);
    for (unsigned int i = 0; i < dim * owned.size(); ++i)
      if (const ContactFacet<dim> &facet = owned[i / dim];
          is_thin(fractions[i / dim]) && is_across(facet, i % dim))
        {
          if (samples_[i].places == 0)
            samples_[i] = samples_of(state.grid, facet, i % dim);
          n_samples_[i] = samples_[i].size();
          reached_[i]   = reached_samples(state, facet, samples_[i]);
        }
    if (!state.grid.neighbor_ranks().empty())
      {
        pack_ghosts(state, fractions_of_ghosts);
        messages_.exchange(state.grid.neighbor_ranks(),
                           outgoing_,
                           [&](const NeighborExchange::Message &message) {
                             receive(state.grid, message);
                           });
      }
    for (unsigned int f = 0; f < owned.size(); ++f)
      if (is_thin(fractions[f]))
        {
          double       sum    = 0;
          unsigned int n_axes = 0;
          for (unsigned int i = dim * f; i < dim * (f + 1); ++i)
            if (n_samples_[i] > 0)
              {
                sum += double(__builtin_popcount(reached_[i].covered())) /
                       n_samples_[i];
                ++n_axes;
              }
          shares_[f] = sum / n_axes;
        }
  }



  /// Fill the table of the first segment in each cell.
  template <int dim>
  void
  FacetCoverage<dim>::index_segments(const State<dim> &state)
  {
    const auto &segments = state.points.segments();
    first_segment_.assign(state.grid.n_owned_cells(), segments.size());
    for (unsigned int s = segments.size(); s-- > 0;)
      first_segment_[segments[s].cell] = s;
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



  /// Whether the place @p x, m, in the plane of a facet lies outside of all
  /// obstacles. The surface of the facet itself may deviate from the plane.
  template <int dim>
  bool
  FacetCoverage<dim>::is_open(const Cell<dim>         &cell,
                              const ContactFacet<dim> &facet,
                              const Point<dim>        &x) const
  {
    const auto near = obstacles_.near(x, 0.);
    return std::all_of(near.begin(), near.end(), [&](const unsigned int k) {
      return obstacles_[k].signed_distance(x) >
             -(k == facet.obstacle ? std::min(facet.deviation, 0.05 * cell.size)
                                   : 1e-6 * cell.size);
    });
  }



  /// Return the sample points of a facet: places of its plane at the centres of
  /// columns of the cell along @p axis, inside the cell and outside of all
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
    samples.axis = axis;
    for (unsigned int k = 0; k < dim - 1; ++k)
      for (unsigned int j = 0; j < n_columns; ++j)
        samples.column[k][j] =
          cell.lower[across(axis, k)] + (j + 0.5) * cell.size / n_columns;
    for (unsigned int i = 0; i < n_places; ++i)
      {
        Point<dim> y = facet.centroid;
        for (unsigned int k = 0; k < dim - 1; ++k)
          y[across(axis, k)] =
            samples.column[k][i / power(n_columns, k) % n_columns];
        y[axis] -= (y - facet.centroid) * facet.normal / facet.normal[axis];
        if (y[axis] >= cell.lower[axis] - tolerance &&
            y[axis] <= cell.lower[axis] + cell.size + tolerance &&
            (!is_shared || is_open(cell, facet, y)))
          samples.places |= Mask(1) << i;
      }
    if (samples.places == 0)
      {
        samples.places = 1;
        for (unsigned int k = 0; k < dim - 1; ++k)
          samples.column[k].fill(facet.centroid[across(axis, k)]);
      }
    return samples;
  }



  /// Return the samples reached by boxes in the cell of the facet and the cells
  /// around. The cell of the facet comes first: its points nearly always cover
  /// all.
  template <int dim>
  typename FacetCoverage<dim>::Reached
  FacetCoverage<dim>::reached_samples(const State<dim>        &state,
                                      const ContactFacet<dim> &facet,
                                      const Samples           &samples) const
  {
    const Grid<dim> &grid        = state.grid;
    const Cell<dim> &cell        = grid.cells()[facet.cell];
    const auto      &cells       = facets_.touching_cells(facet.cell);
    bool             is_periodic = false;
    for (unsigned int d = 0; d < dim; ++d)
      is_periodic = is_periodic || grid.periodicity().along(d);
    Reached reached;
    for (unsigned int i = 0;
         i <= cells.size() && reached.covered() != samples.places;
         ++i)
      {
        const unsigned int c = (i == 0 ? facet.cell : cells[i - 1]);
        if (c >= grid.n_owned_cells() || (i > 0 && c == facet.cell) ||
            first_segment_[c] == state.points.segments().size())
          continue;
        // Across a periodic face the neighbour lies at the opposite end.
        Tensor<1, dim> shift;
        for (unsigned int d = 0; d < dim && is_periodic; ++d)
          if (grid.periodicity().along(d))
            {
              const double length = grid.domain().length(d);
              shift[d] =
                length *
                std::round((cell.lower[d] - grid.cells()[c].lower[d]) / length);
            }
        add_points_of(state, c, shift, facet, samples, reached);
      }
    return reached;
  }



  namespace
  {
    /// Return whether a box reaches no column of the sample points of a facet.
    /// The columns ascend along each axis.
    /// @param x centre of the box, m
    /// @param half half lengths of the box, m
    /// @param beyond reach beyond the ends of the box, m
    template <int dim, typename Samples>
    bool
    is_beside(const Samples        &samples,
              const Point<dim>     &x,
              const Tensor<1, dim> &half,
              const double          beyond)
    {
      for (unsigned int k = 0; k < dim - 1; ++k)
        {
          const unsigned int d     = across(samples.axis, k);
          const double       reach = half[d] + beyond;
          if (samples.column[k].front() - x[d] > reach ||
              x[d] - samples.column[k].back() > reach)
            return true;
        }
      return false;
    }
  } // namespace



  /// Add the samples reached by boxes of the points in cell @p c, moved by
  /// @p shift, m. A box counts as a whole if it is near the plane of the facet
  /// and not below: over a plane inclined to its sides the box stands for soil
  /// that lies on the plane. A box reaches a third of a cell beyond its ends,
  /// from one side only: a hole between two boxes counts as covered, but the
  /// end of a layer is not moved.
  template <int dim>
  void
  FacetCoverage<dim>::add_points_of(const State<dim>        &state,
                                    const unsigned int       c,
                                    const Tensor<1, dim>    &shift,
                                    const ContactFacet<dim> &facet,
                                    const Samples           &samples,
                                    Reached                 &reached) const
  {
    const Points<dim> &points   = state.points;
    const auto        &segments = points.segments();
    const double       h        = state.grid.cells()[facet.cell].size;
    for (unsigned int s = first_segment_[c];
         s < segments.size() && segments[s].cell == c;
         ++s)
      for (unsigned int p = segments[s].begin; p < segments[s].end; ++p)
        {
          const Point<dim> x = load_place(points, points.position, p) + shift;
          const Tensor<1, dim> half     = half_lengths_of_box(points, p);
          const double         distance = facet.distance_from_plane(x);
          const double         support  = support_of_box(half, facet.normal);
          // Most boxes lie above, below or beside all sample points.
          if (distance - support >= largest_gap_of_covering_box * h ||
              distance + support <= 0 || is_beside(samples, x, half, h / 3.))
            continue;
          const Reached in_plan = reached_in_plan(samples, x, half, h / 3.);
          for (unsigned int k = 0; k < reached.from.size(); ++k)
            reached.from[k] |= in_plan.from[k] & samples.places;
        }
  }



  /// Return the places reached by a box in projection along the axis of the
  /// columns.
  /// @param x centre of the box, m
  /// @param half half lengths of the box, m
  /// @param beyond reach beyond the ends of the box, m
  template <int dim>
  typename FacetCoverage<dim>::Reached
  FacetCoverage<dim>::reached_in_plan(const Samples        &samples,
                                      const Point<dim>     &x,
                                      const Tensor<1, dim> &half,
                                      const double          beyond) const
  {
    static constexpr auto     places = places_of_columns<dim, n_columns>();
    Reached                   reached;
    std::array<Mask, dim - 1> under{}; // by axis across
    for (unsigned int k = 0; k < dim - 1; ++k)
      {
        // Sets of columns, without branches that could not be predicted.
        const unsigned int d      = across(samples.axis, k);
        const double       h      = half[d];
        unsigned int       within = 0, from_below = 0, from_above = 0;
        for (unsigned int j = 0; j < n_columns; ++j)
          {
            const double       from     = x[d] - samples.column[k][j];
            const unsigned int is_below = from <= h;
            const unsigned int is_above = -from <= h;
            within |= (is_below & is_above) << j;
            from_below |= (is_below & (-from <= h + beyond)) << j;
            from_above |= (is_above & (from <= h + beyond)) << j;
          }
        under[k]                = places[k][within];
        reached.from[2 * k]     = places[k][from_below];
        reached.from[2 * k + 1] = places[k][from_above];
      }
    if (dim == 3)
      for (unsigned int k = 0; k < dim - 1; ++k)
        for (unsigned int side = 0; side < 2; ++side)
          reached.from[2 * k + side] &= under[dim - 2 - k];
    return reached;
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
  /// cell, number_in_cell() and axis, masks.
  template <int dim>
  void
  FacetCoverage<dim>::pack_ghosts(const State<dim>          &state,
                                  const std::vector<double> &fractions)
  {
    const Grid<dim> &grid   = state.grid;
    const auto      &ranks  = grid.neighbor_ranks();
    const auto      &ghosts = facets_.ghosts();
    outgoing_.resize(ranks.size());
    for (auto &message : outgoing_)
      message.clear();
    for (unsigned int i = 0; i < dim * ghosts.size(); ++i)
      {
        const unsigned int f = i / dim, axis = i % dim;
        if (!is_thin(fractions[f]) || !is_across(ghosts[f], axis))
          continue;
        const Reached reached =
          reached_samples(state, ghosts[f], samples_of(grid, ghosts[f], axis));
        const auto to = std::lower_bound(ranks.begin(),
                                         ranks.end(),
                                         grid.owner_of_cell(ghosts[f].cell)) -
                        ranks.begin();
        double key;
        static_assert(sizeof(key) == sizeof(ghosts[f].key));
        std::memcpy(&key, &ghosts[f].key, sizeof(key));
        outgoing_[to].push_back(key);
        outgoing_[to].push_back(dim * number_in_cell(ghosts, f) + axis);
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
        const unsigned int c       = grid.cell_of_key(key);
        const auto         first   = std::lower_bound(owned.begin(),
                                            owned.end(),
                                            c,
                                            [](const ContactFacet<dim> &facet,
                                               const unsigned int       cell) {
                                              return facet.cell < cell;
                                            });
        Reached           &reached = reached_[dim * (first - owned.begin()) +
                                    (unsigned int)(message[i + 1])];
        for (unsigned int k = 0; k < n_masks; ++k)
          reached.from[k] |= Mask(message[i + 2 + k]);
      }
  }



  template class FacetCoverage<2>;
  template class FacetCoverage<3>;
} // namespace talus
