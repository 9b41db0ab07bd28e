// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_water_free_surface_h
#define talus_water_free_surface_h

#include <talus/contact/facet_contact.h>
#include <talus/state/state.h>
#include <talus/water/bed_coverage.h>
#include <talus/water/solid_at_nodes.h>

#include <array>
#include <vector>

namespace talus
{
  /// Part of the surface of the soil that bounds on water, in one cell of the
  /// mesh.
  template <int dim>
  struct SurfaceFacet
  {
    static constexpr unsigned int n_nodes = power(2, dim);

    std::array<unsigned int, n_nodes> node;  ///< of the cell
    std::array<double, n_nodes>       share; ///< of the force, by node [-]
    dealii::Tensor<1, dim> vector_area; ///< integral of the outward normal,
                                        ///< m^(dim-1)
    dealii::Tensor<1, dim> normal;      ///< outwards, of the surface around
    dealii::Tensor<1, dim> velocity;    ///< of the soil, before the step, m/s
  };



  /// Free surface of the soil: where the volume fraction of soil and bed together
  /// falls from one to zero. The integral of its gradient over a cell is the
  /// vector area of the surface in the cell, however thin the soil on the bed is,
  /// and continuous in time as points cross cells. The normal is that of all cells
  /// through which the volume fraction falls, see doc/method.md, section "Water".
  template <int dim>
  class FreeSurface
  {
  public:
    /// To be called after each change of the mesh or its partition. Collective.
    void
    prepare(const Grid<dim> &grid);

    /// Find the facets in the cells that this rank owns, from the sums at the
    /// nodes and the boxes of the points. Collective.
    void
    find(const State<dim> &state, const FacetContact<dim> &contact);

    const std::vector<SurfaceFacet<dim>> &
    facets() const
    {
      return facets_;
    }

    /// Integral of the outward normal over the surface of the soil in cell
    /// @p cell, m^(dim-1); after find().
    dealii::Tensor<1, dim>
    vector_area_of_cell(unsigned int cell) const
    {
      return vector_areas_[cell];
    }

    /// Covered share of the lower face of the mesh at @p node [-]; after find().
    double
    covered_share(const unsigned int node) const
    {
      return record(node)[bottom];
    }

  private:
    using NodesOfCell = std::array<unsigned int, power(2, dim)>;

    // By node: volume fraction of soil in the room that obstacles leave [-],
    // covered shares of facets and of the lower face of the mesh [-], mass [kg]
    // and momentum [kg m/s].
    enum Record
    {
      fraction,
      facets_covered,
      bottom,
      mass,
      momentum,
      width = momentum + dim
    };

    /// By node: vector areas of the cells whose lowest and highest vertex the
    /// node is, m^(dim-1).
    static constexpr unsigned int width_of_areas = 2 * dim;

    double *
    record(const unsigned int node)
    {
      return records_.data() + std::size_t(width) * node;
    }

    const double *
    record(const unsigned int node) const
    {
      return records_.data() + std::size_t(width) * node;
    }

    void
    clear_cells(const Grid<dim> &grid);
    void
    fill_records(const State<dim> &state);
    void
    fill_hanging_records(const Grid<dim> &grid);
    void
    list_cells(const State<dim> &state);
    void
    find_vector_areas(const Grid<dim> &grid);
    double
    covered_share_of_facets(const NodesOfCell &nodes) const;
    dealii::Tensor<1, dim>
    integrate_gradient(const Grid<dim> &grid, const Cell<dim> &cell) const;
    bool
    set_surface(const Cell<dim>              &cell,
                const dealii::Tensor<1, dim> &own_area,
                SurfaceFacet<dim>            &facet) const;
    void
    set_soil(SurfaceFacet<dim> &facet) const;

    SolidAtNodes<dim>          solid_;
    BedCoverage<dim>           coverage_;
    std::vector<unsigned int>  first_cell_, cells_; ///< ghosts, too, by node
    NodalExchange<dim>         exchange_, exchange_of_areas_;
    std::vector<double>        records_;
    std::vector<unsigned int>  filled_nodes_; ///< whose records are not zero
    std::vector<unsigned int>  soil_nodes_, previous_soil_nodes_; ///< f > 0
    std::vector<unsigned int>  listed_cells_;  ///< that touch a filled node
    std::vector<unsigned int>  surface_cells_; ///< that may have a facet
    std::vector<unsigned char> is_listed_;     ///< by cell
    std::vector<dealii::Tensor<1, dim>> vector_areas_;   ///< by cell
    std::vector<double>                 areas_of_nodes_; ///< by node
    std::vector<SurfaceFacet<dim>>      facets_;
  };
} // namespace talus

#endif
