// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_water_free_surface_h
#define talus_water_free_surface_h

#include <talus/contact/contact.h>
#include <talus/state/state.h>
#include <talus/surface/place_table.h>
#include <talus/water/solid_at_nodes.h>

#include <array>
#include <tuple>
#include <vector>

namespace talus
{
  /// Part of the surface between soil and water in one cell of the mesh.
  template <int dim>
  struct SurfaceFacet
  {
    static constexpr unsigned int n_nodes = power(2, dim);

    std::array<unsigned int, n_nodes> node;  ///< nodes of the cell
    std::array<double, n_nodes>       share; ///< fraction of the force [-]
    dealii::Tensor<1, dim> vector_area; ///< integral of the outward normal,
                                        ///< m^(dim-1)
    dealii::Tensor<1, dim> normal;      ///< unit, outwards, from cells around
    dealii::Tensor<1, dim> velocity;    ///< mean of the soil at the nodes, m/s
    double
      mobility; ///< max change of velocity per impulse if the facets around
                ///< act in the same step, 1/kg

    // Row of a PlaceTable
    static constexpr unsigned int n_keys = 2;
    static constexpr const char  *columns =
      "key of the cell: upper and lower 32 bits; vector area [m^(dim-1)]; "
      "normal [-]";

    bool
    is_kept() const
    {
      return true;
    }

    auto
    values()
    {
      return std::tie(vector_area, normal);
    }
  };



  /// Free surface of the soil: the region where the volume fraction of soil and
  /// bed together falls from one to zero. Minus the integral of the gradient
  /// over a cell is the vector area of the surface in the cell, for any
  /// thickness of the soil on the bed, and continuous in time as points cross
  /// cells. The normal comes from all cells across the fall of the volume
  /// fraction, see doc/method.md, section "Water".
  template <int dim>
  class FreeSurface
  {
  public:
    /// Find the cells around each node, and move the facets to the ranks that
    /// own their cells now. Call after each change of the mesh or its
    /// partition. Collective.
    void
    prepare(const Grid<dim> &grid);

    /// Compute the facets in owned cells from the sums at the nodes, the boxes
    /// of the points and the soil at obstacles. Call update_soil() afterwards.
    /// Collective.
    void
    find(const State<dim> &state, const Contact<dim> &contact);

    /// Set velocity, shares and mobility of all facets by mass and velocity of
    /// the nodes after the momentum update. Collective.
    void
    update_soil(const State<dim> &state);

    /// Pass impulses on hanging nodes to the masters, in proportion to the
    /// soil; call after update_soil().
    /// @param impulses dim numbers per node of the grid, N s
    void
    pass_to_masters(std::vector<double> &impulses) const;

    /// Add the facets to the state of the run.
    void
    list_state(StateList &list)
    {
      facets_.list_state("free surface", list);
    }

    const std::vector<SurfaceFacet<dim>> &
    facets() const
    {
      return facets_.all();
    }

    /// Nodes of facets() without repetition, masters of hanging nodes among
    /// them, and all nodes shared with other ranks.
    const std::vector<unsigned int> &
    nodes_of_facets() const
    {
      return nodes_of_facets_;
    }

    /// Integral of the outward normal over the surface of the soil in cell
    /// @p cell, m^(dim-1); call after find().
    dealii::Tensor<1, dim>
    vector_area_of_cell(unsigned int cell) const
    {
      return vector_areas_[cell];
    }

    /// Covered share of the lower face of the mesh at @p node [-]; call after
    /// find().
    double
    covered_share(const unsigned int node) const
    {
      return record(node)[bottom];
    }

  private:
    using NodesOfCell = std::array<unsigned int, power(2, dim)>;

    // By node: volume fraction of soil in the open volume [-], area of the
    // facets around the node in contact, m^(dim-1), and share of the lower face
    // of the mesh in contact [-].
    enum Record
    {
      fraction,
      facets_covered,
      bottom,
      width
    };

    /// By node: mass of the soil, kg, and momentum after forces, kg m/s.
    static constexpr unsigned int width_of_soil = 1 + dim;

    /// By node: vector areas, m^(dim-1), of the cell with the node as lowest
    /// vertex and of the cell with the node as highest vertex.
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
    fill_records(const State<dim> &state, const Contact<dim> &contact);
    void
    add_contact_areas(const Contact<dim> &contact);
    void
    move_facets(const Grid<dim> &grid);
    void
    list_nodes_of_facets(const Grid<dim> &grid);
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
    double
    mass(const unsigned int node) const
    {
      return soil_[std::size_t(width_of_soil) * node];
    }
    void
    set_soil(SurfaceFacet<dim> &facet) const;
    void
    set_mobilities(const Grid<dim> &grid);

    SolidAtNodes<dim>          solid_;
    FaceCoverage<dim>          at_bottom_;
    std::vector<unsigned int>  first_cell_, cells_; ///< by node, with ghosts
    NodalExchange<dim>         exchange_, exchange_of_soil_, exchange_of_areas_;
    NodalExchange<dim>         exchange_of_loads_;
    std::vector<double>        records_, soil_;
    std::vector<double>        area_per_mass_; ///< by node, m^(dim-1)/kg
    std::vector<unsigned int>  nodes_of_facets_;
    std::vector<unsigned char> is_node_of_facets_;   ///< by node
    std::vector<const HangingNode *> hanging_nodes_; ///< among nodes_of_facets_
    std::vector<unsigned int>        filled_nodes_;  ///< records may be nonzero
    std::vector<unsigned int>        covered_nodes_; ///< by other ranks too
    std::vector<unsigned int>  soil_nodes_, previous_soil_nodes_; ///< f > 0
    std::vector<unsigned int>  listed_cells_;  ///< around soil_nodes_
    std::vector<unsigned int>  surface_cells_; ///< candidates for a facet
    std::vector<unsigned char> is_listed_;     ///< by cell
    std::vector<dealii::Tensor<1, dim>> vector_areas_;   ///< by cell
    std::vector<double>                 areas_of_nodes_; ///< by node
    PlaceTable<SurfaceFacet<dim>>       facets_;         ///< by cell
  };
} // namespace talus

#endif
