// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_water_bed_coverage_h
#define talus_water_bed_coverage_h

#include <talus/state/state.h>
#include <talus/water/solid_at_nodes.h>

#include <functional>
#include <vector>

namespace talus
{
  /// Share of the bed under soil: of the lower face of the mesh and of the
  /// surfaces of obstacles, node by node. In a layer thinner than a cell the share
  /// follows from the boxes that lie on the bed, whose sections do not shrink with
  /// the thickness of the layer.
  template <int dim>
  class BedCoverage
  {
  public:
    /// Share of the room around an owned node that soil fills [-].
    using VolumeFraction = std::function<double(unsigned int node)>;

    /// Find the cells at the bed, after each change of the mesh or its partition.
    /// Collective.
    void
    prepare(const Grid<dim> &grid);

    /// Find the shares from the boxes of the points. Collective.
    void
    find(const State<dim>        &state,
         const SolidAtNodes<dim> &solid,
         const VolumeFraction    &volume_fraction);

    /// Covered share of the lower face of the mesh at an owned node [-]; zero at
    /// nodes off the face.
    double
    of_bottom(const unsigned int node) const
    {
      return sums_[width * node + bottom];
    }

    /// Covered share of the facets around an owned node [-]; zero at nodes off the
    /// facets.
    double
    of_facets(const unsigned int node) const
    {
      return sums_[width * node + facets];
    }

  private:
    // By node: covered areas, m^(dim-1), then shares of the whole [-].
    enum Sum
    {
      bottom,
      facets,
      width
    };

    /// Plane of the bed as a point sees it.
    struct Plane
    {
      double                 distance; ///< of the point, m
      dealii::Tensor<1, dim> normal;   ///< out of the bed
    };

    void
    clear(const Grid<dim> &grid);
    bool
    is_full(const Cell<dim> &cell) const;
    bool
    find_plane(const Cell<dim>          &cell,
               const SolidAtNodes<dim>  &solid,
               const dealii::Point<dim> &x,
               Plane                    &plane) const;
    void
    add_box(const State<dim> &state,
            unsigned int      p,
            double            cell_size,
            const Plane      &plane,
            Sum               sum);
    void
    add_foot(const Grid<dim>          &grid,
             const dealii::Point<dim> &foot,
             double                    area,
             Sum                       sum);
    void
    find_shares(const State<dim>        &state,
                const SolidAtNodes<dim> &solid,
                const VolumeFraction    &volume_fraction);

    std::vector<unsigned char> is_at_bottom_; ///< by owned cell
    std::vector<unsigned char> is_full_;      ///< by node
    std::vector<double>        sums_;         ///< by node
    std::vector<unsigned int>  touched_;      ///< nodes of the last step
    NodalExchange<dim>         exchange_;
  };
} // namespace talus

#endif
