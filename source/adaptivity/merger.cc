// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/adaptivity/merger.h>
#include <talus/base/assertion.h>
#include <talus/base/errors.h>
#include <talus/points/points_kernel.h>
#include <talus/transfer/box_rule.h>
#include <talus/transfer/film.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <optional>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Stretch that a merged point must be able to bear before a split [-].
    constexpr double margin = 1.25;

    /// Number of points of a cell down to which a film is merged in 3-D: half
    /// as many again as boxes of half a cell need. A film one point thick has a
    /// third of this number and keeps its neighbours. In 2-D films are not
    /// merged: on a bed with steps a merged point may sink by half a cell.
    constexpr std::size_t n_in_film = 12;

    /// Misfit by round-off of boxes that fit exactly [-].
    constexpr double round_off = 1e-12;
  } // namespace



  template <int dim>
  Merger<dim>::Merger()
    : ParameterAcceptor("/Splitting")
  {
    add_parameter("Merge",
                  merge_,
                  "Whether points of one body that lie side by side in a cell "
                  "are merged, where soil is compressed, sheared or at rest "
                  "and needs fewer points. 'true': only points that come from "
                  "a split; 'all': any points. Not where shear is counted, "
                  "nor points of hyperelastic laws.",
                  this->prm,
                  Patterns::Selection("false|true|all"));
    add_parameter("Merge interval",
                  interval_,
                  "Number of steps between two searches for points to merge "
                  "[-].",
                  this->prm,
                  Patterns::Integer(1));
    add_parameter("Merge length",
                  length_,
                  "Largest length of a merged point along the edge on which "
                  "the two points lie, in cells [-], limited to 0.8 times "
                  "'Minimum length', so that soil is not merged and split in "
                  "turn.",
                  this->prm,
                  Patterns::Double(0., 0.8));
    add_parameter("Merge tolerance",
                  tolerance_,
                  "Largest relative error in volume with which the cells of "
                  "two points count as one cell [-]; 0 merges only cells that "
                  "fit to round-off.",
                  this->prm,
                  Patterns::Double(0., 0.5));
  }



  template <int dim>
  void
  Merger<dim>::prepare(const Splitter<dim> &splitter, const BoxShape &shape)
  {
    enabled_ = merge_ == "all" || (merge_ == "true" && splitter.is_enabled());
    AssertThrow(!enabled_ || !shape.counts_shear,
                ExcUser("Points are merged by their cells, but 'Splitting/"
                        "Shear = counted' splits boxes parallel to the axes. "
                        "Set 'Splitting/Merge = false', or 'Shear = "
                        "ignored'."));
    AssertThrow(!enabled_ || shape.rule != BoxRule::fixed,
                ExcUser("Points are merged by their cells, but the boxes of "
                        "'Transfer/Box rule = fixed' do not follow the cells. "
                        "Set 'Splitting/Merge = false', or another rule."));
    length_ = std::min(length_, splitter.min_split_length() / margin);
  }



  /// Return whether two points along @p axis may be merged into the cell
  /// @p joint: nearly a cell, no longer than `Merge length` and far from a
  /// split, in cells of the grid of size @p cell_size, m.
  template <int dim>
  bool
  Merger<dim>::fits(const JointCell<dim> &joint,
                    const unsigned int    axis,
                    const double          cell_size,
                    const Splitter<dim>  &splitter) const
  {
    if (joint.axis() != axis || joint.misfit() > tolerance_ + round_off)
      return false;
    const Tensor<2, dim> edges = transpose(joint.edges());
    if (edges[joint.edge_of_pair()].norm() >
        (1. + round_off) * length_ * cell_size)
      return false;
    for (unsigned int k = 0; k < dim; ++k)
      if (splitter.would_split(edges[k].norm() / cell_size, margin))
        return false;
    return true;
  }



  /// Merge pairs of members_ along @p axis while there are more than @p n_kept.
  /// Returns the kinetic energy lost, J.
  ///
  /// Each point, in the order of positions, is merged with the best fitting of
  /// the points behind until none fits. A row of boxes is thus merged from its
  /// lower end, independent of the round-off in the misfits, which depends on
  /// the number of ranks: of two fits that differ by round-off the first is
  /// taken.
  template <int dim>
  double
  Merger<dim>::merge_along(const unsigned int   axis,
                           Points<dim>         &points,
                           const BoxRule        rule,
                           const double         cell_size,
                           const std::size_t    n_kept,
                           const Splitter<dim> &splitter)
  {
    const auto is_lower = [&](const unsigned int p, const unsigned int q) {
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double *x = points.data(points.position, (axis + d) % dim);
          if (x[p] != x[q])
            return x[p] < x[q];
        }
      return p < q;
    };
    std::sort(members_.begin(), members_.end(), is_lower);
    double loss = 0;
    for (std::size_t i = 0; i < members_.size() && members_.size() > n_kept;)
      {
        std::size_t                   partner = 0;
        std::optional<JointCell<dim>> best;
        for (std::size_t j = i + 1; j < members_.size(); ++j)
          {
            const JointCell<dim> joint(points, members_[i], members_[j]);
            if ((!best || joint.misfit() < best->misfit() - round_off) &&
                fits(joint, axis, cell_size, splitter))
              {
                best    = joint;
                partner = j;
              }
          }
        if (best)
          {
            loss +=
              merge_pair(points, rule, members_[i], members_[partner], *best);
            removed_.push_back(members_[partner]);
            members_.erase(members_.begin() + partner);
          }
        else
          ++i;
      }
    return loss;
  }



  // If a neighbour is smaller, take half the size of the cell: its points may
  // enter the smaller cell in the next step.
  template <int dim>
  double
  Merger<dim>::merge(Points<dim>               &points,
                     const Grid<dim>           &grid,
                     const BoxRule              rule,
                     const std::vector<double> &added_mass,
                     const Splitter<dim>       &splitter)
  {
    removed_.clear();
    double loss = 0;
    for (const Segment &segment : points.segments())
      {
        const std::size_t n_kept = (n_kept_ ? n_kept_(segment) : 0);
        const Cell<dim>  &cell   = grid.cells()[segment.cell];
        const double      size   = cell.size * (cell.uniform ? 1. : 0.5);
        members_.clear();
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          if (!points.feeds(p) &&
              (merge_ == "all" || points.data(points.generation)[p] > 0))
            members_.push_back(p);
        double of_segment = 0;
        for (unsigned int d = 0; d < dim; ++d)
          of_segment += merge_along(d, points, rule, size, n_kept, splitter);
        loss += of_segment *
                (added_mass.empty() ? 1. : 1. + added_mass[segment.body]);
      }
    if (!removed_.empty())
      {
        n_merges_ += removed_.size();
        std::vector<CellChange> none;
        reordering_.merge(points.segments(), none, removed_);
        reordering_.apply(points);
      }
    TalusAssert(conservation_error() <= 1e-12,
                ExcMessage("Merged points differ from their parts by more than "
                           "round-off in mass, momentum or energy."));
    return loss;
  }



  namespace
  {
    /// Kinetic energy lost when two points get a common velocity, J.
    template <int dim>
    double
    kinetic_energy_lost(const Points<dim> &points,
                        const unsigned int p,
                        const unsigned int q)
    {
      const double m_p = points.data(points.mass)[p],
                   m_q = points.data(points.mass)[q];
      return 0.5 * m_p * m_q / (m_p + m_q) *
             (load_vector(points, points.velocity, p) -
              load_vector(points, points.velocity, q))
               .norm_square();
    }



    /// Merge all columns of points @p p and @p q into @p p. Extensive columns
    /// are summed. Stress and pressures are means weighted by volume
    /// (@p volume_share of point p), so that internal forces at the nodes are
    /// kept; all further columns are means weighted by mass (@p mass_share of
    /// point p).
    template <int dim>
    void
    join_columns(Points<dim>       &points,
                 const unsigned int p,
                 const unsigned int q,
                 const double       mass_share,
                 const double       volume_share)
    {
      for (const Column &column : points.columns())
        {
          const double share =
            (column.unit == "Pa" ? volume_share : mass_share);
          const bool is_sum = column.inheritance == Inheritance::divided;
          for (unsigned int c = 0; c < column.n_components; ++c)
            {
              double      &value = points.data(column.first, c)[p];
              const double other = points.data(column.first, c)[q];
              value =
                (is_sum ? value + other : share * value + (1. - share) * other);
            }
        }
    }
  } // namespace



  /// Replace point @p p by the union of @p p and @p q, with the cell @p joint.
  /// The splitter measures further stretch from the new edges. Two points of
  /// one generation give a point of the previous generation; otherwise the
  /// smaller point joins the larger. Returns the kinetic energy lost, J.
  template <int dim>
  double
  Merger<dim>::merge_pair(Points<dim>          &points,
                          const BoxRule         rule,
                          const unsigned int    p,
                          const unsigned int    q,
                          const JointCell<dim> &joint)
  {
    conservation_.add(points, p, +1.);
    conservation_.add(points, q, +1.);
    const double loss = kinetic_energy_lost(points, p, q);
    const double id =
      std::min(points.data(points.id)[p], points.data(points.id)[q]);
    const double body = points.data(points.body)[p];
    const double g_p  = points.data(points.generation)[p],
                 g_q  = points.data(points.generation)[q];
    const double V_p  = volume_of_points<dim, double>(points, p),
                 V_q  = volume_of_points<dim, double>(points, q);
    join_columns(points, p, q, joint.mass_share(), V_p / (V_p + V_q));
    points.data(points.id)[p]   = id;
    points.data(points.body)[p] = body;
    points.data(points.generation)[p] =
      (g_p == g_q ? std::max(0., g_p - 1.) : std::min(g_p, g_q));
    const Tensor<2, dim> edges = joint.edges();
    for (unsigned int c = 0; c < dim * dim; ++c)
      points.data(points.edges, c)[p] = edges[c / dim][c % dim];
    begin_stretch(points, p, p + 1, rule);
    conservation_.add(points, p, -1.);
    conservation_.exclude_kinetic_energy(loss);
    return loss;
  }



  template <int dim>
  void
  Merger<dim>::apply(State<dim>           &state,
                     const Splitter<dim>  &splitter,
                     const Materials<dim> &materials)
  {
    sum_volumes(state.points, state.grid, state.nodes);
    n_kept_ = [&](const Segment &segment) -> std::size_t {
      const bool film = is_film(state.grid.cells()[segment.cell], state.nodes);
      if (materials.of_body(segment.body).is_hyperelastic() ||
          (film && dim == 2))
        return state.points.size();
      return film ? n_in_film : 0;
    };
    state.accounts.energy("merging work") +=
      merge(state.points,
            state.grid,
            state.constants.box_shape.rule,
            state.constants.added_mass,
            splitter);
  }



  // Tables have columns for merging only if merging is enabled.
  template <int dim>
  void
  Merger<dim>::list_quantities(const State<dim> &state, Quantities &list) const
  {
    if (!enabled_)
      return;
    const MPI_Comm communicator = state.communicator();
    list.push_back(
      {"merges", "", 1. * Utilities::MPI::sum(n_merges_, communicator)});
    list.push_back({"merge conservation error",
                    "-",
                    Utilities::MPI::max(conservation_error(), communicator)});
  }



  template class Merger<2>;
  template class Merger<3>;
} // namespace talus
