// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/contact/facets.h>
#include <talus/geometry/open_surface.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Point<dim>
    centre_of(const Cell<dim> &cell)
    {
      Point<dim> x = cell.lower;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] += 0.5 * cell.size;
      return x;
    }



    /// Radius of the ball around a cell, m, with a margin for round-off.
    template <int dim>
    double
    outer_radius(const Cell<dim> &cell)
    {
      return 0.5 * std::sqrt(double(dim)) * cell.size * (1. + 1e-6);
    }



    /// Call action(x) for a lattice of @p n places along each axis, @p step m
    /// apart, with the lowest corner @p first, m.
    template <int dim, typename Action>
    void
    for_each_place(const Point<dim>                    &first,
                   const double                         step,
                   const std::array<unsigned int, dim> &n,
                   const Action                        &action)
    {
      unsigned int n_places = 1;
      for (unsigned int d = 0; d < dim; ++d)
        n_places *= n[d];
      for (unsigned int i = 0; i < n_places; ++i)
        {
          Point<dim> x = first;
          for (unsigned int d = 0, rest = i; d < dim; rest /= n[d], ++d)
            x[d] += (rest % n[d]) * step;
          action(x);
        }
    }



    /// Append the cells up to @p n_rings around cell @p c to @p cells by search
    /// from the centre of the cell.
    template <int dim>
    void
    search_around(const Grid<dim>           &grid,
                  const unsigned int         c,
                  const unsigned int         n_rings,
                  std::vector<unsigned int> &cells)
    {
      const Cell<dim>              &cell = grid.cells()[c];
      std::array<unsigned int, dim> n;
      n.fill(2 * n_rings + 1);
      Point<dim> first = centre_of(cell);
      for (unsigned int d = 0; d < dim; ++d)
        first[d] -= n_rings * cell.size;
      for_each_place<dim>(first, cell.size, n, [&](Point<dim> x) {
        for (unsigned int d = 0; d < dim; ++d)
          x[d] -= grid.periodicity().shift(d, x[d]);
        if (const unsigned int found = grid.find_cell(x);
            found != numbers::invalid_unsigned_int)
          cells.push_back(found);
      });
    }



    void
    sort_unique(std::vector<unsigned int> &cells)
    {
      std::sort(cells.begin(), cells.end());
      cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    }



    /// Return the cells that share a corner with cell @p c, including @p c,
    /// ascending. Only owned cells know their neighbours.
    template <int dim>
    std::vector<unsigned int>
    cells_touching(const Grid<dim> &grid, const unsigned int c)
    {
      std::vector<unsigned int> cells;
      if (c < grid.n_owned_cells() && grid.cells()[c].uniform)
        std::copy_if(grid.cells()[c].neighbors.begin(),
                     grid.cells()[c].neighbors.end(),
                     std::back_inserter(cells),
                     [](const unsigned int n) {
                       return n != numbers::invalid_unsigned_int;
                     });
      else
        search_around(grid, c, 1, cells);
      sort_unique(cells);
      return cells;
    }



    /// Return the cells up to two rings around cell @p c, including @p c, in
    /// any order; none if they are the neighbours of the cells @p touching
    /// cell @p c.
    template <int dim>
    std::vector<unsigned int>
    cells_near(const Grid<dim>                 &grid,
               const unsigned int               c,
               const std::vector<unsigned int> &touching)
    {
      std::vector<unsigned int> cells;
      if (std::any_of(touching.begin(), touching.end(), [&](unsigned int t) {
            return t >= grid.n_owned_cells() || !grid.cells()[t].uniform;
          }))
        search_around(grid, c, 2, cells);
      return cells;
    }
  } // namespace



  namespace
  {
    /// Share of the area of a surface that the vector area lacks [-], as the
    /// normals differ: half the mean square of their angles to the mean normal.
    template <int dim>
    double
    lost_area(const CutSurface<dim> &surface)
    {
      return 1. - surface.vector_area.norm() / surface.area;
    }



    /// Bound on the distance of a surface from its plane, m. A surface whose
    /// normals turn by 5 degrees in the cell is at most 1/40 of the cell from
    /// the plane.
    template <int dim>
    double
    deviation_from_plane(const CutSurface<dim> &surface, const double cell_size)
    {
      return cell_size * (lost_area(surface) < 1e-3 ? 0.025 : 0.4);
    }



    /// Return whether the normals of a surface turn by less than about a
    /// degree: a surface of constant curvature is then within 1/200 of the cell
    /// size of the plane.
    template <int dim>
    bool
    is_flat(const CutSurface<dim> &surface)
    {
      return lost_area(surface) < 1.5e-5;
    }
  } // namespace



  namespace
  {
    /// Area below which a surface in a cell is ignored, m^(dim-1).
    template <int dim>
    double
    min_area(const Cell<dim> &cell)
    {
      return 1e-8 * std::pow(cell.size, dim - 1.);
    }



    /// Return the surface of an obstacle in a cell, and whether the surface is
    /// grazing: on a face between the cell, inside the obstacle, and an open
    /// cell.
    template <int dim>
    std::pair<std::vector<Facet<dim>>, bool>
    find_surface(const Cell<dim> &cell, const Obstacle<dim> &obstacle)
    {
      const auto     box       = cell.box();
      const Box<dim> around    = obstacle.bounding_box();
      double         thickness = obstacle.shape().width();
      for (unsigned int d = 0; d < dim; ++d)
        thickness = std::min(thickness, around.length(d));
      const bool is_thin = thickness < 2. * cell.size;
      const auto pieces  = surface_pieces<dim>(
        box,
        [&](const Point<dim> &x) { return obstacle.signed_distance(x); },
        is_thin);
      if (sum_of_pieces<dim>(pieces).area >= min_area(cell))
        return {pieces, false};
      // A surface on faces of the mesh belongs to the cells where the distance
      // is positive.
      auto inside = surface_pieces<dim>(
        box,
        [&](const Point<dim> &x) { return -obstacle.signed_distance(x); },
        is_thin);
      if (sum_of_pieces<dim>(inside).area < min_area(cell))
        return {};
      for (Facet<dim> &piece : inside)
        std::reverse(piece.begin() + (dim - 2), piece.end());
      return {inside, true};
    }



    /// Return the obstacles of @p near which may cover parts of the surface of
    /// obstacle @p k in the ball of @p radius, m, around @p centre.
    template <int dim>
    std::vector<Cover<dim>>
    covers_of(const Obstacles<dim>                   &obstacles,
              const typename Obstacles<dim>::Numbers &near,
              const unsigned int                      k,
              const Point<dim>                       &centre,
              const double                            radius)
    {
      std::vector<Cover<dim>> covers;
      for (const unsigned int other : near)
        if (const Obstacle<dim> &o = obstacles[other];
            other != k &&
            (o.may_cut_ball(centre, radius) || o.signed_distance(centre) < 0))
          covers.push_back(
            {[&o](const Point<dim> &x) { return o.signed_distance(x); },
             [&o](const Point<dim> &x) { return o.normal(x); },
             /*covers_common_surface=*/other < k});
      return covers;
    }
  } // namespace



  namespace
  {
    /// Return a number for a facet and add the number to @p taken, the numbers
    /// of the obstacle in the cell. The number follows from the axis nearest to
    /// the normal: a facet keeps its number while facets come and go as the
    /// obstacle moves.
    template <int dim>
    unsigned int
    number_of_direction(const Tensor<1, dim>      &vector_area,
                        std::vector<unsigned int> &taken)
    {
      unsigned int axis = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(vector_area[d]) > std::abs(vector_area[axis]))
          axis = d;
      unsigned int number = 2 * axis + (vector_area[axis] > 0);
      while (std::count(taken.begin(), taken.end(), number) > 0)
        number += 2 * dim;
      taken.push_back(number);
      return number;
    }
  } // namespace



  /// Find the facets of all obstacles in cell @p c: the part of each surface
  /// outside of the other obstacles, one facet per direction. Whole surfaces
  /// which are partly covered or graze a face of the cell are hidden: no part
  /// of the contact, but points must not slip through.
  template <int dim>
  void
  Facets<dim>::find_facets(const Grid<dim>                        &grid,
                           const Obstacles<dim>                   &obstacles,
                           const typename Obstacles<dim>::Numbers &near,
                           const unsigned int                      c,
                           Section &section) const
  {
    const Cell<dim> &cell   = grid.cells()[c];
    const Point<dim> centre = centre_of(cell);
    const double     radius = outer_radius(cell);
    for (const unsigned int k : near)
      {
        const Obstacle<dim> &obstacle = obstacles[k];
        if (!obstacle.may_cut_ball(centre, radius))
          continue;
        const auto [pieces, is_grazing] = find_surface(cell, obstacle);
        const auto add = [&](const auto &surfaces, auto &facets) {
          std::vector<unsigned int> numbers;
          for (const CutSurface<dim> &surface : surfaces)
            if (surface.area >= min_area(cell))
              facets.push_back(
                {c,
                 grid.key_of_cell(c),
                 k,
                 number_of_direction<dim>(surface.vector_area, numbers),
                 cell.nodes(),
                 shape_values_at(cell.box(), surface.centroid),
                 surface.centroid,
                 surface.vector_area / surface.vector_area.norm(),
                 surface.area,
                 deviation_from_plane(surface, cell.size),
                 is_flat(surface),
                 obstacle.maximum_shear_stress(surface.centroid)});
        };
        const auto whole = surfaces_by_direction<dim>(pieces);
        if (is_grazing)
          {
            add(whole, section.hidden);
            continue;
          }
        const auto covers = covers_of(obstacles, near, k, centre, radius);
        if (covers.empty())
          {
            add(whole, section.facets);
            continue;
          }
        const auto open = uncovered_pieces<dim>(pieces, covers, cell.size);
        add(surfaces_by_direction<dim>(open), section.facets);
        if (sum_of_pieces<dim>(open).area <
            (1. - 1e-6) * sum_of_pieces<dim>(pieces).area)
          add(whole, section.hidden);
      }
  }



  /// Cut cell @p c. Only obstacles within three radii of the centre matter: if
  /// a surface cuts the cell, all places in the cell are within a diameter of
  /// the surface, and farther from obstacles outside of this ball.
  template <int dim>
  typename Facets<dim>::Section
  Facets<dim>::find_section(const Grid<dim>      &grid,
                            const Obstacles<dim> &obstacles,
                            const unsigned int    c) const
  {
    const Cell<dim> &cell = grid.cells()[c];
    Section          section;
    const Point<dim> centre = centre_of(cell);
    const auto       near   = obstacles.near(centre, 3. * outer_radius(cell));
    section.distance        = obstacles.signed_distance(centre, near);
    find_facets(grid, obstacles, near, c, section);
    for (const unsigned int k : near)
      {
        const auto is_of_k = [k](const ContactFacet<dim> &facet) {
          return facet.obstacle == k;
        };
        const auto has_none =
          [&](const std::vector<ContactFacet<dim>> &facets) {
            return std::none_of(facets.begin(), facets.end(), is_of_k);
          };
        if (obstacles[k].signed_distance(centre) < 0 &&
            has_none(section.facets) && has_none(section.hidden))
          section.containing.push_back(k);
      }
    if (!section.facets.empty() || !section.hidden.empty())
      section.open_volume =
        open_shape_integrals<dim>(cell.box(), [&](const Point<dim> &x) {
          return obstacles.signed_distance(x, near);
        });
    return section;
  }



  /// Update sections_ after a change of the mesh. Cutting is expensive, and
  /// most cells stay when a mesh that follows the soil changes: unless an
  /// obstacle moves, their sections are kept. Sections of removed cells are
  /// deleted.
  template <int dim>
  void
  Facets<dim>::keep_sections(const Grid<dim>      &grid,
                             const Obstacles<dim> &obstacles)
  {
    std::unordered_map<unsigned long, Section> kept;
    kept.reserve(grid.cells().size());
    for (unsigned int c = 0; c < grid.cells().size(); ++c)
      {
        const unsigned long key = grid.key_of_cell(c);
        if (auto known = sections_.extract(key);
            !known.empty() && !obstacles.move())
          kept.insert(std::move(known));
        else
          kept.emplace(key, find_section(grid, obstacles, c));
      }
    sections_.swap(kept);
  }



  template <int dim>
  void
  Facets<dim>::cut(const Grid<dim> &grid, const unsigned int c)
  {
    // Points may dip half a cell below a surface, and reach one cell more.
    const Cell<dim> &cell    = grid.cells()[c];
    const Section   &section = sections_.at(grid.key_of_cell(c));
    section_at_[c]           = &section;
    in_cell_[c].is_contained = !section.containing.empty();
    if (section.distance <= 0 &&
        section.distance > -2. * std::sqrt(double(dim)) * cell.size)
      cells_inside_.insert(c);
    else
      cells_inside_.erase(c);
    if (section.facets.empty() && section.hidden.empty())
      {
        cut_cells_.erase(c);
        cut_cell_at_[c] = nullptr;
        return;
      }
    CutCell &result = cut_cells_[c];
    cut_cell_at_[c] = &result;
    result.facets   = section.facets;
    result.hidden   = section.hidden;
    for (auto *facets : {&result.facets, &result.hidden})
      for (ContactFacet<dim> &facet : *facets)
        {
          facet.cell            = c;
          facet.node            = cell.nodes();
          facet.cell_size       = cell.size;
          facet.cell_is_uniform = cell.uniform;
        }
    for (ContactFacet<dim> &facet : result.hidden)
      facet.only_confines = true;
    result.open_volume = section.open_volume;
    result.touching    = cells_touching(grid, c);
    result.near        = cells_near(grid, c, result.touching);
  }



  template <int dim>
  void
  Facets<dim>::prepare(const Grid<dim> &grid, const Obstacles<dim> &obstacles)
  {
    cut_cells_.clear();
    cut_cell_at_.assign(grid.cells().size(), nullptr);
    section_at_.assign(grid.cells().size(), nullptr);
    cells_inside_.clear();
    clear_sums();
    in_cell_.assign(grid.cells().size(), {});
    n_facets_.assign(grid.n_nodes(), 0);
    open_volume_.assign(grid.n_nodes(), 0.);
    is_contact_node_.assign(grid.n_nodes(), 0);
    is_near_.assign(grid.cells().size(), 0);
    if (!obstacles.empty())
      {
        keep_sections(grid, obstacles);
        for (unsigned int c = 0; c < grid.cells().size(); ++c)
          cut(grid, c);
      }
    collect(grid, obstacles);
  }



  // Cells left by a moving obstacle still have a facet of the obstacle; cells
  // entered lie in the bounding box. No more cells need cutting, so the cost
  // follows the obstacle, not the mesh.
  template <int dim>
  void
  Facets<dim>::update(const Grid<dim> &grid, const Obstacles<dim> &obstacles)
  {
    std::set<unsigned int> cells;
    for (const auto &[c, cut_cell] : cut_cells_)
      for (const auto *facets : {&cut_cell.facets, &cut_cell.hidden})
        for (const ContactFacet<dim> &facet : *facets)
          if (obstacles[facet.obstacle].moves())
            cells.insert(c);
    // Steps of the smallest cell size, so that no cell is missed.
    const double h = grid.finest_size();
    for (unsigned int k = 0; k < obstacles.size(); ++k)
      {
        if (!obstacles[k].moves())
          continue;
        const Box<dim>                around = obstacles[k].bounding_box();
        std::array<unsigned int, dim> n;
        Point<dim>                    first;
        for (unsigned int d = 0; d < dim; ++d)
          {
            first[d] = std::max(around.lower[d] - h, grid.domain().lower[d]);
            const double last =
              std::min(around.upper[d] + h, grid.domain().upper[d]);
            n[d] = std::max(0., std::ceil((last - first[d]) / h) + 1.);
          }
        for_each_place<dim>(first, h, n, [&](const Point<dim> &x) {
          if (const unsigned int c = grid.find_cell(x);
              c != numbers::invalid_unsigned_int)
            cells.insert(c);
        });
      }
    clear_sums();
    for (const unsigned int c : cells)
      {
        sections_[grid.key_of_cell(c)] = find_section(grid, obstacles, c);
        cut(grid, c);
      }
    collect(grid, obstacles);
  }



  /// Clear the lists, and the sums at all nodes and cells in the lists.
  template <int dim>
  void
  Facets<dim>::clear_sums()
  {
    for (const unsigned int node : nodes_)
      {
        n_facets_[node]    = 0;
        open_volume_[node] = 0;
      }
    for (const NodeAndSurface &pair : nodes_and_obstacles_)
      is_contact_node_[pair.node] = 0;
    nodes_and_obstacles_.clear();
    for (const ContactFacet<dim> &facet : surfaces_)
      in_cell_[facet.cell].begin = in_cell_[facet.cell].end = 0;
    surfaces_.clear();
    for (const unsigned int c : listed_near_)
      is_near_[c] = 0;
    nodes_.clear();
    listed_near_.clear();
    owned_.clear();
    ghosts_.clear();
    owned_nodes_.clear();
    nodes_on_faces_.clear();
    owned_nodes_on_faces_.clear();
    nodes_inside_.clear();
  }



  /// Build lists and sums by node from the cut cells. Ghost cells are included,
  /// so that sums at owned nodes need no message.
  template <int dim>
  void
  Facets<dim>::collect(const Grid<dim> &grid, const Obstacles<dim> &obstacles)
  {
    std::vector<unsigned int> touching;
    for (const auto &[c, cut_cell] : cut_cells_)
      {
        for (const ContactFacet<dim> &facet : cut_cell.facets)
          {
            (c < grid.n_owned_cells() ? owned_ : ghosts_).push_back(facet);
            for (const unsigned int node : facet.node)
              {
                nodes_and_obstacles_.push_back({node, facet.obstacle});
                if (n_facets_[node]++ == 0)
                  nodes_.push_back(node);
              }
          }
        touching.insert(touching.end(),
                        cut_cell.touching.begin(),
                        cut_cell.touching.end());
      }
    sort_unique(touching);
    list_surfaces();
    mark_near(grid);
    for (const unsigned int node : nodes_)
      {
        const bool is_on_face  = grid.faces_of_node(node) != 0;
        is_contact_node_[node] = 1;
        if (is_on_face)
          nodes_on_faces_.push_back(node);
        if (node < grid.n_owned_nodes())
          {
            owned_nodes_.push_back(node);
            if (is_on_face)
              owned_nodes_on_faces_.push_back(node);
          }
      }
    for (const unsigned int c : touching)
      add_open_volume(grid, c);
    for (const unsigned int c : cells_inside_)
      find_nodes_inside(grid, obstacles, c);
    // A node has got a pair from each facet around.
    std::sort(nodes_and_obstacles_.begin(), nodes_and_obstacles_.end());
    nodes_and_obstacles_.erase(std::unique(nodes_and_obstacles_.begin(),
                                           nodes_and_obstacles_.end()),
                               nodes_and_obstacles_.end());
  }



  template <int dim>
  void
  Facets<dim>::list_surfaces()
  {
    for (const auto &[c, cut_cell] : cut_cells_)
      {
        in_cell_[c].begin = surfaces_.size();
        for (const auto *facets : {&cut_cell.facets, &cut_cell.hidden})
          surfaces_.insert(surfaces_.end(), facets->begin(), facets->end());
        in_cell_[c].end = surfaces_.size();
      }
  }



  /// Fill nearness_of_cells(). Most cut cells share their touching cells, so
  /// the neighbours of each touching cell are marked once.
  template <int dim>
  void
  Facets<dim>::mark_near(const Grid<dim> &grid)
  {
    const auto mark = [&](const auto &cells) {
      for (const unsigned int c : cells)
        if (c < grid.n_owned_cells() && !is_near_[c])
          {
            is_near_[c] = 1;
            listed_near_.push_back(c);
          }
    };
    std::vector<unsigned int> touching;
    for (const auto &[c, cut_cell] : cut_cells_)
      if (cut_cell.near.empty())
        touching.insert(touching.end(),
                        cut_cell.touching.begin(),
                        cut_cell.touching.end());
      else
        mark(cut_cell.near);
    sort_unique(touching);
    for (const unsigned int t : touching)
      mark(grid.cells()[t].neighbors);
    for (const auto &[c, cut_cell] : cut_cells_)
      if (c < grid.n_owned_cells() && !cut_cell.facets.empty())
        is_near_[c] = 2;
  }



  /// Add the open volume of cell @p c to its nodes.
  template <int dim>
  void
  Facets<dim>::add_open_volume(const Grid<dim> &grid, const unsigned int c)
  {
    const Cell<dim> &cell     = grid.cells()[c];
    const auto       nodes    = cell.nodes();
    const auto       cut_cell = cut_cells_.find(c);
    const bool       is_cut   = cut_cell != cut_cells_.end();
    const double     uncut =
      (!is_cut && sections_.at(grid.key_of_cell(c)).distance > 0
         ? std::pow(cell.size, dim) / nodes.size()
         : 0.);
    for (unsigned int v = 0; v < nodes.size(); ++v)
      if (n_facets_[nodes[v]] > 0)
        open_volume_[nodes[v]] +=
          (is_cut ? cut_cell->second.open_volume[v] : uncut);
  }



  /// List the nodes of cell @p c which lie inside an obstacle and touch no
  /// facet. All ranks agree on the distance, while the owner of a node need not
  /// know the cut cell near the node.
  template <int dim>
  void
  Facets<dim>::find_nodes_inside(const Grid<dim>      &grid,
                                 const Obstacles<dim> &obstacles,
                                 const unsigned int    c)
  {
    const Cell<dim> &cell  = grid.cells()[c];
    const auto       nodes = cell.nodes();
    const auto       near = obstacles.near(centre_of(cell), outer_radius(cell));
    for (unsigned int v = 0; v < nodes.size(); ++v)
      if (const Point<dim> x = cell.vertex(v);
          !is_contact_node_[nodes[v]] &&
          obstacles.signed_distance(x, near) <= 0)
        {
          is_contact_node_[nodes[v]]  = 1;
          const unsigned int obstacle = obstacles.nearest(x, near);
          nodes_and_obstacles_.push_back({nodes[v], obstacle});
          if (nodes[v] < grid.n_owned_nodes())
            nodes_inside_.push_back({nodes[v], x, obstacle});
        }
  }



  template class Facets<2>;
  template class Facets<3>;
} // namespace talus
