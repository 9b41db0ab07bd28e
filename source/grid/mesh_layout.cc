// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/base/memory.h>
#include <talus/grid/mesh_layout.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <iomanip>

namespace talus
{
  using namespace dealii;

  const std::array<std::string, 6> face_names = {
    {"Left", "Right", "Bottom", "Top", "Back", "Front"}};

  template <int dim>
  MeshLayout<dim>::MeshLayout()
    : ParameterAcceptor("/Grid")
  {
    for (unsigned int d = 0; d < dim; ++d)
      upper_corner_[d] = 1.;
    add_parameter("Lower corner",
                  lower_corner_,
                  "Corner of the box that the mesh fills, with the smallest "
                  "coordinates [m].");
    add_parameter("Upper corner",
                  upper_corner_,
                  "Corner of the box that the mesh fills, with the largest "
                  "coordinates [m].");
    add_parameter("Origin",
                  origin_,
                  "Where x = y = z = 0 of the mesh lies on the map: easting, "
                  "northing and height [m]. Rasters are read relative to it, "
                  "so that coordinates are small numbers that lose no digits; "
                  "in 2-D only the height counts.",
                  this->prm,
                  Patterns::List(Patterns::Double(-1e9, 1e9), 3, 3));
    add_parameter("Coordinates",
                  coordinates_,
                  "'map', 3-D only: the corners of the mesh and of `Refinement "
                  "boxes` are easting, northing, height.",
                  this->prm,
                  Patterns::Selection("mesh|map"));
    add_parameter("Cell size",
                  cell_size_,
                  "Edge h of the cells, exact [m]. Where an extent of the box "
                  "is no multiple of it, the upper face moves outwards, which "
                  "is refused for walls.",
                  this->prm,
                  Patterns::Double(1e-12));
    add_parameter("Coarsest level",
                  coarsest_level_,
                  "The mesh is a forest of trees with 2^L cells per axis; L is "
                  "the largest number up to this one that divides the cells of "
                  "every axis. With 'Mesh tracking' it is how much coarser far "
                  "cells may be, and faces that are free, at the upper end of "
                  "an axis, move outwards where that takes it.",
                  this->prm,
                  Patterns::Integer(0, 10));
    add_parameter(
      "Initial refinement",
      initial_refinement_,
      "Halve all cells this many times: h is 'Cell size' divided by "
      "2^n.",
      this->prm,
      Patterns::Integer(0, 10));
    add_parameter(
      "Refinement boxes",
      refinement_boxes_,
      "Boxes with smaller cells, separated by bars (|), each as "
      "lower corner; upper corner; number of times the cells are "
      "halved there: -40,0; 280,0.4; 1 makes a layer of 0.4 m at the "
      "seabed finer. Corners in m; neighbouring cells differ by at "
      "most a factor of two.");
  }



  template <int dim>
  Box<dim>
  MeshLayout<dim>::box_of_parameters() const
  {
    return PlaceCoordinates("Grid", coordinates_, dim, origin_)
      .box(lower_corner_, upper_corner_);
  }



  template <int dim>
  void
  MeshLayout<dim>::check() const
  {
    for (unsigned int d = 0; d < dim; ++d)
      AssertThrow(upper_corner_[d] > lower_corner_[d],
                  ExcUser(text("Grid/Upper corner (",
                               upper_corner_,
                               ") must lie above Grid/Lower corner (",
                               lower_corner_,
                               ") in every coordinate; coordinate ",
                               d,
                               " does not.")));
    box_of_parameters(); // throws if there is no map
  }



  template <int dim>
  bool
  MeshLayout<dim>::box_wants_finer(const Lattice     &place,
                                   const unsigned int level) const
  {
    return std::any_of(boxes_.begin(), boxes_.end(), [&](const auto &box) {
      return level < base_level_ + box.n_levels &&
             overlap(box, lower_corner_of(place, level), size_of_level(level));
    });
  }



  template <int dim>
  double
  MeshLayout<dim>::finest_size_in(const Box<dim> &box) const
  {
    unsigned int n_levels = 0;
    for (const RefinementBox<dim> &finer : boxes_)
      {
        bool meets = true;
        for (unsigned int d = 0; d < dim; ++d)
          meets = meets && finer.box.lower[d] < box.upper[d] &&
                  finer.box.upper[d] > box.lower[d];
        if (meets)
          n_levels = std::max(n_levels, finer.n_levels);
      }
    return size_of_level(base_level_ + n_levels);
  }



