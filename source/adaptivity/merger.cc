// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/adaptivity/joint_deformation.h>
#include <talus/adaptivity/merger.h>
#include <talus/base/errors.h>
#include <talus/points/points_kernel.h>
#include <talus/transfer/box_rule.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>
#include <optional>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// What is merged can be stretched by this much before it is split again.
    constexpr double margin = 1.25;

    /// Misfit of boxes that fit exactly.
    constexpr double round_off = 1e-12;
  } // namespace



  template <int dim>
  Merger<dim>::Merger()
    : ParameterAcceptor("/Splitting")
  {
    add_parameter("Merge",
                  enabled_,
                  "Whether points of one body that lie side by side in a cell "
                  "become one point, where soil is compressed or at rest and "
                  "no longer needs them.");
    add_parameter("Merge interval",
                  interval_,
                  "Steps from one search for points to merge to the next [-].",
                  this->prm,
                  Patterns::Integer(1));
    add_parameter("Merge length",
                  length_,
                  "Merged points are at most this many cells long along the "
                  "axis that they lie along [-]; at most 0.8 times 'Minimum "
                  "length', so that soil is not merged and split in turn.",
                  this->prm,
                  Patterns::Double(0., 0.8));
    add_parameter("Merge tolerance",
                  tolerance_,
                  "By how much of their volume the boxes of two points may be "
                  "from making a box together [-]; 0 merges those only that "
                  "fit to round-off.",
                  this->prm,
                  Patterns::Double(0., 0.5));
  }



  template <int dim>
  void
  Merger<dim>::check(const Splitter<dim> &splitter) const
  {
    const double most = splitter.least_split_length() / margin;
    AssertThrow(!enabled_ || length_ <= (1. + 1e-9) * most,
                ExcUser(text("'Splitting/Merge length' is ",
                             length_,
                             " cells, but points longer than 'Splitting/"
                             "Minimum length' = ",
                             splitter.least_split_length(),
                             " cells may be split: soil would be merged and "
                             "split in turn. Give a 'Merge length' of at most ",
                             most,
                             ", or a larger 'Minimum length'.")));
  }



  /// Whether @p joint is nearly a box, side by side along @p axis, and neither
  /// too long nor near a threshold of the splitter, in cells of this size.
  template <int dim>
  bool
  Merger<dim>::fits(const JointBox<dim> &joint,
                    const unsigned int   axis,
                    const double         cell_size,
                    const Splitter<dim> &splitter) const
  {
    if (joint.axis() != axis || joint.misfit() > tolerance_ + round_off ||
        joint.length(axis) > length_ * cell_size)
      return false;
    for (unsigned int d = 0; d < dim; ++d)
      if (splitter.would_split(joint.length(d) / cell_size, margin))
        return false;
    return true;
  }



  // Points in the order of their places, each joined with the best of those
  // behind it until none fits. A row of boxes is so joined from its lower end,
  // whatever round-off says of which two of them fit best: numbers of ranks
  // differ in that.
  /// Of the members of the segment; returns the kinetic energy lost, J.
  template <int dim>
  double
  Merger<dim>::merge_along(const unsigned int   axis,
                           Points<dim>         &points,
                           const BoxRule        rule,
                           const double         cell_size,
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
    for (std::size_t i = 0; i < members_.size();)
      {
        std::size_t                  partner = 0;
        std::optional<JointBox<dim>> best;
        for (std::size_t j = i + 1; j < members_.size(); ++j)
          {
            const JointBox<dim> joint(points, rule, members_[i], members_[j]);
            if ((!best || joint.misfit() < best->misfit()) &&
                fits(joint, axis, cell_size, splitter) &&
                JointDeformation<dim>(points, members_[i], members_[j])
                    .misfit() <= tolerance_ + round_off)
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



  // A cell beside smaller ones is taken for one of them, as its points may
  // enter them in the next step.
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
        const Cell<dim> &cell = grid.cells()[segment.cell];
        const double     size = cell.size * (cell.uniform ? 1. : 0.5);
        members_.clear();
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          members_.push_back(p);
        double of_segment = 0;
        for (unsigned int d = 0; d < dim; ++d)
          of_segment += merge_along(d, points, rule, size, splitter);
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
    Assert(ledger() <= 1e-12, ExcInternalError());
    return loss;
  }



  namespace
  {
    /// Kinetic energy of two points that goes when they get one velocity, J.
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



    /// What is extensive is summed up, the stress is the mean by volume, so that
    /// the nodes feel the same, all else the mean by mass.
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
            (column.first == points.stress ? volume_share : mass_share);
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



  /// Point @p p becomes both. Its box is @p joint, and with the deformation
  /// gradient it has another stretch, from which the splitter counts anew.
  /// Of the splits behind the points one is undone. Returns the kinetic energy
  /// lost, J.
  template <int dim>
  double
  Merger<dim>::merge_pair(Points<dim>         &points,
                          const BoxRule        rule,
                          const unsigned int   p,
                          const unsigned int   q,
                          const JointBox<dim> &joint)
  {
    ledger_.enter(points, p, +1.);
    ledger_.enter(points, q, +1.);
    const double loss = kinetic_energy_lost(points, p, q);
    const double id =
      std::min(points.data(points.id)[p], points.data(points.id)[q]);
    const double body       = points.data(points.body)[p];
    const double generation = std::max(points.data(points.generation)[p],
                                       points.data(points.generation)[q]);

    const JointDeformation<dim> F(points, p, q);
    join_columns(points, p, q, joint.mass_share(), F.volume_share());
    points.data(points.id)[p]         = id;
    points.data(points.body)[p]       = body;
    points.data(points.generation)[p] = std::max(0., generation - 1.);
    store_matrix(points, points.deformation_gradient, p, F.gradient());
    // With fixed boxes it is the mean: nothing else knows it.
    if (rule != BoxRule::fixed)
      initialize_stretch(points, p, p + 1, rule);
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double stretch = points.data(points.stretch, d)[p];
        points.data(points.creation_stretch, d)[p] = stretch;
        points.data(points.reference_length, d)[p] = joint.length(d) / stretch;
      }
    ledger_.enter(points, p, -1.);
    ledger_.book_kinetic_energy(loss);
    return loss;
  }



  namespace
  {
    // A rate law keeps its elastic energy as a column, which merging has summed
    // up. A law whose stress is a function of the deformation gradient stores
    // another energy at the mean of two deformation gradients: a step of zero
    // length computes stress and energy anew.
    /// Return the elastic energy lost in @p batch, J.
    template <int dim>
    double
    restore_hyperelastic(State<dim>           &state,
                         const Materials<dim> &materials,
                         const Batch          &batch)
    {
      double loss = 0;
      materials.for_each_material_range(
        state.points,
        batch,
        [&](const auto &law, const unsigned int begin, const unsigned int end) {
          if (!law.is_hyperelastic())
            return;
          const auto energy = [&]() {
            const double *const of_point =
              state.points.data(state.points.elastic_energy);
            return std::accumulate(of_point + begin, of_point + end, 0.);
          };
          state.workspace.reinit(begin, end);
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              std::fill_n(state.workspace.velocity_gradient(i, j),
                          end - begin,
                          0.);
          const double before = energy();
          law.update_stress(
            state.points, state.workspace, begin, end, /*dt=*/0.);
          loss += before - energy();
        });
      return loss;
    }
  } // namespace



  template <int dim>
  void
  Merger<dim>::apply(State<dim>           &state,
                     const Splitter<dim>  &splitter,
                     const Materials<dim> &materials)
  {
    const unsigned long n_before = n_merges_;
    double             &work     = state.accounts.energy("merging work");
    work += merge(state.points,
                  state.grid,
                  state.constants.box_shape.rule,
                  state.constants.added_mass,
                  splitter);
    if (n_merges_ > n_before)
      state.points.for_each_batch([&](const Batch &batch) {
        work += restore_hyperelastic(state, materials, batch);
      });
  }



  // Without merging there are no such columns, and tables are as they were.
  template <int dim>
  void
  Merger<dim>::list_quantities(const State<dim> &state, Quantities &list) const
  {
    if (!enabled_)
      return;
    const MPI_Comm communicator = state.communicator();
    list.push_back(
      {"merges", "", 1. * Utilities::MPI::sum(n_merges_, communicator)});
    list.push_back(
      {"merge ledger", "-", Utilities::MPI::max(ledger(), communicator)});
  }



  template <int dim>
  void
  Merger<dim>::list_state(StateList &list)
  {
    if (!enabled_)
      return;
    list.add("merges", "-", n_merges_, Reduction::sum);
    ledger_.list_state(list, "merge ledger");
  }



  template class Merger<2>;
  template class Merger<3>;
} // namespace talus
