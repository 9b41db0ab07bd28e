// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/problem/filling.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/array.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Minimum volume fraction of a box for a point: points much lighter than
    /// the neighbours become unstable. Just below a fifth, so that round-off
    /// does not decide about boxes with a fifth.
    constexpr double min_fraction = 0.2 - 1e-9;

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
      unsigned int n_boxes = 1;
      for (const unsigned int n_along_axis : n)
        n_boxes *= n_along_axis;
      std::vector<Point<dim>> centres(n_boxes);
      for (unsigned int i = 0; i < n_boxes; ++i)
        for (unsigned int d = 0, rest = i; d < dim; rest /= n[d++])
          centres[i][d] =
            cell.lower[d] + (rest % n[d] + 0.5) / n[d] * cell.size;
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



  template <int dim>
  std::vector<Box<dim>>
  boxes_with_soil(const Region<dim> &region,
                  const Box<dim>    &bounds,
                  const double       size)
  {
    std::array<unsigned int, dim> n;
    unsigned int                  n_boxes = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        n[d] = std::max(1., std::ceil(bounds.length(d) / size));
        n_boxes *= n[d];
      }
    std::vector<Box<dim>> result;
    for (unsigned int i = 0; i < n_boxes; ++i)
      {
        Box<dim> box;
        for (unsigned int d = 0, rest = i; d < dim; rest /= n[d++])
          {
            const double length = bounds.length(d) / n[d];
            box.lower[d]        = bounds.lower[d] + (rest % n[d]) * length;
            box.upper[d]        = box.lower[d] + length;
          }
        if (region.part_inside(box).volume > 0.)
          result.push_back(box);
      }
    return result;
  }



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
    /// Sliver given by a box to another box.
    template <int dim>
    struct SliverTransfer
    {
      /// Receiving cell and box, giving cell and box; cells by global keys.
      std::array<unsigned long, 4> place;
      PartInside<dim>              sliver;

      /// The sorted order is independent of the number of ranks.
      bool
      operator<(const SliverTransfer &other) const
      {
        return place < other.place;
      }

      /// Serialize for MPI messages.
      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &place &sliver.volume &sliver.centroid &sliver.variance;
      }
    };



    /// Add the volume and the moments of a sliver to @p part. By Steiner's
    /// theorem the variance of the union is the mean of the two variances plus
    /// the variance of the two centroids, both weighted by volume.
    template <int dim>
    void
    add(PartInside<dim> &part, const PartInside<dim> &sliver)
    {
      const double share = sliver.volume / (part.volume + sliver.volume);
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double distance = sliver.centroid[d] - part.centroid[d];
          part.centroid[d] += share * distance;
          part.variance[d] += share * (sliver.variance[d] - part.variance[d]) +
                              share * (1. - share) * distance * distance;
        }
      part.volume += sliver.volume;
    }



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

      /// Return a point for each box of the owned cells that has soil.
      std::vector<NewPoint<dim>>
      points() const;

    private:
      using Parts = std::vector<PartInside<dim>>;

      /// Parts of the boxes of a cell.
      struct ClippedCell
      {
        Parts first; ///< initial parts, which decide where slivers go
        Parts now;   ///< present parts; empty before the first change

        const Parts &
        parts() const
        {
          return now.empty() ? first : now;
        }

        Parts &
        changing_parts()
        {
          if (now.empty())
            now = first;
          return now;
        }
      };

      Parts
      parts_of_cell(const Cell<dim> &cell, const Region<dim> &region) const;
      double
      volume_of_box(const Cell<dim> &cell) const;
      bool
      is_kept(const PartInside<dim> &part, unsigned int cell) const;
      std::vector<unsigned int>
      cells_around(unsigned int cell) const;
      std::vector<std::pair<unsigned int, unsigned int>>
      receivers(const PartInside<dim> &sliver,
                double                 first_volume,
                unsigned int           cell) const;
      std::map<unsigned int, std::vector<SliverTransfer<dim>>>
      take_slivers();

      const Grid<dim>                    &grid_;
      std::array<unsigned int, dim>       n_;
      std::map<unsigned int, ClippedCell> cells_; ///< cells with soil
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
            cells_[c].first = std::move(parts);
        }
    }



    /// Return the parts of the boxes of a cell, none if the cell has no soil. A
    /// whole box gets the exact centre: bodies of whole boxes equal a filling
    /// by centres bit by bit.
    template <int dim>
    typename ClippedBoxes<dim>::Parts
    ClippedBoxes<dim>::parts_of_cell(const Cell<dim>   &cell,
                                     const Region<dim> &region) const
    {
      if (!region.may_overlap(cell.box()))
        return {};
      const Tensor<1, dim> length   = lattice_lengths<dim>(cell, n_);
      const double         whole    = volume_of_box(cell);
      bool                 is_empty = true;
      Parts                parts;
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
    ClippedBoxes<dim>::volume_of_box(const Cell<dim> &cell) const
    {
      double volume = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        volume *= cell.size / n_[d];
      return volume;
    }



    template <int dim>
    bool
    ClippedBoxes<dim>::is_kept(const PartInside<dim> &part,
                               const unsigned int     cell) const
    {
      return part.volume >= min_fraction * volume_of_box(grid_.cells()[cell]);
    }



    /// Return the cells, owned or ghosts, that share a corner with @p cell,
    /// except across periodic faces.
    template <int dim>
    std::vector<unsigned int>
    ClippedBoxes<dim>::cells_around(const unsigned int cell) const
    {
      const Cell<dim>          &own = grid_.cells()[cell];
      std::vector<unsigned int> around;
      if (own.uniform)
        around.assign(own.neighbors.begin(), own.neighbors.end());
      else
        around = grid_.touching_cells(cell);
      const auto is_apart = [&](const unsigned int c) {
        if (c == numbers::invalid_unsigned_int)
          return true;
        const Cell<dim> &other   = grid_.cells()[c];
        const double     epsilon = 1e-6 * own.size;
        for (unsigned int d = 0; d < dim; ++d)
          if (other.lower[d] > own.lower[d] + own.size + epsilon ||
              own.lower[d] > other.lower[d] + other.size + epsilon)
            return true;
        return false;
      };
      around.erase(std::remove_if(around.begin(), around.end(), is_apart),
                   around.end());
      return around;
    }



    /// Return cells and boxes that receive a sliver of @p cell, in equal parts:
    /// the nearest kept box, or all of them at the same distance. Without a
    /// kept box around, return the box with the largest initial volume, if so
    /// much larger than @p first_volume, the initial volume of the giving box,
    /// m^dim, that both could not be neighbouring points.
    template <int dim>
    std::vector<std::pair<unsigned int, unsigned int>>
    ClippedBoxes<dim>::receivers(const PartInside<dim> &sliver,
                                 const double           first_volume,
                                 const unsigned int     cell) const
    {
      std::vector<std::pair<unsigned int, unsigned int>> result;
      bool                                               best_is_kept = false;
      double                                             best         = 0;
      for (const unsigned int c : cells_around(cell))
        if (const auto boxes = cells_.find(c); boxes != cells_.end())
          for (unsigned int i = 0; i < boxes->second.first.size(); ++i)
            {
              const PartInside<dim> &part = boxes->second.first[i];
              const bool             kept = is_kept(part, c);
              if (kept < best_is_kept ||
                  (!kept && part.volume < first_volume / min_fraction))
                continue;
              const double value =
                kept ? part.centroid.distance_square(sliver.centroid)
                     : -part.volume;
              const double round_off = 1e-9 * std::abs(best);
              if (result.empty() || kept != best_is_kept ||
                  value < best - round_off)
                {
                  result.clear();
                  best_is_kept = kept;
                  best         = value;
                }
              if (value <= best + round_off)
                result.push_back({c, i});
            }
      return result;
    }



    /// Remove the slivers on this rank and return them, by receiving rank.
    /// Each receiver was initially larger than the giver, and therefore the
    /// process ends. Soil that is thin everywhere stays.
    template <int dim>
    std::map<unsigned int, std::vector<SliverTransfer<dim>>>
    ClippedBoxes<dim>::take_slivers()
    {
      std::map<unsigned int, std::vector<SliverTransfer<dim>>> result;
      for (auto &[c, boxes] : cells_)
        for (unsigned int i = 0;
             c < grid_.n_owned_cells() && i < boxes.first.size();
             ++i)
          {
            const PartInside<dim> &first  = boxes.first[i];
            PartInside<dim>        sliver = boxes.parts()[i];
            if (sliver.volume == 0. || is_kept(first, c))
              continue;
            const auto to = receivers(sliver, first.volume, c);
            if (to.empty())
              continue;
            sliver.volume /= to.size();
            for (const auto &[cell, box] : to)
              result[grid_.owner_of_cell(cell)].push_back(
                {{{grid_.key_of_cell(cell), box, grid_.key_of_cell(c), i}},
                 sliver});
            boxes.changing_parts()[i].volume = 0.;
          }
      return result;
    }



    /// Move slivers until all have arrived. The owner of a sliver knows all
    /// surrounding cells and decides; no rank needs cells beyond the ghosts.
    template <int dim>
    void
    ClippedBoxes<dim>::merge_slivers()
    {
      for (bool have_moved = true; have_moved;)
        {
          std::vector<SliverTransfer<dim>> received;
          for (const auto &[rank, transfers] :
               Utilities::MPI::some_to_some(grid_.communicator(),
                                            take_slivers()))
            received.insert(received.end(), transfers.begin(), transfers.end());
          std::sort(received.begin(), received.end());
          for (const auto &[place, sliver] : received)
            add(
              cells_.at(grid_.cell_of_key(place[0])).changing_parts()[place[1]],
              sliver);
          have_moved =
            Utilities::MPI::logical_or(!received.empty(), grid_.communicator());
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
      const auto  end     = cells_.lower_bound(grid_.n_owned_cells());
      std::size_t n_boxes = 0;
      for (auto boxes = cells_.begin(); boxes != end; ++boxes)
        n_boxes += boxes->second.first.size();
      std::vector<NewPoint<dim>> result;
      result.reserve(n_boxes);
      for (auto boxes = cells_.begin(); boxes != end; ++boxes)
        {
          const Cell<dim>     &cell    = grid_.cells()[boxes->first];
          const Parts         &parts   = boxes->second.parts();
          const auto           centres = lattice_of<dim>(cell, n_);
          const Tensor<1, dim> length  = lattice_lengths<dim>(cell, n_);
          const double         whole   = volume_of_box(cell);
          for (unsigned int i = 0; i < parts.size(); ++i)
            if (std::abs(parts[i].volume - whole) <= 1e-12 * whole)
              result.push_back({centres[i], length});
            else if (parts[i].volume > error_fraction * whole)
              result.push_back({parts[i].centroid, lengths_of(parts[i])});
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



  template decltype(boxes_with_soil<2>)    boxes_with_soil<2>;
  template decltype(boxes_with_soil<3>)    boxes_with_soil<3>;
  template decltype(filling_by_centres<2>) filling_by_centres<2>;
  template decltype(filling_by_centres<3>) filling_by_centres<3>;
  template decltype(clipped_filling<2>)    clipped_filling<2>;
  template decltype(clipped_filling<3>)    clipped_filling<3>;
} // namespace talus
