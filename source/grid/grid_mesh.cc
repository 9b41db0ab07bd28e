// SPDX-License-Identifier: LGPL-2.1-or-later
// The part of Grid that makes the mesh and changes it.

#include <talus/base/errors.h>
#include <talus/grid/grid.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// A corner of a refinement box, m; @p boxes is the whole parameter, for
    /// the messages.
    template <int dim>
    Point<dim>
    parse_corner(const std::string &corner, const std::string &boxes)
    {
      const auto numbers = Utilities::split_string_list(corner, ',');
      Point<dim> x;
      AssertThrow(numbers.size() == dim,
                  ExcUser("'Grid/Refinement boxes = " + boxes +
                          "' contains the corner '" + corner + "', where " +
                          std::to_string(dim) +
                          " numbers separated by commas were expected."));
      for (unsigned int d = 0; d < dim; ++d)
        {
          AssertThrow(Patterns::Double().match(numbers[d]),
                      ExcUser("'Grid/Refinement boxes = " + boxes +
                              "' contains '" + numbers[d] +
                              "', where a number was expected."));
          x[d] = Utilities::string_to_double(numbers[d]);
        }
      return x;
    }
  } // namespace



  /// Set boxes_ from the parameter. A box outside of the mesh is an error:
  /// nothing would be refined, and nobody would notice.
  template <int dim>
  void
  Grid<dim>::parse_refinement_boxes()
  {
    boxes_.clear();
    for (const auto &entry :
         Utilities::split_string_list(refinement_boxes_, '|'))
      {
        const auto parts = Utilities::split_string_list(entry, ';');
        AssertThrow(parts.size() == 3 &&
                      Patterns::Integer(1, 10).match(parts[2]),
                    ExcUser("'Grid/Refinement boxes = " + refinement_boxes_ +
                            "' contains '" + entry +
                            "', where 'lower corner; upper corner; n' was "
                            "expected, with n from 1 to 10."));
        const Box<dim> box{parse_corner<dim>(parts[0], refinement_boxes_),
                           parse_corner<dim>(parts[1], refinement_boxes_)};
        for (unsigned int d = 0; d < dim; ++d)
          AssertThrow(box.lower[d] < box.upper[d],
                      ExcUser("'Grid/Refinement boxes = " + refinement_boxes_ +
                              "' contains '" + entry +
                              "', whose upper corner must lie above the lower "
                              "one in every coordinate."));
        for (unsigned int d = 0; d < dim; ++d)
          AssertThrow(box.lower[d] < domain_.upper[d] &&
                        box.upper[d] > domain_.lower[d],
                      ExcUser(text("'Grid/Refinement boxes = ",
                                   refinement_boxes_,
                                   "' contains '",
                                   entry,
                                   "', which lies outside the mesh from (",
                                   domain_.lower,
                                   ") to (",
                                   domain_.upper,
                                   ") m. Move or remove it.")));
        boxes_.push_back({box, static_cast<unsigned int>(std::stoi(parts[2]))});
      }
  }



  /// Whether the cell at this place overlaps a refinement box that asks for
  /// smaller cells. Cells that only share a face with a box do not, whatever
  /// the round-off in its corners.
  template <int dim>
  bool
  Grid<dim>::box_wants_finer(const Lattice     &place,
                             const unsigned int level) const
  {
    const double size = tree_size_ / (1u << level);
    for (const RefinementBox<dim> &box : boxes_)
      {
        bool overlaps = (level < base_level_ + box.n_levels);
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double lower = domain_.lower[d] + place[d] * size;
            overlaps = overlaps && lower < box.box.upper[d] - 1e-9 * size &&
                       lower + size > box.box.lower[d] + 1e-9 * size;
          }
        if (overlaps)
          return true;
      }
    return false;
  }



  /// Number of cells along axis d, a multiple of @p factor; moves the upper
  /// face for that where it may.
  /// Cells must have exactly the size asked for, since results depend on it:
  /// where the length of an axis does not fit it is the length that changes, at
  /// a face where no condition holds. A wall stays where the user put it.
  template <int dim>
  void
  Grid<dim>::fit_axis(const unsigned int d,
                      const bool         may_move,
                      const unsigned int factor)
  {
    const double h     = cell_size_;
    const double exact = (upper_corner_[d] - lower_corner_[d]) / h;
    const double whole = std::round(exact);
    const bool   fits  = whole >= 1 && std::abs(exact - whole) <= 1e-9 * whole;
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
                ExcUser(text("The mesh is only ",
                             exact * h,
                             " m long along axis ",
                             d,
                             ", less than one cell of Grid/Cell size = ",
                             h,
                             " m. Choose smaller cells or a larger box.")));
    AssertThrow(fits || may_move,
                ExcUser(
                  text("The mesh is ",
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
    adjustment_ += text(" The face '",
                        face_names[face],
                        "' was moved outwards from ",
                        upper_corner_[d],
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
  Grid<dim>::check_lattice(const unsigned int level) const
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
  Grid<dim>::level_of_trees(const std::array<bool, 2 * dim> &may_move,
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
  void
  Grid<dim>::create(const std::array<bool, 2 * dim> &may_move,
                    const bool                       grow,
                    const std::array<bool, dim>     &periodic)
  {
    domain_ = {lower_corner_, upper_corner_};
    for (unsigned int d = 0; d < dim; ++d)
      fit_axis(d, may_move[2 * d + 1], 1);
    domain_before_growth_ = domain_;
    parse_refinement_boxes();
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
    AssertThrow((grow ? n_trees : n_cells) < 4e8,
                ExcUser(text("The mesh would have ",
                             grow ? n_trees : n_cells,
                             " cells. Choose a larger Grid/Cell size than ",
                             cell_size_,
                             " m or a smaller box",
                             grow ? ", or raise Grid/Coarsest level." : ".")));
    tree_size_  = cell_size_ * (1u << level);
    base_level_ = level + initial_refinement_;
    triangulation_.clear();
    GridGenerator::subdivided_hyper_rectangle(
      triangulation_, trees, domain_.lower, domain_.upper, /*colorize=*/true);
    periodicity_ = Periodicity<dim>(periodic, domain_);
    if (periodicity_.any())
      periodicity_.join_faces(triangulation_);
  }



  // First down to h everywhere, which asks nobody, and the cells spread over
  // the ranks; then the boxes, which may lie on one of them.
  template <int dim>
  void
  Grid<dim>::refine()
  {
    triangulation_.refine_global(base_level_);
    triangulation_.repartition();
    if (!boxes_.empty())
      refine([&](const Lattice &,
                 const unsigned int level) { return level < base_level_; },
             true);
  }



  /// Returns what any rank flagged cells for: 1 to be divided, 2 joined, 3
  /// both. Whether a cell is to be divided or joined follows from what lies in
  /// it now, not from its history: a cell is joined with its siblings if what
  /// contains them all asks for nothing. So two runs that come to the same soil
  /// have the same mesh.
  template <int dim>
  unsigned int
  Grid<dim>::flag_cells(const WantsFiner &wants_finer)
  {
    const auto wants = [&](const Lattice &place, const unsigned int level) {
      return box_wants_finer(place, level) || wants_finer(place, level);
    };
    unsigned int flags = 0;
    for (const auto &cell : triangulation_.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int level = cell->level();
          Lattice            place = lattice_place(cell->center(), level);
          if (wants(place, level))
            {
              cell->set_refine_flag();
              flags |= 1;
            }
          else if (level > 0)
            {
              for (auto &p : place)
                p /= 2;
              if (!wants(place, level - 1))
                {
                  cell->set_coarsen_flag();
                  flags |= 2;
                }
            }
        }
    return (Utilities::MPI::max(flags & 1, communicator()) |
            Utilities::MPI::max(flags & 2, communicator()));
  }



  // deal.II changes cells by one level at a time, and keeps neighbours within a
  // factor of two by dividing more, or joining fewer, than were flagged: so
  // flag and change until nothing is left to do. Each round looks at every cell
  // once; what they agree on is the same on all ranks.
  template <int dim>
  bool
  Grid<dim>::refine(const WantsFiner &wants_finer, const bool spread)
  {
    bool changed = false;
    while (true)
      {
        const auto n_before = triangulation_.n_global_active_cells();
        const auto flags    = flag_cells(wants_finer);
        if (flags == 0)
          return changed;
        triangulation_.execute_coarsening_and_refinement();
        // Cells that cannot be joined beside smaller ones stay flagged for
        // ever.
        if (!(flags & 1) && n_before == triangulation_.n_global_active_cells())
          return changed;
        changed = true;
        // Only before there are points, which would be left behind on the rank
        // that owned their cell.
        if (spread)
          triangulation_.repartition();
      }
  }



#define INSTANTIATE(dim)                                             \
  template void Grid<dim>::create(const std::array<bool, 2 * dim> &, \
                                  bool,                              \
                                  const std::array<bool, dim> &);    \
  template void Grid<dim>::refine();                                 \
  template bool Grid<dim>::refine(const WantsFiner &, bool);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace talus
