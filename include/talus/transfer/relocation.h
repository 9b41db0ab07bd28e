#ifndef talus_transfer_relocation_h
#define talus_transfer_relocation_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>

#include <array>
#include <vector>

namespace talus
{
  /// Keeps the points sorted by cell as they move. The cost is that of looking
  /// at every point once, plus, when points changed cell, of copying the columns
  /// in a few long runs.
  template <int dim>
  class Relocation
  {
  public:
    /// For each face of the mesh, how far outside a point's centre may lie and
    /// still belong to the boundary cell, in units of that cell: half a cell at
    /// a wall, nothing at a free face.
    void
    allow_outside(const std::array<double, 2 * dim> &fraction)
    {
      allowed_outside_ = fraction;
    }

    /// Find the cells of all points and sort those that changed cell, and those
    /// appended since the last call, into the order. Returns whether the order
    /// changed. Throws ExcPoint, naming the point, if one left the mesh.
    bool
    update(Points<dim> &points, const Grid<dim> &grid);

    /// The same after the mesh changed: nothing is known of the old cells.
    void
    rebuild(Points<dim> &points, const Grid<dim> &grid);

    /// Take over the order that the points have, as a checkpoint restores it.
    void
    adopt(const Points<dim> &points);

    /// Cells that hold points, ascending.
    const std::vector<unsigned int> &
    occupied_cells() const
    {
      return occupied_cells_;
    }

  private:
    struct Mover
    {
      unsigned int cell;
      unsigned int body;
      unsigned int index;
    };

    unsigned int
    locate(const Points<dim> &points,
           const Grid<dim>   &grid,
           unsigned int       p,
           unsigned int       old_cell) const;
    void
    check_inside(const Points<dim> &points,
                 const Grid<dim>   &grid,
                 unsigned int       p,
                 double             cell_size) const;
    void
    find_movers(const Points<dim> &points, const Grid<dim> &grid);
    void
    merge(const Points<dim> &points);
    void
    open_segment(unsigned int cell, unsigned int body);
    void
    add_run(unsigned int begin, unsigned int end);
    void
    add_staying(const Segment &segment, std::size_t &skip);

    std::array<double, 2 * dim> allowed_outside_{};
    std::vector<unsigned int>   occupied_cells_;

    // Kept between calls so that a step does not allocate.
    std::vector<Mover>        movers_;
    std::vector<unsigned int> leaving_; ///< indices of movers, ascending
    std::vector<Run>          runs_;
    std::vector<Segment>      segments_;
    unsigned int              n_merged_ = 0;
  };
} // namespace talus

#endif
