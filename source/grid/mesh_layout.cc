// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/base/memory.h>
#include <talus/grid/mesh_layout.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>

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
                  "Position of x = y = z = 0 on the map: easting, northing, "
                  "height [m]. Small coordinates of the mesh lose no digits; "
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
                  "Edge of the cells before 'Initial refinement', exact [m]. "
                  "If the extent of the box along an axis is not a multiple of "
                  "'Cell size', the upper face moves outwards; if the face is "
                  "a wall, the run is refused.",
                  this->prm,
                  Patterns::Double(1e-12));
    add_parameter("Coarsest level",
                  coarsest_level_,
                  "The mesh is a forest of trees with 2^L cells per axis. L is "
                  "the largest number up to this value for which 2^L divides "
                  "the number of cells along every axis. With 'Mesh tracking' "
                  "cells far from soil are up to 2^L times as large as 'Cell "
                  "size', and free faces at the upper end of an axis move "
                  "outwards where necessary.",
                  this->prm,
                  Patterns::Integer(0, 10));
    add_parameter(
      "Initial refinement",
      initial_refinement_,
      "Number n of times that all cells are halved [-]: h is 'Cell size' "
      "divided by 2^n.",
      this->prm,
      Patterns::Integer(0, 10));
    add_parameter(
      "Refinement boxes",
      refinement_boxes_,
      "Boxes with smaller cells, separated by bars (|). Each box is given by "
      "lower corner; upper corner; number of times the cells are halved. "
      "Corners in m. Example: -40,0; 280,0.4; 1 halves the cells in a layer of "
      "0.4 m at the seabed. Neighbouring cells differ by at most a factor of "
      "two.");
  }



  template <int dim>
  Box<dim>
  MeshLayout<dim>::box_of_parameters() const
  {
    return PlaceCoordinates("Grid", coordinates_, dim, origin_)
      .box(lower_corner_, upper_corner_);
  }



  template <int dim>
  double
  MeshLayout<dim>::cell_size_of_parameters() const
  {
    unsigned int n_levels = 0;
    for (const RefinementBox<dim> &box : parse_refinement_boxes(
           refinement_boxes_,
           box_of_parameters(),
           PlaceCoordinates("Grid", coordinates_, dim, origin_)))
      n_levels = std::max(n_levels, box.n_levels);
    return cell_size_ / (1u << n_levels);
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



  /// Compute the number of cells along axis d, a multiple of @p factor, and
  /// move the upper face outwards if necessary and allowed. The cell size is
  /// never changed, since results depend on it: if the length of an axis does
  /// not fit, the length changes, at a face without boundary condition. Walls
  /// never move.
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
    // Compared as doubles, before rounding to an integer could overflow.
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



  /// Throw ExcUser if positions in the lattice of the smallest cells do not fit
  /// into keys.
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
        // Growth may add one of the largest cells.
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



  /// Return the largest level of trees, up to 'Coarsest level', whose cells
  /// divide all axes that must not grow. p4est coarsens cells only within a
  /// tree, so a tree is the largest possible cell. Every rank stores all trees:
  /// few large trees also save memory.
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
    /// Throw ExcUser if an axis is periodic and cells have several sizes.
    /// @param graded reason for several cell sizes, part of the message; empty
    ///   if all cells have the same size
    template <int dim>
    void
    check_one_size(const std::array<bool, dim> &periodic,
                   const std::string           &graded)
    {
      for (unsigned int d = 0; d < dim; ++d)
        AssertThrow(!periodic[d] || graded.empty(),
                    ExcUser("The faces '" + face_names[2 * d] + "' and '" +
                            face_names[2 * d + 1] +
                            "' are periodic, which requires cells of one "
                            "size, but " +
                            graded +
                            ". Change the parameter, or choose another "
                            "condition for the faces."));
    }
  } // namespace



  // The axes are fitted twice: first to cells of size h, which determines the
  // level of the trees, then, with mesh tracking, to the largest cells of this
  // level. The log gets the sentence of the second fit, which includes the
  // first.
  template <int dim>
  std::vector<unsigned int>
  MeshLayout<dim>::lay_out(const MPI_Comm                   communicator,
                           const std::array<bool, 2 * dim> &may_move,
                           const bool                       grow,
                           const std::array<bool, dim>     &periodic)
  {
    domain_          = box_of_parameters();
    grows_           = grow;
    memory_per_rank_ = talus::memory_per_rank(communicator);
    n_ranks_         = Utilities::MPI::n_mpi_processes(communicator);
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
    // With mesh tracking the small cells never fill the whole mesh.
    check_memory(grow ? n_trees : n_cells);
    tree_size_   = cell_size_ * (1u << level);
    base_level_  = level + initial_refinement_;
    periodicity_ = Periodicity<dim>(periodic, domain_);
    return trees;
  }



  template <int dim>
  double
  MeshLayout<dim>::max_n_cells(const double n_ranks)
  {
    const double max_n_nodes =
      std::numeric_limits<types::global_dof_index>::max();
    return std::min(4e8 * n_ranks, 0.9 * max_n_nodes);
  }



  /// The test runs before p4est or deal.II run out of memory with their own
  /// messages. Memory per cell was measured without points (doc/cluster.md),
  /// and a run needs more: a rejected mesh cannot work.
  template <int dim>
  void
  MeshLayout<dim>::check_memory(const double n_cells) const
  {
    constexpr double bytes_per_cell = (dim == 2 ? 720. : 1470.);
    const double     bytes          = n_cells * bytes_per_cell / n_ranks_;
    AssertThrow(n_cells < max_n_cells(n_ranks_) && bytes < memory_per_rank_,
                ExcUser(
                  text("The mesh would have ",
                       n_cells,
                       " cells, which take some ",
                       bytes / 1e9,
                       " GB of memory on each rank. ",
                       memory_per_rank_ / 1e9,
                       " GB are available, and ",
                       max_n_cells(n_ranks_),
                       " cells are the maximum on ",
                       counted(n_ranks_, "rank"),
                       ". Choose a larger Grid/Cell size than ",
                       cell_size_,
                       " m, a smaller box",
                       initial_refinement_ > 0
                         ? text(", less Grid/Initial refinement than ",
                                initial_refinement_)
                         : "",
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



  // A position outside of the mesh gets the nearest cell: a point that dips
  // into a wall belongs to the cell at the wall. Relocation checks how far it
  // dips.
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
        // Compared as doubles: x may be any number or NaN.
        place[d] = !(at > 0.)            ? 0
                   : at < extent[d] - 1. ? static_cast<long>(at)
                                         : extent[d] - 1;
      }
    return place;
  }



  template class MeshLayout<2>;
  template class MeshLayout<3>;
} // namespace talus