  /// Number of cells along axis d, a multiple of @p factor; moves the upper
  /// face for that where it may.
  /// Cells must have exactly the size asked for, since results depend on it:
  /// where the length of an axis does not fit it is the length that changes, at
  /// a face where no condition holds. A wall stays where the user put it.
  template <int dim>
  void
  MeshLayout<dim>::fit_axis(const unsigned int d,
                            const bool         may_move,
                            const unsigned int factor)
  {
    const double h         = cell_size_;
    const double asked_for = box_of_parameters().upper[d];
    const double exact     = box_of_parameters().length(d) / h;
    const double whole     = std::round(exact);
    const bool   fits = whole >= 1 && std::abs(exact - whole) <= 1e-9 * whole;
    const unsigned int face = 2 * d + 1;
    // As doubles, before anything is rounded to an integer that could overflow.
    AssertThrow(exact < 2e9,
                ExcUser(text("The mesh would have ",
                             exact,
                             " cells along axis ",
                             d,
                             ". Choose a larger Grid/Cell size than ",
                             h,
                             " m.")));
    AssertThrow(fits || exact > 1,
                ExcUser(text(std::setprecision(12),
                             "The mesh is only ",
                             exact * h,
                             " m long along axis ",
                             d,
                             ", less than one cell of Grid/Cell size = ",
                             h,
                             " m. Choose smaller cells or a larger box.")));
    AssertThrow(fits || may_move,
                ExcUser(
                  text(std::setprecision(12),
                       "The mesh is ",
                       exact * h,
                       " m long along axis ",
                       d,
                       ", which is no multiple of Grid/Cell size = ",
                       h,
                       " m, and its face '",
                       face_names[face],
                       "' is not free, so it must not move. Choose another "
                       "cell size or corner.")));
    unsigned int n = static_cast<unsigned int>(fits ? whole : std::ceil(exact));
    n              = (n + factor - 1) / factor * factor;
    n_cells_per_axis_[d] = n;
    if (fits && n == whole)
      return;
    domain_.upper[d] = domain_.lower[d] + n * h;
    adjustment_ += text(std::setprecision(12),
                        " The face '",
                        face_names[face],
                        "' was moved outwards from ",
                        asked_for,
                        " m to ",
                        domain_.upper[d],
                        " m, so that the ",
                        factor > 1 ? "largest " : "",
                        "cells are ",
                        factor * h,
                        " m long.");
  }



  /// Places in the lattice of the smallest cells must fit into their keys.
  template <int dim>
  void
  MeshLayout<dim>::check_lattice(const unsigned int level) const
  {
    unsigned int n_halvings = initial_refinement_;
    for (const RefinementBox<dim> &box : boxes_)
      n_halvings = std::max(n_halvings, initial_refinement_ + box.n_levels);
    const double most = std::pow(2., 58 / dim);
    for (unsigned int d = 0; d < dim; ++d)
      {
        // Far cells may add one of the largest.
        const double n = (1. * n_cells_per_axis_[d] + (1u << level)) *
                         std::pow(2., n_halvings);
        AssertThrow(n < most,
                    ExcUser(text("With its smallest cells everywhere the mesh "
                                 "would have ",
                                 n,
                                 " cells along axis ",
                                 d,
                                 ", more than ",
                                 most,
                                 ". Choose a larger Grid/Cell size than ",
                                 cell_size_,
                                 " m, a smaller box or less refinement.")));
      }
  }



  /// The largest level up to the one asked for that divides the cells of all
  /// axes that must not grow.
  /// p4est joins cells only within a tree, so trees are as large as cells can
  /// ever become. Every rank holds all trees: few large ones also save memory.
  template <int dim>
  unsigned int
  MeshLayout<dim>::level_of_trees(const std::array<bool, 2 * dim> &may_move,
                                  const bool                       grow) const
  {
    unsigned int level = coarsest_level_;
    for (unsigned int d = 0; d < dim; ++d)
      if (!(grow && may_move[2 * d + 1]))
        while (n_cells_per_axis_[d] % (1u << level) != 0)
          --level;
    return level;
  }



  namespace
  {
    /// @param graded what makes cells of several sizes; empty if nothing does.
    template <int dim>
    void
    check_one_size(const std::array<bool, dim> &periodic,
                   const std::string           &graded)
    {
      for (unsigned int d = 0; d < dim; ++d)
        AssertThrow(!periodic[d] || graded.empty(),
                    ExcUser("The faces '" + face_names[2 * d] + "' and '" +
                            face_names[2 * d + 1] +
                            "' are periodic, which asks for cells of one size, "
                            "but " +
                            graded +
                            ". Change that, or choose another condition for "
                            "these faces."));
    }
  } // namespace



