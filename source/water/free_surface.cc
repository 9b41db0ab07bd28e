// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/water/free_surface.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Minimum vector area of a surface, summed over a column of cells, as a
    /// share of the face of a cell [-]. Smaller values are noise of boxes which
    /// do not tile the soil, or a few isolated points.
    constexpr double min_area_of_surface = 0.25;

    /// Vector area of a cell, as a share of its face [-], below which the cell
    /// has no facet; facets have full area from twice this value on.
    constexpr double min_area_in_cell = 1e-4;

    /// Vector area beyond the mesh.
    constexpr std::array<double, 3> zeros = {};

    double
    square(const double x)
    {
      return x * x;
    }

    /// Weight of a vector area in the sum over a column of cells [-]: the
    /// fourth power of the cosine of the angle to the vector area of the cell,
    /// zero from a right angle on. Without branches, since signs inside the
    /// soil are noise.
    /// @param product scalar product of both vector areas
    /// @param squares product of their squared lengths
    double
    weight_by_angle(const double product, const double squares)
    {
      return square(square(std::max(0., product)) /
                    std::max(squares, std::numeric_limits<double>::min()));
    }

    /// Interpolate the record of a hanging node, @p width numbers, from its
    /// masters.
    void
    interpolate(const HangingNode   &hanging,
                std::vector<double> &records,
                const unsigned int   width)
    {
      double *const to = &records[std::size_t(width) * hanging.node];
      std::fill_n(to, width, 0.);
      for (const auto &[master, weight] : hanging.masters)
        for (unsigned int i = 0; i < width; ++i)
          to[i] += weight * records[std::size_t(width) * master + i];
    }

    /// Area of a face of a cell, m^(dim-1).
    template <int dim>
    double
    face_of(const Cell<dim> &cell)
    {
      return dim == 2 ? cell.size : cell.size * cell.size;
    }

    template <int dim>
    double
    norm_square(const std::array<double, dim> &x)
    {
      double result = 0;
      for (unsigned int d = 0; d < dim; ++d)
        result += x[d] * x[d];
      return result;
    }

    // Two cells on either side, since the volume fraction falls from one to
    // zero within two cells along the normal. Cells above are found by their
    // lowest vertex, cells below by their highest vertex. Plain numbers stay in
    // registers, tensors would go through memory.
    /// Add vector areas of the cells along @p axis, each times
    /// weight_by_angle(). Cells beyond the mesh or of another size count as
    /// zero.
    /// @param areas two vector areas by node, see FreeSurface::width_of_areas
    /// @param sum vector area of @p cell on entry, sum on return, m^(dim-1)
    template <int dim>
    inline void
    add_column(const double *const      areas,
               const Cell<dim>         &cell,
               const unsigned int       axis,
               std::array<double, dim> &sum)
    {
      constexpr unsigned int lowest  = patch_of_vertex<dim>(0);
      constexpr unsigned int highest = patch_of_vertex<dim>(power(2, dim) - 1);
      const unsigned int     stride  = power(4, axis);
      const std::array<double, dim> own        = sum;
      const double                  own_square = norm_square<dim>(own);
      const auto add = [&](const unsigned int node, const unsigned int begin) {
        const double *const area =
          node == numbers::invalid_unsigned_int
            ? zeros.data()
            : areas + std::size_t(2 * dim) * node + begin;
        double product = 0, squares = 0;
        for (unsigned int d = 0; d < dim; ++d)
          {
            product += area[d] * own[d];
            squares += area[d] * area[d];
          }
        const double weight = weight_by_angle(product, squares * own_square);
        for (unsigned int d = 0; d < dim; ++d)
          sum[d] += weight * area[d];
      };
      add(cell.patch[highest - 2 * stride], dim);
      add(cell.patch[highest - stride], dim);
      add(cell.patch[lowest + stride], 0);
      add(cell.patch[lowest + 2 * stride], 0);
    }
  } // namespace



  template <int dim>
  void
  FreeSurface<dim>::prepare(const Grid<dim> &grid)
  {
    solid_.prepare(grid);
    at_bottom_.prepare(grid, 1u << bottom_face);
    std::vector<std::vector<unsigned int>> cells(grid.n_nodes());
    for (unsigned int c = 0; c < grid.cells().size(); ++c)
      for (const unsigned int node : grid.cells()[c].nodes())
        cells[node].push_back(c);
    first_cell_.assign(1, 0);
    cells_.clear();
    for (const auto &of_node : cells)
      {
        cells_.insert(cells_.end(), of_node.begin(), of_node.end());
        first_cell_.push_back(cells_.size());
      }
    exchange_.prepare(grid, width);
    exchange_of_soil_.prepare(grid, width_of_soil);
    exchange_of_areas_.prepare(grid, width_of_areas);
    exchange_of_loads_.prepare(grid, 1);
    area_per_mass_.assign(grid.n_nodes(), 0.);
    records_.assign(std::size_t(width) * grid.n_nodes(), 0.);
    soil_.assign(std::size_t(width_of_soil) * grid.n_nodes(), 0.);
    areas_of_nodes_.assign(std::size_t(width_of_areas) * grid.n_nodes(), 0.);
    vector_areas_.assign(grid.cells().size(), Tensor<1, dim>());
    is_listed_.assign(grid.cells().size(), 0);
    is_node_of_facets_.assign(grid.n_nodes(), 0);
    nodes_of_facets_.clear();
    filled_nodes_.clear();
    covered_nodes_.clear();
    soil_nodes_.clear();
    listed_cells_.clear();
    move_facets(grid);
  }



  /// Move the facets to the ranks that own their cells. The order is kept: sums
  /// over facets in a resumed run give the same bits.
  template <int dim>
  void
  FreeSurface<dim>::move_facets(const Grid<dim> &grid)
  {
    const auto cell_of = [&grid](const PlaceKey &place) {
      return grid.cell_of_key(key_of_halves(place[0], place[1]));
    };
    facets_.move_to(
      [&](const PlaceKey &place) {
        return cell_of(place) < grid.n_owned_cells();
      },
      grid.communicator());
    for (unsigned int k = 0; k < facets_.size(); ++k)
      facets_[k].node = grid.cells()[cell_of(facets_.places()[k])].nodes();
    list_nodes_of_facets(grid);
  }



  /// List the nodes whose soil determines the velocities of the facets: nodes
  /// of facets, masters of hanging nodes among them, and the nodes of this rank
  /// that other ranks list. Collective.
  template <int dim>
  void
  FreeSurface<dim>::list_nodes_of_facets(const Grid<dim> &grid)
  {
    for (const unsigned int node : nodes_of_facets_)
      is_node_of_facets_[node] = 0;
    nodes_of_facets_.clear();
    hanging_nodes_.clear();
    const auto add = [this](const unsigned int node) {
      if (!is_node_of_facets_[node])
        nodes_of_facets_.push_back(node);
      is_node_of_facets_[node] = 1;
    };
    for (const SurfaceFacet<dim> &facet : facets())
      std::for_each(facet.node.begin(), facet.node.end(), add);
    for (const HangingNode &hanging : grid.hanging_nodes())
      if (is_node_of_facets_[hanging.node])
        {
          hanging_nodes_.push_back(&hanging);
          for (const auto &master : hanging.masters)
            add(master.first);
        }
    // Ask the owners of the ghosts; set_mobilities() clears the marks.
    std::fill(area_per_mass_.begin() + grid.n_owned_nodes(),
              area_per_mass_.end(),
              0.);
    for (const unsigned int node : nodes_of_facets_)
      if (node >= grid.n_owned_nodes())
        area_per_mass_[node] = 1.;
    exchange_of_loads_.add_to_owners(area_per_mass_.data());
    std::for_each(exchange_of_loads_.received_nodes().begin(),
                  exchange_of_loads_.received_nodes().end(),
                  add);
  }



  template <int dim>
  void
  FreeSurface<dim>::find(const State<dim> &state, const Contact<dim> &contact)
  {
    const Grid<dim> &grid = state.grid;
    filled_nodes_.insert(filled_nodes_.end(),
                         covered_nodes_.begin(),
                         covered_nodes_.end());
    for (const unsigned int node : filled_nodes_)
      std::fill_n(record(node), width, 0.);
    filled_nodes_.clear();
    facets_.clear();
    solid_.update(grid, contact);
    fill_records(state, contact);
    list_cells(state);
    find_vector_areas(grid);
    for (const unsigned int c : surface_cells_)
      {
        const Cell<dim>  &cell     = grid.cells()[c];
        const double      min_area = min_area_in_cell * face_of<dim>(cell);
        SurfaceFacet<dim> facet    = {};
        if (!set_surface(cell, vector_areas_[c], facet))
          continue;
        if (vector_areas_[c].norm_square() < square(2. * min_area))
          facet.vector_area *= vector_areas_[c].norm() / min_area - 1.;
        facet.node = cell.nodes();
        facets_.push_back(place_key(grid.key_of_cell(c)), facet);
      }
    list_nodes_of_facets(grid);
  }



  /// Add the areas of the facets in contact with soil to the records of their
  /// nodes.
  template <int dim>
  void
  FreeSurface<dim>::add_contact_areas(const Contact<dim> &contact)
  {
    const auto &facets = contact.facets().owned();
    for (unsigned int f = 0; f < facets.size(); ++f)
      {
        const double area = facets[f].area * contact.soil().share(f);
        for (unsigned int v = 0; v < facets[f].node.size() && area > 0; ++v)
          {
            record(facets[f].node[v])[facets_covered] +=
              facets[f].shape_value[v] * area;
            filled_nodes_.push_back(facets[f].node[v]);
          }
      }
  }



  /// Fill the records of all nodes. Collective.
  template <int dim>
  void
  FreeSurface<dim>::fill_records(const State<dim>   &state,
                                 const Contact<dim> &contact)
  {
    const NodalFields<dim> &nodes = state.nodes;
    if (solid_.exists())
      add_contact_areas(contact);
    exchange_.add_to_owners(records_.data());
    covered_nodes_ = exchange_.received_nodes();
    for (const unsigned int node : nodes.active_nodes())
      if (nodes.mass(node) > state.constants.mass_cutoff)
        {
          record(node)[fraction] =
            std::min(1., nodes.volume(node) / solid_.open_volume(node));
          filled_nodes_.push_back(node);
        }
    at_bottom_.find(state);
    at_bottom_.for_each_node(
      [&](const unsigned int face, const unsigned int node) {
        double *const to = record(node);
        to[bottom]       = at_bottom_.share(face,
                                      node,
                                      state.grid.face_share(face, node).area,
                                      to[fraction]);
      });
    exchange_.copy_to_ghosts(records_.data());
    for (const HangingNode &hanging : state.grid.hanging_nodes())
      {
        interpolate(hanging, records_, width);
        filled_nodes_.push_back(hanging.node);
      }
  }



  // Lists the cells around owned and ghost nodes with soil: the cost follows
  // the soil. The order is the order of the active nodes, which is the same in
  // a resumed run. If the nodes with soil have not changed since the previous
  // step, the list is kept.
  template <int dim>
  void
  FreeSurface<dim>::list_cells(const State<dim> &state)
  {
    const Grid<dim> &grid = state.grid;
    for (unsigned int node = grid.n_owned_nodes(); node < grid.n_nodes();
         ++node)
      if (record(node)[fraction] > 0)
        filled_nodes_.push_back(node);
    soil_nodes_.swap(previous_soil_nodes_);
    soil_nodes_.clear();
    for (const unsigned int node : filled_nodes_)
      if (record(node)[fraction] > 0)
        soil_nodes_.push_back(node);
    if (soil_nodes_ == previous_soil_nodes_)
      return;
    clear_cells(grid);
    for (const unsigned int node : soil_nodes_)
      for (unsigned int i = first_cell_[node]; i < first_cell_[node + 1]; ++i)
        if (const unsigned int c = cells_[i]; !is_listed_[c])
          {
            is_listed_[c] = 1;
            listed_cells_.push_back(c);
          }
  }



  template <int dim>
  void
  FreeSurface<dim>::clear_cells(const Grid<dim> &grid)
  {
    for (const unsigned int c : listed_cells_)
      {
        vector_areas_[c] = Tensor<1, dim>();
        is_listed_[c]    = 0;
        const auto nodes = grid.cells()[c].nodes();
        for (const unsigned int node : {nodes.front(), nodes.back()})
          std::fill_n(areas_of_nodes_.begin() +
                        std::size_t(width_of_areas) * node,
                      width_of_areas,
                      0.);
      }
    listed_cells_.clear();
  }



  // Areas are stored at nodes, since the second cell across the border of a
  // rank is unknown here. The nearer vertex of the second cell is a ghost node,
  // whose owner knows all cells around.
  template <int dim>
  void
  FreeSurface<dim>::find_vector_areas(const Grid<dim> &grid)
  {
    surface_cells_.clear();
    for (const unsigned int c : listed_cells_)
      {
        const Cell<dim> &cell  = grid.cells()[c];
        const auto       nodes = cell.nodes();
        vector_areas_[c]       = integrate_gradient(grid, cell);
        if (c < grid.n_owned_cells() &&
            vector_areas_[c].norm_square() >
              square(min_area_in_cell * face_of<dim>(cell)))
          surface_cells_.push_back(c);
        for (unsigned int d = 0; d < dim; ++d)
          {
            areas_of_nodes_[width_of_areas * nodes.front() + d] =
              vector_areas_[c][d];
            areas_of_nodes_[width_of_areas * nodes.back() + dim + d] =
              vector_areas_[c][d];
          }
      }
    exchange_of_areas_.copy_to_ghosts(areas_of_nodes_.data());
  }



  /// Share of the surfaces of obstacles around a cell covered by soil [-].
  template <int dim>
  double
  FreeSurface<dim>::covered_share_of_facets(const NodesOfCell &nodes) const
  {
    double covered = 0, area = 0;
    for (const unsigned int node : nodes)
      {
        covered += record(node)[facets_covered];
        area += solid_.facet_area(node);
      }
    return area > 0 ? covered / area : 0.;
  }



  /// Return minus the integral of (grad s + c grad b) over a cell, m^(dim-1),
  /// with the volume fractions s of soil and b of obstacles and the covered
  /// share c of the surfaces of obstacles: where soil covers the bed, only the
  /// surface towards the water is left. The region below the mesh counts as
  /// bed, with the face of the mesh in place of grad b.
  template <int dim>
  Tensor<1, dim>
  FreeSurface<dim>::integrate_gradient(const Grid<dim> &grid,
                                       const Cell<dim> &cell) const
  {
    const auto   nodes = cell.nodes();
    const double face  = face_of<dim>(cell) / power(2, dim - 1);
    const double covered =
      solid_.exists() ? covered_share_of_facets(nodes) : 0.;
    Tensor<1, dim> result;
    for (unsigned int v = 0; v < nodes.size(); ++v)
      {
        const double *const node = record(nodes[v]);
        const double        b    = solid_.volume_fraction(nodes[v]);
        const double        u    = (1. - b) * node[fraction] + covered * b;
        for (unsigned int d = 0; d < dim; ++d)
          result[d] += ((v >> d) & 1) ? -u : u;
        if (((v >> 1) & 1) == 0 &&
            (grid.faces_of_node(nodes[v]) & (1u << bottom_face)))
          result[1] += (solid_.contains(nodes[v])
                          ? covered - u
                          : (1. - b) * (node[bottom] - node[fraction]));
      }
    return face * result;
  }



  // The sum of the vector areas along an axis, through the whole fall of the
  // volume fraction, has the direction of the surface. The gradient in a single
  // cell does not: its components are differences over different stencils. The
  // column along the axis nearest to the normal crosses the surface within the
  // fewest cells. Weights by the angle between two cells leave out the far side
  // of a thin sheet and the surface around an edge.
  /// Set normal and vector area of a facet from @p own_area, the vector area of
  /// the surface in the cell, m^(dim-1). Returns whether the cell has a
  /// surface.
  template <int dim>
  bool
  FreeSurface<dim>::set_surface(const Cell<dim>      &cell,
                                const Tensor<1, dim> &own_area,
                                SurfaceFacet<dim>    &facet) const
  {
    double                  area_of_column = 0, sum = 0;
    std::array<double, dim> n = {}, own;
    for (unsigned int d = 0; d < dim; ++d)
      own[d] = own_area[d];
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        std::array<double, dim> column = own;
        add_column<dim>(areas_of_nodes_.data(), cell, axis, column);
        const double square_of_length = norm_square<dim>(column);
        const double inverse          = 1. / std::sqrt(square_of_length);
        const double weight           = square(square(column[axis] * inverse));
        const double factor           = weight * inverse;
        for (unsigned int d = 0; d < dim; ++d)
          n[d] += factor * column[d];
        area_of_column += factor * square_of_length;
        sum += weight;
      }
    const double length = std::sqrt(norm_square<dim>(n));
    if (length == 0)
      return false;
    const double full  = min_area_of_surface * sum * face_of<dim>(cell);
    const double share = std::min(1., area_of_column / full);
    for (unsigned int d = 0; d < dim; ++d)
      {
        facet.normal[d]      = n[d] / length;
        facet.vector_area[d] = share * own[d];
      }
    return facet.vector_area * facet.normal > 0;
  }



  template <int dim>
  void
  FreeSurface<dim>::update_soil(const State<dim> &state)
  {
    if (facets_.is_waiting())
      move_facets(state.grid);
    const NodalFields<dim> &nodes = state.nodes;
    for (const unsigned int node : nodes_of_facets_)
      {
        double *const soil = soil_.data() + std::size_t(width_of_soil) * node;
        const double  mass = nodes.mass(node);
        const bool    has_soil        = mass > state.constants.mass_cutoff;
        const Tensor<1, dim> velocity = nodes.velocity(node);
        soil[0]                       = has_soil ? mass : 0.;
        for (unsigned int d = 0; d < dim; ++d)
          soil[1 + d] = has_soil ? mass * velocity[d] : 0.;
      }
    exchange_of_soil_.copy_to_ghosts(soil_.data());
    for (const HangingNode *const hanging : hanging_nodes_)
      interpolate(*hanging, soil_, width_of_soil);
    for (SurfaceFacet<dim> &facet : facets_)
      set_soil(facet);
    set_mobilities(state.grid);
  }



  // The force is shared in proportion to the mass of the nodes: a node with
  // hardly any soil must not get a large force. The velocity of the facet is
  // the mean, weighted by mass. All soil may have left a facet since find().
  template <int dim>
  void
  FreeSurface<dim>::set_soil(SurfaceFacet<dim> &facet) const
  {
    const auto soil = [this](const unsigned int node) {
      return soil_.data() + std::size_t(width_of_soil) * node;
    };
    double sum = 0;
    for (const unsigned int node : facet.node)
      sum += soil(node)[0];
    facet.velocity = Tensor<1, dim>();
    facet.share.fill(0.);
    if (!(sum > 0))
      return;
    for (unsigned int v = 0; v < facet.node.size(); ++v)
      {
        const double *const node = soil(facet.node[v]);
        facet.share[v]           = node[0] / sum;
        for (unsigned int d = 0; d < dim; ++d)
          facet.velocity[d] += node[1 + d];
      }
    facet.velocity /= sum;
  }



  // A node that several facets load is divided among them in proportion to
  // area per mass of the soil at the facet. A facet that brakes its share of
  // each node removes energy, and so does the mean of the shares: forces of all
  // facets in one step never reverse the soil (mass splitting, see
  // doc/method.md, section "Water").
  /// Set the mobilities of all facets. Collective.
  template <int dim>
  void
  FreeSurface<dim>::set_mobilities(const Grid<dim> &grid)
  {
    for (const unsigned int node : nodes_of_facets_)
      area_per_mass_[node] = 0;
    // All ghosts have the values of their owners from the step before.
    std::fill(area_per_mass_.begin() + grid.n_owned_nodes(),
              area_per_mass_.end(),
              0.);
    for (const SurfaceFacet<dim> &facet : facets())
      {
        double soil = 0;
        for (const unsigned int node : facet.node)
          soil += mass(node);
        const double added = soil > 0 ? facet.vector_area.norm() / soil : 0.;
        for (const unsigned int node : facet.node)
          area_per_mass_[node] += added;
      }
    for (const HangingNode *const hanging : hanging_nodes_)
      {
        for (const auto &[master, weight] : hanging->masters)
          area_per_mass_[master] += weight * area_per_mass_[hanging->node];
        area_per_mass_[hanging->node] = 0;
      }
    exchange_of_loads_.add_to_owners(area_per_mass_.data());
    exchange_of_loads_.copy_to_ghosts(area_per_mass_.data());
    for (const HangingNode *const hanging : hanging_nodes_)
      for (const auto &[master, weight] : hanging->masters)
        if (mass(hanging->node) > 0)
          area_per_mass_[hanging->node] += weight * mass(master) /
                                           mass(hanging->node) *
                                           area_per_mass_[master];
    for (SurfaceFacet<dim> &facet : facets_)
      {
        const double size = facet.vector_area.norm();
        facet.mobility    = 0;
        for (unsigned int v = 0; v < facet.node.size(); ++v)
          facet.mobility +=
            facet.share[v] * area_per_mass_[facet.node[v]] / size;
      }
  }



  // In proportion to the soil of the masters, as the velocity of a facet is a
  // mean over the soil: else the drag of a facet could add energy.
  template <int dim>
  void
  FreeSurface<dim>::pass_to_masters(std::vector<double> &impulses) const
  {
    for (const HangingNode *const hanging : hanging_nodes_)
      {
        double *const from = &impulses[std::size_t(dim) * hanging->node];
        for (const auto &[master, weight] : hanging->masters)
          if (mass(hanging->node) > 0)
            for (unsigned int d = 0; d < dim; ++d)
              impulses[std::size_t(dim) * master + d] +=
                weight * mass(master) / mass(hanging->node) * from[d];
        std::fill_n(from, dim, 0.);
      }
  }



  template class FreeSurface<2>;
  template class FreeSurface<3>;
} // namespace talus
