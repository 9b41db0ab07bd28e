#ifndef talus_grid_cell_h
#define talus_grid_cell_h

#include <talus/base/box.h>
#include <talus/base/large_pages.h>

#include <deal.II/base/point.h>

#include <array>
#include <utility>
#include <vector>

namespace talus
{
  constexpr unsigned int
  power(const unsigned int base, const unsigned int exponent)
  {
    return exponent == 0 ? 1 : base * power(base, exponent - 1);
  }

  /// What the transfer needs to know about a cell of the background grid. In 2-D
  /// two lines of the cache: what finding a point's cell takes, and the patch.
  template <int dim>
  struct alignas(64) Cell
  {
    dealii::Point<dim> lower; ///< corner, m
    double             size;  ///< length of the edges, m

    /// True if all neighbours, across corners too, have the same size. Then
    /// the patch is complete.
    bool uniform;

    /// Neighbours of the same size, 3 per axis, x fastest, the cell itself in
    /// the middle; invalid_unsigned_int beyond the boundary of the mesh or
    /// where there is no active cell of the same size.
    std::array<unsigned int, power(3, dim)> neighbors;

    /// Nodes of the patch from one cell below to one cell above, 4 per axis,
    /// x fastest. Beyond the boundary of the mesh the outer row repeats the
    /// boundary row: the boundary cell is continued outwards with shape
    /// functions that are constant along the normal. The inner 2^dim entries
    /// are the cell's own nodes, valid also where the cell is not uniform.
    std::array<unsigned int, power(4, dim)> patch;
  };



  template <int dim>
  using Cells = LargePageVector<Cell<dim>>;



  /// A box in which cells are halved some times.
  template <int dim>
  struct RefinementBox
  {
    Box<dim>     box;
    unsigned int n_levels;
  };



  /// What a node on a face of the mesh stands for, hanging nodes condensed.
  struct FaceShare
  {
    /// Integral of its shape function over the face, m^(dim-1).
    double area = 0;
    /// Integral of its shape function over the cells at the face, m^dim.
    double volume = 0;
  };



  /// A hanging node: its value is a mean of those of its masters.
  struct HangingNode
  {
    unsigned int                                 node;
    std::vector<std::pair<unsigned int, double>> masters;
  };
} // namespace talus

#endif
