// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/problem/filling.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Minimum volume fraction of a box for a point: points much lighter than
    /// the neighbours become unstable.
    constexpr double min_fraction = 0.2;

    /// Volume fraction of a box below which soil counts as round-off, far below
    /// the error of the parts: beyond the end of a layer both surfaces
    /// coincide, and round-off between them would make points of some grams.
    constexpr double round_off_fraction = 1e-5;

    /// Volume fraction of a box below which soil without neighbours is dropped:
    /// where the coinciding surfaces of a layer are curved, the pockets between
    /// them are as thick as the error of the parts, a thousandth of a box.
    constexpr double error_fraction = 1e-3;



    /// Return whether a cell may contain soil; most cells of the mesh are far
    /// from the body.
    template <int dim>
    bool
    overlap(const Cell<dim> &cell, const Box<dim> &bounds)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (!(cell.lower[d] < bounds.upper[d] &&
              cell.lower[d] + cell.size > bounds.lower[d]))
          return false;
      return true;
    }



    /// Return the lengths of the boxes of a cell, @p n along each axis.
    template <int dim>
    Tensor<1, dim>
    lattice_lengths(const Cell<dim>                     &cell,
                    const std::array<unsigned int, dim> &n)
    {
      Tensor<1, dim> length;
      for (unsigned int d = 0; d < dim; ++d)
        length[d] = cell.size / n[d];
      return length;
    }



    /// Return the centres of the boxes of a cell, the first axis fastest.
    template <int dim>
    std::vector<Point<dim>>
    lattice_of(const Cell<dim> &cell, const std::array<unsigned int, dim> &n)
    {
      std::vector<Point<dim>>       centres;
      std::array<unsigned int, dim> at{};
      while (at[dim - 1] < n[dim - 1])
        {
          Point<dim> x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = cell.lower[d] + (at[d] + 0.5) / n[d] * cell.size;
          centres.push_back(x);
          // Counts through all parts of a cell, the first axis fastest.
          ++at[0];
          for (unsigned int d = 0; d + 1 < dim && at[d] == n[d]; ++d)
            {
              at[d] = 0;
              ++at[d + 1];
            }
        }
      return centres;
    }



    /// Check the memory for places. Places take about a tenth of the memory of
    /// the points, but may fill the memory while they are collected. All ranks
    /// together have at least the memory of this machine.
    template <int dim>
    void
    check_memory(const Grid<dim>  &grid,
                 const std::size_t n_points,
                 const double      bytes_per_place)
    {
      const double memory =
        grid.memory_per_rank() *
        Utilities::MPI::n_mpi_processes(grid.communicator());
      AssertThrow(n_points * bytes_per_place < memory,
                  ExcUser(text("There would be more than ",
                               n_points,
                               " points, which take more than the ",
                               memory / 1e9,
                               " GB of available memory. ",
                               fewer_points_advice)));
    }
  } // namespace



  /// Boxes are not cut by the surface of the body: the volume is accurate only
  /// to the size of a point, but the boxes tile the cells, and the weights
  /// begin without gaps and overlaps.
  template <int dim>
  std::vector<NewPoint<dim>>
  filling_by_centres(const Grid<dim>                     &grid,
                     const Region<dim>                   &region,
                     const Box<dim>                      &bounds,
                     const std::array<unsigned int, dim> &n)
  {
    std::vector<NewPoint<dim>> result;
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      if (const Cell<dim> &cell = grid.cells()[c]; overlap(cell, bounds))
        {
          for (const Point<dim> &x : lattice_of<dim>(cell, n))
            if (region.contains(x))
              result.push_back({x, lattice_lengths<dim>(cell, n)});
          // In the run a point takes more than five times the memory of a
          // place.
          check_memory(grid, result.size(), 5. * sizeof(NewPoint<dim>));
        }
    return result;
  }



  namespace
  {
    /// Sliver given to a box: receiving cell and box, giving cell and box
    /// (cells by global keys); volume, m^dim, centroid and variance. The sorted
    /// order is independent of the number of ranks.
    template <int dim>
    using SliverTransfer =
      std::pair<std::array<unsigned long, 4>, std::array<double, 1 + 2 * dim>>;



    /// Boxes of the lattice in the cells known to this rank, ghosts included,
    /// with the part of each box in the region. All ranks know the shapes.
    template <int dim>
    class ClippedBoxes
    {
    public:
      ClippedBoxes(const Grid<dim>                     &grid,
                   const Region<dim>                   &region,
                   const Box<dim>                      &bounds,
                   const std::array<unsigned int, dim> &n);

      /// Give slivers to neighbours. Collective.
      void
      merge_slivers();

      /// Return points for the present parts.
      std::vector<NewPoint<dim>>
      points() const;

    private:
      using Parts = std::vector<PartInside<dim>>;

      Parts
      parts_of_cell(const Cell<dim> &cell, const Region<dim> &region) const;
      double
      volume_of_box(unsigned int cell) const;
      bool
      is_kept(const PartInside<dim> &part, unsigned int cell) const;
      std::pair<unsigned int, unsigned int>
      nearest_kept(const Point<dim> &x, unsigned int cell) const;
      std::pair<unsigned int, unsigned int>
      largest_neighbour(unsigned int cell, unsigned int box) const;
      std::vector<unsigned int>
      cells_around(unsigned int cell) const;
      std::map<unsigned int, std::vector<SliverTransfer<dim>>>
      take_slivers();
      void
      receive(const std::vector<SliverTransfer<dim>> &sliver_transfers);
      Parts &
      changing_parts(unsigned int cell);

      const Grid<dim>              &grid_;
      std::array<unsigned int, dim> n_;
      // By cell; cells without parts are missing.
      std::map<unsigned int, Parts> parts_; // before merging
      // Present parts of the cells that have given or received a sliver.
      std::map<unsigned int, Parts> now_;
    };



    template <int dim>
    ClippedBoxes<dim>::ClippedBoxes(const Grid<dim>                     &grid,
                                    const Region<dim>                   &region,
                                    const Box<dim>                      &bounds,
                                    const std::array<unsigned int, dim> &n)
      : grid_(grid)
      , n_(n)
    {
      std::size_t n_boxes = 0;
      for (unsigned int c = 0; c < grid.cells().size(); ++c)
        {
          const Cell<dim> &cell = grid.cells()[c];
          if (!overlap(cell, bounds))
            continue;
          Parts parts = parts_of_cell(cell, region);
          n_boxes += parts.size();
          // The points are made while the parts still exist.
          check_memory(grid,
                       n_boxes,
                       sizeof(PartInside<dim>) + sizeof(NewPoint<dim>));
          if (!parts.empty())
            parts_.emplace(c, std::move(parts));
        }
    }



    /// Return the parts of the boxes of a cell, none if the cell is outside. A
    /// whole box gets the exact centre: bodies of whole boxes equal a filling
    /// by centres bit by bit.
    template <int dim>
    typename ClippedBoxes<dim>::Parts
    ClippedBoxes<dim>::parts_of_cell(const Cell<dim>   &cell,
                                     const Region<dim> &region) const
    {
      const Tensor<1, dim> length = lattice_lengths<dim>(cell, n_);
      double               whole  = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        whole *= length[d];
      Parts parts;
      bool  is_empty = true;
      for (const Point<dim> &centre : lattice_of<dim>(cell, n_))
        {
          const Box<dim> box{centre - 0.5 * length, centre + 0.5 * length};
          parts.push_back(region.part_inside(box));
          if (parts.back().volume < round_off_fraction * whole)
            parts.back().volume = 0.;
          is_empty = is_empty && parts.back().volume == 0.;
        }
      return is_empty ? Parts() : parts;
    }



    template <int dim>
    double
    ClippedBoxes<dim>::volume_of_box(const unsigned int cell) const
    {
      double volume = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        volume *= grid_.cells()[cell].size / n_[d];
      return volume;
    }



    template <int dim>
    bool
    ClippedBoxes<dim>::is_kept(const PartInside<dim> &part,
                               const unsigned int     cell) const
    {
      return part.volume >= min_fraction * volume_of_box(cell);
    }



    /// Return the cells, owned or ghosts, that share a corner with @p cell,
    /// except across periodic faces.
    template <int dim>
    std::vector<unsigned int>
    ClippedBoxes<dim>::cells_around(const unsigned int cell) const
    {
      const Cell<dim>          &own = grid_.cells()[cell];
      std::vector<unsigned int> known;
      if (own.uniform)
        known.assign(own.neighbors.begin(), own.neighbors.end());
      else
        known = grid_.touching_cells(cell);
      std::vector<unsigned int> around;
      for (const unsigned int c : known)
        {
          if (c == numbers::invalid_unsigned_int)
            continue;
          const Cell<dim> &other   = grid_.cells()[c];
          const double     epsilon = 1e-6 * own.size;
          bool             touches = true;
          for (unsigned int d = 0; d < dim; ++d)
            touches = touches &&
                      other.lower[d] <= own.lower[d] + own.size + epsilon &&
                      own.lower[d] <= other.lower[d] + other.size + epsilon;
          if (touches)
            around.push_back(c);
        }
      return around;
    }



    /// Return cell and box of the nearest kept part; invalid_unsigned_int if
    /// there is none. At equal distance the smaller key of the cell wins,
    /// independently of the ranks.
    template <int dim>
    std::pair<unsigned int, unsigned int>
    ClippedBoxes<dim>::nearest_kept(const Point<dim>  &x,
                                    const unsigned int cell) const
    {
      using Rank = std::tuple<double, unsigned long, unsigned int>;
      Rank                                  least;
      std::pair<unsigned int, unsigned int> nearest{
        numbers::invalid_unsigned_int, 0};
      for (const unsigned int c : cells_around(cell))
        if (const auto parts = parts_.find(c); parts != parts_.end())
          for (unsigned int i = 0; i < parts->second.size(); ++i)
            if (const auto &part = parts->second[i]; is_kept(part, c))
              {
                const Rank rank(part.centroid.distance_square(x),
                                grid_.key_of_cell(c),
                                i);
                if (nearest.first == numbers::invalid_unsigned_int ||
                    rank < least)
                  {
                    least   = rank;
                    nearest = {c, i};
                  }
              }
      return nearest;
    }



    /// Return cell and box of the largest part around, if so much larger than
    /// part @p box that both could not be neighbouring points.
    template <int dim>
    std::pair<unsigned int, unsigned int>
    ClippedBoxes<dim>::largest_neighbour(const unsigned int cell,
                                         const unsigned int box) const
    {
      using Rank = std::tuple<double, unsigned long, unsigned int>;
      Rank largest(parts_.at(cell)[box].volume / min_fraction, 0, 0);
      std::pair<unsigned int, unsigned int> result{
        numbers::invalid_unsigned_int, 0};
      for (const unsigned int c : cells_around(cell))
        if (const auto parts = parts_.find(c); parts != parts_.end())
          for (unsigned int i = 0; i < parts->second.size(); ++i)
            if (const Rank rank(parts->second[i].volume,
                                grid_.key_of_cell(c),
                                i);
                rank > largest)
              {
                largest = rank;
                result  = {c, i};
              }
      return result;
    }



    /// Return the present parts of @p cell, copied from the initial parts at
    /// the first change.
    template <int dim>
    typename ClippedBoxes<dim>::Parts &
    ClippedBoxes<dim>::changing_parts(const unsigned int cell)
    {
      return now_.try_emplace(cell, parts_.at(cell)).first->second;
    }



    /// Remove the slivers on this rank and return them, by receiving rank.
    /// Where soil thins out so slowly that there is no kept box around, slivers
    /// go to the largest box and possibly further. Each receiver was initially
    /// larger than the giver, and therefore the process ends. Soil that is thin
    /// everywhere stays.
    template <int dim>
    std::map<unsigned int, std::vector<SliverTransfer<dim>>>
    ClippedBoxes<dim>::take_slivers()
    {
      std::map<unsigned int, std::vector<SliverTransfer<dim>>> sliver_transfers;
      for (const auto &[cell, first] : parts_)
        for (unsigned int i = 0; i < first.size(); ++i)
          {
            if (cell >= grid_.n_owned_cells() || first[i].volume == 0. ||
                is_kept(first[i], cell))
              continue;
            PartInside<dim> &part = changing_parts(cell)[i];
            if (part.volume == 0.)
              continue;
            auto [to_cell, to_box] = nearest_kept(part.centroid, cell);
            if (to_cell == numbers::invalid_unsigned_int)
              std::tie(to_cell, to_box) = largest_neighbour(cell, i);
            if (to_cell == numbers::invalid_unsigned_int)
              continue;
            SliverTransfer<dim> transfer_of_sliver;
            transfer_of_sliver.first = {
              {grid_.key_of_cell(to_cell), to_box, grid_.key_of_cell(cell), i}};
            transfer_of_sliver.second = {{part.volume}};
            for (unsigned int d = 0; d < dim; ++d)
              {
                transfer_of_sliver.second[1 + d]       = part.centroid[d];
                transfer_of_sliver.second[1 + dim + d] = part.variance[d];
              }
            sliver_transfers[grid_.owner_of_cell(to_cell)].push_back(
              transfer_of_sliver);
            part.volume = 0.;
          }
      return sliver_transfers;
    }



    /// The owner of a sliver knows all surrounding cells and decides; no rank
    /// needs cells beyond the ghosts.
    template <int dim>
    void
    ClippedBoxes<dim>::merge_slivers()
    {
      for (bool are_all_at_home = false; !are_all_at_home;)
        {
          std::vector<SliverTransfer<dim>> received;
          for (const auto &[rank, sliver_transfers] :
               Utilities::MPI::some_to_some(grid_.communicator(),
                                            take_slivers()))
            received.insert(received.end(),
                            sliver_transfers.begin(),
                            sliver_transfers.end());
          std::sort(received.begin(), received.end());
          receive(received);
          are_all_at_home = !Utilities::MPI::logical_or(!received.empty(),
                                                        grid_.communicator());
        }
    }



    template <int dim>
    void
    ClippedBoxes<dim>::receive(
      const std::vector<SliverTransfer<dim>> &sliver_transfers)
    {
      for (const auto &[names, numbers] : sliver_transfers)
        {
          PartInside<dim> &part =
            changing_parts(grid_.cell_of_key(names[0]))[names[1]];
          // Steiner: the variance of two parts is the mean variance plus the
          // variance of the two centroids.
          const double share = numbers[0] / (part.volume + numbers[0]);
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double distance = numbers[1 + d] - part.centroid[d];
              part.centroid[d] += share * distance;
              part.variance[d] +=
                share * (numbers[1 + dim + d] - part.variance[d]) +
                share * (1. - share) * distance * distance;
            }
          part.volume += numbers[0];
        }
    }



    /// Return the lengths of a box with the volume of @p part and the ratios of
    /// the second moments. A part cut along one axis keeps the other lengths:
    /// soil that ends on a plane across an axis is still tiled.
    template <int dim>
    Tensor<1, dim>
    lengths_of(const PartInside<dim> &part)
    {
      Tensor<1, dim> length;
      double         product = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        {
          length[d] = std::sqrt(part.variance[d]);
          product *= length[d];
        }
      return std::pow(part.volume / product, 1. / dim) * length;
    }



    template <int dim>
    std::vector<NewPoint<dim>>
    ClippedBoxes<dim>::points() const
    {
      std::size_t n_boxes = 0;
      for (const auto &[c, parts] : parts_)
        n_boxes += (c < grid_.n_owned_cells() ? parts.size() : 0);
      std::vector<NewPoint<dim>> result;
      result.reserve(n_boxes);
      for (const auto &[c, first] : parts_)
        {
          if (c >= grid_.n_owned_cells())
            break;
          const auto   changed = now_.find(c);
          const Parts &parts =
            (changed == now_.end() ? first : changed->second);
          const Cell<dim>     &cell    = grid_.cells()[c];
          const auto           centres = lattice_of<dim>(cell, n_);
          const Tensor<1, dim> length  = lattice_lengths<dim>(cell, n_);
          for (unsigned int i = 0; i < parts.size(); ++i)
            {
              const double volume = parts[i].volume, whole = volume_of_box(c);
              if (std::abs(volume - whole) <= 1e-12 * whole)
                result.push_back({centres[i], length});
              else if (volume > error_fraction * whole)
                result.push_back({parts[i].centroid, lengths_of(parts[i])});
            }
        }
      return result;
    }
  } // namespace



  template <int dim>
  std::vector<NewPoint<dim>>
  clipped_filling(const Grid<dim>                     &grid,
                  const Region<dim>                   &region,
                  const Box<dim>                      &bounds,
                  const std::array<unsigned int, dim> &n)
  {
    ClippedBoxes<dim> boxes(grid, region, bounds, n);
    boxes.merge_slivers();
    return boxes.points();
  }



  template decltype(filling_by_centres<2>) filling_by_centres<2>;
  template decltype(filling_by_centres<3>) filling_by_centres<3>;
  template decltype(clipped_filling<2>)    clipped_filling<2>;
  template decltype(clipped_filling<3>)    clipped_filling<3>;
} // namespace talus