  // The axes are fitted twice: first to the cells of size h, which says what
  // divides what, then, with mesh tracking, to the largest cells that follow
  // from it. The sentence for the log is that of the second time, which repeats
  // what the first one found.
  template <int dim>
  std::vector<unsigned int>
  MeshLayout<dim>::lay_out(const std::array<bool, 2 * dim> &may_move,
                           const bool                       grow,
                           const std::array<bool, dim>     &periodic)
  {
    domain_          = box_of_parameters();
    grows_           = grow;
    memory_per_rank_ = talus::memory_per_rank(MPI_COMM_WORLD);
    for (unsigned int d = 0; d < dim; ++d)
      fit_axis(d, may_move[2 * d + 1], 1);
    domain_before_growth_ = domain_;
    boxes_                = parse_refinement_boxes(
      refinement_boxes_,
      domain_,
      PlaceCoordinates("Grid", coordinates_, dim, origin_));
    check_one_size<dim>(periodic,
                        grow             ? "'Mesh tracking/Enabled' is true"
                        : boxes_.empty() ? ""
                                         : "'Grid/Refinement boxes' is '" +
                                             refinement_boxes_ + "'");
    const unsigned int level = level_of_trees(may_move, grow);
    check_lattice(level);
    adjustment_.clear();
    for (unsigned int d = 0; d < dim; ++d)
      fit_axis(d,
               may_move[2 * d + 1],
               grow && may_move[2 * d + 1] ? 1u << level : 1u);

    double                    n_cells = 1, n_trees = 1;
    std::vector<unsigned int> trees(dim);
    for (unsigned int d = 0; d < dim; ++d)
      {
        trees[d] = n_cells_per_axis_[d] >> level;
        n_trees *= trees[d];
        n_cells *= 1. * n_cells_per_axis_[d] * (1u << initial_refinement_);
      }
    // With mesh tracking the mesh of small cells never exists as a whole.
    check_memory(grow ? n_trees : n_cells);
    tree_size_   = cell_size_ * (1u << level);
    base_level_  = level + initial_refinement_;
    periodicity_ = Periodicity<dim>(periodic, domain_);
    return trees;
  }



  /// p4est counts cells of a rank by 32 bits; and before it or deal.II run out of
  /// memory, which they say in words of their own, the user is told. What a cell
  /// takes was measured (doc/cluster.md), without points and not with all that a
  /// run may add: what is refused here cannot work.
  template <int dim>
  void
  MeshLayout<dim>::check_memory(const double n_cells) const
  {
    constexpr double bytes_per_cell = (dim == 2 ? 720. : 1470.);
    const double     bytes          = n_cells * bytes_per_cell /
                         Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    AssertThrow(n_cells < 4e8 && bytes < memory_per_rank_,
                ExcUser(
                  text("The mesh would have ",
                       n_cells,
                       " cells, which take some ",
                       bytes / 1e9,
                       " GB of memory on each rank, where ",
                       memory_per_rank_ / 1e9,
                       " GB are to be had, and 4e8 cells are the most. "
                       "Choose a larger Grid/Cell size than ",
                       cell_size_,
                       " m, a smaller box",
                       boxes_.empty() ? "" : ", fewer Grid/Refinement boxes",
                       grows_ ? ", a larger Grid/Coarsest level" : "",
                       ", or more ranks on more machines.")));
  }



  template <int dim>
  Point<dim>
  MeshLayout<dim>::lower_corner_of(const Lattice     &place,
                                   const unsigned int level) const
  {
    Point<dim> corner;
    for (unsigned int d = 0; d < dim; ++d)
      corner[d] = domain_.lower[d] + place[d] * size_of_level(level);
    return corner;
  }



  template <int dim>
  typename MeshLayout<dim>::Lattice
  MeshLayout<dim>::extent_of_lattice(const unsigned int level) const
  {
    Lattice extent;
    for (unsigned int d = 0; d < dim; ++d)
      extent[d] = std::lround(domain_.length(d) / size_of_level(level));
    return extent;
  }



  // Where a place lies outside of the mesh the nearest cell: a point that dips
  // into a wall belongs to the cell at the wall. How far it may do so,
  // Relocation checks.
  template <int dim>
  typename MeshLayout<dim>::Lattice
  MeshLayout<dim>::lattice_place(const Point<dim>  &x,
                                 const unsigned int level) const
  {
    const double  size   = size_of_level(level);
    const Lattice extent = extent_of_lattice(level);
    Lattice       place;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double at = std::floor((x[d] - domain_.lower[d]) / size);
        // Compared as doubles: a point may be anywhere, or not a number.
        place[d] = !(at > 0.)            ? 0
                   : at < extent[d] - 1. ? static_cast<long>(at)
                                         : extent[d] - 1;
      }
    return place;
  }



  template class MeshLayout<2>;
  template class MeshLayout<3>;
} // namespace talus
