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

    /// Sum the sections of the boxes that lie on the bed. Collective.
    void
    find(const State<dim>        &state,
         const SolidAtNodes<dim> &solid,
         const VolumeFraction    &volume_fraction);

    /// Covered share of the lower face of the mesh at an owned node with volume
    /// fraction @p f of soil [-]; zero at nodes off the face.
    double
    of_bottom(const unsigned int node, const double f) const
    {
      return area_of_bottom_[node] > 0
               ? share(sums_[width * node + bottom], area_of_bottom_[node], f)
               : 0.;
    }

    /// Covered share of the facets of @p solid around an owned node with volume
    /// fraction @p f of soil [-]; zero at nodes off the facets.
    double
    of_facets(const unsigned int       node,
              const double             f,
              const SolidAtNodes<dim> &solid) const
    {
      const double area = solid.exists() ? solid.min_covered_area(node) : 0.;
      return area > 0 ? share(sums_[width * node + facets], area, f) : 0.;
    }

  private:
    // By node: covered areas, m^(dim-1).
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
    static double
    share(double sum, double area, double f);
    bool
    is_full(const Grid<dim>      &grid,
            const Cell<dim>      &cell,
            const VolumeFraction &volume_fraction) const;
    bool
    find_plane(const Cell<dim>          &cell,
               const SolidAtNodes<dim>  &solid,
               const dealii::Point<dim> &x,
               Plane                    &plane) const;
    void
    add_box(const State<dim> &state,
            unsigned int      p,
            const Cell<dim>  &cell,
            const Plane      &plane,
            Sum               sum);
    void
                               add_foot(const Grid<dim>          &grid,
                                        const Cell<dim>          &near,
                                        const dealii::Point<dim> &foot,
                                        double                    area,
                                        Sum                       sum);
    std::vector<unsigned char> is_at_bottom_;   ///< by owned cell
    std::vector<double>        area_of_bottom_; ///< by owned node, m^(dim-1)
    std::vector<double>        sums_;           ///< by node
    std::vector<unsigned int>  touched_;        ///< nodes of the last step
    NodalExchange<dim>         exchange_;
  };
} // namespace talus

#endif
