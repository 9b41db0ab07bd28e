// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/nodal_pore_pressure.h>
#include <talus/points/points_kernel.h>
#include <talus/transfer/weights.h>

#include <algorithm>
#include <array>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  NodalPorePressure<dim>::prepare(const Grid<dim> &grid)
  {
    sums_.clear();
    exchange_.prepare(grid, width);
  }



  // Hanging nodes give their sums to their masters, as nodal masses do.
  template <int dim>
  void
  NodalPorePressure<dim>::find(const State<dim>                 &state,
                               const std::vector<unsigned char> &is_needed)
  {
    const Grid<dim> &grid = state.grid;
    sums_.assign(std::size_t(width) * grid.n_nodes(), 0.);
    const Points<dim> &points = state.points;
    points.for_each_cell(points.all(), [&](const Batch &cell) {
      const unsigned int c     = points.segments(cell)[0].cell;
      const Cell<dim>   &here  = grid.cells()[c];
      const auto         needs = [&](const unsigned int node) {
        return is_needed[node] != 0;
      };
      if (!here.uniform ||
          std::any_of(here.patch.begin(), here.patch.end(), needs))
        add_cell(state, is_needed, c, cell.begin, cell.end);
    });
    for (const auto &hanging : grid.hanging_nodes())
      for (unsigned int k = 0; k < width; ++k)
        for (const auto &[master, weight] : hanging.masters)
          sums_[width * master + k] += weight * sums_[width * hanging.node + k];
    exchange_.add_to_owners(sums_.data());
    exchange_.copy_to_ghosts(sums_.data());
  }



  // Near cells of one size the weights are products at the nodes of a patch.
  template <int dim>
  void
  NodalPorePressure<dim>::add_cell(const State<dim>                 &state,
                                   const std::vector<unsigned char> &is_needed,
                                   const unsigned int                cell,
                                   const unsigned int                begin,
                                   const unsigned int                end)
  {
    const Points<dim>  &points   = state.points;
    const Cell<dim>    &here     = state.grid.cells()[cell];
    const BoxShape     &shape    = state.constants.box_shape;
    const double *const pressure = points.data(points.pore_pressure());
    const bool          has_patch =
      here.uniform && shape.rule != BoxRule::convected_domain;
    weights_.clear();
    std::array<unsigned int, power(4, dim)> entry; // of the patch
    for (unsigned int k = 0; k < entry.size() && has_patch; ++k)
      if (is_needed[here.patch[k]])
        {
          entry[weights_.size()] = k;
          weights_.push_back({here.patch[k], 0., {}});
        }
    for (unsigned int p = begin; p < end; ++p)
      {
        if (has_patch)
          {
            std::array<std::array<double, 4>, dim> share;
            for (unsigned int d = 0; d < dim; ++d)
              share[d] = weights_along_axis(points, shape, here, d, p);
            for (unsigned int e = 0; e < weights_.size(); ++e)
              {
                weights_[e].value = 1.;
                for (unsigned int d = 0; d < dim; ++d)
                  weights_[e].value *= share[d][(entry[e] >> (2 * d)) % 4];
              }
          }
        else
          weights_of_point(points, state.grid, shape, cell, p, weights_);
        const Point<dim>          x = load_place(points, points.position, p);
        const double              V = volume_of_points<dim, double>(points, p);
        std::array<double, width> moments{{V, V * pressure[p]}};
        unsigned int              k = 2;
        for (unsigned int i = 0; i < dim; ++i)
          {
            moments[k++] = V * x[i];
            moments[k++] = V * pressure[p] * x[i];
            for (unsigned int j = i; j < dim; ++j)
              moments[k++] = V * x[i] * x[j];
          }
        for (const NodeWeight<dim> &weight : weights_)
          if (weight.value != 0)
            for (unsigned int i = 0; i < width; ++i)
              sums_[std::size_t(width) * weight.node + i] +=
                weight.value * moments[i];
      }
  }



  // With means over the points, u(s) = <u> +
  // (<u s> - <u> <s>)/(<s s> - <s> <s>) (s - <s>). A layer of one point has no
  // slope, and neither have points on both sides of a periodic face. In a thin
  // layer a pressure that grows from zero is at the base twice the mean: more
  // would be noise.
  double
  PressureFit::at(const double coordinate, const double cell_size) const
  {
    if (V <= 0.)
      return 0.;
    const double mean = u / V, place = s / V;
    const double variance = ss / V - place * place;
    const double least    = 1e-3 * cell_size * cell_size;
    if (variance < least || variance > 4. * cell_size * cell_size)
      return mean;
    const double slope = (us / V - mean * place) / variance;
    return std::clamp(mean + slope * (coordinate - place),
                      std::min(0., 2. * mean),
                      std::max(0., 2. * mean));
  }



  // The coordinate is s = x.n.
  template <int dim>
  double
  NodalPorePressure<dim>::at(const unsigned int   *node,
                             const double         *share,
                             const unsigned int    n,
                             const Point<dim>     &x,
                             const Tensor<1, dim> &normal,
                             const double          cell_size) const
  {
    if (sums_.empty())
      return 0.;
    PressureFit fit;
    for (unsigned int v = 0; v < n; ++v)
      {
        const double *sum = &sums_[std::size_t(width) * node[v]];
        fit.V += share[v] * *sum++;
        fit.u += share[v] * *sum++;
        for (unsigned int i = 0; i < dim; ++i)
          {
            fit.s += share[v] * normal[i] * *sum++;
            fit.us += share[v] * normal[i] * *sum++;
            for (unsigned int j = i; j < dim; ++j)
              fit.ss +=
                (i == j ? 1. : 2.) * share[v] * normal[i] * normal[j] * *sum++;
          }
      }
    return fit.at(Tensor<1, dim>(x) * normal, cell_size);
  }



  template class NodalPorePressure<2>;
  template class NodalPorePressure<3>;
} // namespace talus
