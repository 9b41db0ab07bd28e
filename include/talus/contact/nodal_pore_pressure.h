// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_nodal_pore_pressure_h
#define talus_contact_nodal_pore_pressure_h

#include <talus/grid/nodal_exchange.h>
#include <talus/state/state.h>
#include <talus/transfer/weights.h>

#include <vector>

namespace talus
{
  /// Linear fit of a pressure u, Pa, over a coordinate s, m.
  struct PressureFit
  {
    // Sums of weights V, V u, V s, V u s and V s^2.
    double V = 0, u = 0, s = 0, us = 0, ss = 0;

    void
    add(const double weight, const double pressure, const double coordinate)
    {
      V += weight;
      u += weight * pressure;
      s += weight * coordinate;
      us += weight * pressure * coordinate;
      ss += weight * coordinate * coordinate;
    }

    /// Return the pressure, Pa, at @p coordinate, m, in cells of @p cell_size,
    /// m; 0 without weights.
    double
    at(double coordinate, double cell_size) const;
  };



  /// Excess pore pressure of the soil at places of seabed and obstacles: a
  /// linear function along the normal, fitted to the points that reach the
  /// nodes of the place and evaluated at the place. The mean over the points
  /// would belong to a place up to half a cell inside the soil.
  template <int dim>
  class NodalPorePressure
  {
  public:
    /// Call after each change of the mesh or its partition.
    void
    prepare(const Grid<dim> &grid);

    /// Sum over the points that reach nodes with @p is_needed, by node of the
    /// grid, ghosts and hanging nodes of needed ones included. Collective.
    void
    find(const State<dim> &state, const std::vector<unsigned char> &is_needed);

    /// Return the pressure, Pa, at a place with the unit normal @p normal; 0
    /// without soil or before find().
    /// @param node the @p n nodes of the place, with the weights @p share [-]
    /// @param x place, m
    /// @param cell_size m
    double
    at(const unsigned int           *node,
       const double                 *share,
       unsigned int                  n,
       const dealii::Point<dim>     &x,
       const dealii::Tensor<1, dim> &normal,
       double                        cell_size) const;

  private:
    // Volume V, V u, V x, V u x, and V x_i x_j for j >= i.
    static constexpr unsigned int width = 2 + 2 * dim + dim * (dim + 1) / 2;

    void
    add_cell(const State<dim>                 &state,
             const std::vector<unsigned char> &is_needed,
             unsigned int                      cell,
             unsigned int                      begin,
             unsigned int                      end);

    std::vector<double>          sums_; ///< by node; empty before find()
    NodalExchange<dim>           exchange_;
    std::vector<NodeWeight<dim>> weights_; ///< weights of a point
  };
} // namespace talus

#endif
