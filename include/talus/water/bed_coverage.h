// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_water_bed_coverage_h
#define talus_water_bed_coverage_h

#include <talus/state/state.h>
#include <talus/water/solid_at_nodes.h>

#include <functional>
#include <vector>

namespace talus
{
  /// Share of the bed (lower face of the mesh, surfaces of obstacles) covered
  /// by soil, by node. In a layer thinner than a cell the share follows from
  /// the sections of the boxes on the bed, which do not shrink with the
  /// thickness of the layer.
  template <int dim>
  class BedCoverage
  {
  public:
    /// Volume fraction of soil in the open volume around an owned node [-].
    using VolumeFraction = std::function<double(unsigned int node)>;

    /// Find the cells at the lower face. Call after each change of the mesh or
    /// its partition. Collective.
    void
    prepare(const Grid<dim> &grid);

    /// Sum the sections of the boxes on the bed. Call before of_bottom() and
    /// of_facets(). Collective.
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

    /// Plane of the bed near a point.
    struct Plane
    {
      double                 distance; ///< distance of the point, m
      dealii::Tensor<1, dim> normal;   ///< out of the bed
    };

    void
    clear(const Grid<dim> &grid);
    static double
    share(double sum, double area, double f);
    static bool
    is_full(const Cell<dim> &cell, const VolumeFraction &volume_fraction);
    void
    add_boxes_at_facets(const State<dim>        &state,
                        const Segment           &segment,
                        const SolidAtNodes<dim> &solid);
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
    std::vector<unsigned int>  touched_;        ///< nodes with nonzero sums_
    NodalExchange<dim>         exchange_;
  };
} // namespace talus

#endif
