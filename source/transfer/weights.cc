#include <talus/transfer/weights.h>
#include <talus/transfer/weights_kernel.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Share of the two hats of one cell in a box, along one axis.
    struct CellShare
    {
      std::array<double, 2> value{};
      std::array<double, 2> gradient{};
    };



    /// The cell [lower, lower + size] is continued with constant shape
    /// functions where it lies at the boundary of the mesh.
    CellShare
    share_of_cell(const double a,
                  const double b,
                  const double lower,
                  const double size,
                  const bool   at_lower_boundary,
                  const bool   at_upper_boundary)
    {
      const double upper  = lower + size;
      const double below  = std::max(0., std::min(b, lower) - a);
      const double above  = std::max(0., b - std::max(a, upper));
      const double first  = std::clamp(a, lower, upper);
      const double last   = std::clamp(b, lower, upper);
      const double inside = last - first;
      const double xi     = (0.5 * (first + last) - lower) / size;

      CellShare share;
      share.value    = {{inside * (1. - xi), inside * xi}};
      share.gradient = {{-inside / size, inside / size}};
      if (at_lower_boundary)
        share.value[0] += below;
      if (at_upper_boundary)
        share.value[1] += above;
      for (unsigned int i = 0; i < 2; ++i)
        {
          share.value[i] /= b - a;
          share.gradient[i] /= b - a;
        }
      return share;
    }



    /// @param lower corner of the cell or, across a periodic face, of its image.
    template <int dim>
    void
    add_cell(const Grid<dim>              &grid,
             const Cell<dim>              &cell,
             const Point<dim>             &lower,
             const Point<dim>             &centre,
             const Tensor<1, dim>         &half,
             std::vector<NodeWeight<dim>> &weights)
    {
      const Box<dim>            &domain = grid.domain();
      const double               eps    = 1e-9 * cell.size;
      std::array<CellShare, dim> share;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const bool ends   = !grid.periodicity().along(d);
          const bool lowest = ends && lower[d] < domain.lower[d] + eps;
          const bool highest =
            ends && lower[d] + cell.size > domain.upper[d] - eps;
          share[d] = share_of_cell(centre[d] - half[d],
                                   centre[d] + half[d],
                                   lower[d],
                                   cell.size,
                                   lowest,
                                   highest);
          if (share[d].value[0] == 0 && share[d].value[1] == 0)
            return;
        }
      for (unsigned int v = 0; v < power(2, dim); ++v)
        {
          NodeWeight<dim> weight;
          unsigned int    at = 0;
          weight.value       = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            weight.gradient[d] = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const unsigned int i = (v >> d) & 1;
              at += (1 + i) * power(4, d);
              weight.value *= share[d].value[i];
              for (unsigned int e = 0; e < dim; ++e)
                weight.gradient[e] *=
                  (d == e ? share[d].gradient[i] : share[d].value[i]);
            }
          weight.node = cell.patch[at];
          weights.push_back(weight);
        }
    }
  } // namespace



  template <int dim>
  void
  general_weights(const Grid<dim>              &grid,
                  const unsigned int            c,
                  const Point<dim>             &centre,
                  const Tensor<1, dim>         &half,
                  std::vector<NodeWeight<dim>> &weights)
  {
    weights.clear();
    const Cell<dim> &cell = grid.cells()[c];
    if (cell.uniform)
      {
        for (unsigned int k = 0; k < cell.neighbors.size(); ++k)
          if (const unsigned int n = cell.neighbors[k];
              n != numbers::invalid_unsigned_int)
            {
              Point<dim> lower = cell.lower;
              for (unsigned int d = 0; d < dim; ++d)
                lower[d] += (k / power(3, d) % 3 - 1.) * cell.size;
              add_cell(grid, grid.cells()[n], lower, centre, half, weights);
            }
      }
    else
      for (const unsigned int n : grid.touching_cells(c))
        {
          const Cell<dim> &touching = grid.cells()[n];
          add_cell(grid, touching, touching.lower, centre, half, weights);
        }
  }



  template <int dim>
  void
  weights_of_point(const Points<dim>            &points,
                   const Grid<dim>              &grid,
                   const BoxShape               &shape,
                   const unsigned int            c,
                   const unsigned int            p,
                   std::vector<NodeWeight<dim>> &weights)
  {
    const double   size = grid.cells()[c].size;
    Point<dim>     centre;
    Tensor<1, dim> half;
    for (unsigned int d = 0; d < dim; ++d)
      {
        centre[d] = points.data(points.position, d)[p];
        half[d] =
          size * half_length_in_cells<dim>(points, shape, d, p, 1. / size);
      }
    general_weights(grid, c, centre, half, weights);
    Assert(std::abs(std::accumulate(weights.begin(),
                                    weights.end(),
                                    -1.,
                                    [](const double           sum,
                                       const NodeWeight<dim> &weight) {
                                      return sum + weight.value;
                                    })) < 1e-12,
           ExcMessage("The weights of a point do not sum to one."));
  }



  template void
  general_weights(const Grid<2> &,
                  unsigned int,
                  const Point<2> &,
                  const Tensor<1, 2> &,
                  std::vector<NodeWeight<2>> &);
  template void
  general_weights(const Grid<3> &,
                  unsigned int,
                  const Point<3> &,
                  const Tensor<1, 3> &,
                  std::vector<NodeWeight<3>> &);
  template void
  weights_of_point(const Points<2> &,
                   const Grid<2> &,
                   const BoxShape &,
                   unsigned int,
                   unsigned int,
                   std::vector<NodeWeight<2>> &);
  template void
  weights_of_point(const Points<3> &,
                   const Grid<3> &,
                   const BoxShape &,
                   unsigned int,
                   unsigned int,
                   std::vector<NodeWeight<3>> &);
} // namespace talus
