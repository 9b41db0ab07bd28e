// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_water_free_surface_h
#define talus_water_free_surface_h

#include <talus/contact/facet_contact.h>
#include <talus/geometry/clip_simplex.h>
#include <talus/state/state.h>

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

    std::array<unsigned int, n_nodes> node;     ///< of the cell
    std::array<double, n_nodes>       share;    ///< of these in the soil there
    dealii::Point<dim>                centroid; ///< m
    dealii::Tensor<1, dim>            vector_area; ///< out of the soil,
                                                   ///< m^(dim-1)
    dealii::Tensor<1, dim> velocity; ///< of the soil, before the step, m/s
  };



  /// The free surface of the soil: the contour on which the nodes are half
  /// filled. It does not jump when points cross cells, since the volume of soil
  /// at a node does not, and it is closed with the walls and obstacles that the
  /// soil lies on.
  template <int dim>
  class FreeSurface
  {
  public:
    /// To be called after each change of the mesh or its partition. Collective.
    void
    prepare(const Grid<dim> &grid);

    /// Find the facets in the cells that this rank owns, from the sums at the
    /// nodes. Collective.
    void
    find(const State<dim> &state, const FacetContact<dim> &contact);

    const std::vector<SurfaceFacet<dim>> &
    facets() const
    {
      return facets_;
    }

    /// Which part of the room around a node is soil, at most 1; after find().
    double
    fill(const unsigned int node) const
    {
      return record(node)[filling];
    }

  private:
    using ShapeValues = std::array<double, (1u << dim)>;
    using NodesOfCell = std::array<unsigned int, power(2, dim)>;

    // By node: degree of filling [-], mass [kg] and velocity [m/s].
    enum Record
    {
      filling,
      mass,
      velocity,
      width = velocity + dim
    };

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

    ShapeValues
    distances(const Cell<dim> &cell, const Obstacles<dim> &obstacles);
    double
    room(const FacetContact<dim> &contact, unsigned int node) const;
    void
    fill_records(const State<dim> &state, const FacetContact<dim> &contact);
    void
    fill_hanging_records(const Grid<dim> &grid);
    void
    cut_cell(const Grid<dim>         &grid,
             const FacetContact<dim> &contact,
             unsigned int             c);
    std::array<double, dim + 1>
    emptiness_at(const Simplex<dim> &simplex,
                 const Box<dim>     &box,
                 const NodesOfCell  &nodes) const;
    void
    set_soil(SurfaceFacet<dim> &facet, const ShapeValues &shape_values) const;

    std::vector<double> volume_; ///< integral of the shape function, by node
    std::vector<unsigned int>  first_cell_, cells_; ///< owned ones, by node
    std::vector<double>        distance_; ///< from obstacles, by node, m
    NodalExchange<dim>         exchange_;
    std::vector<double>        records_;
    std::vector<unsigned int>  filled_nodes_; ///< whose records are not zero
    std::vector<unsigned long> visited_;      ///< by cell: in which search
    unsigned long              n_searches_ = 0;
    std::vector<SurfaceFacet<dim>> facets_;
  };
} // namespace talus

#endif
