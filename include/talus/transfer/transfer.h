#ifndef talus_transfer_transfer_h
#define talus_transfer_transfer_h

#include <talus/grid/nodal_fields.h>
#include <talus/points/points.h>
#include <talus/points/step_workspace.h>
#include <talus/transfer/box_rule.h>
#include <talus/transfer/loads.h>

#include <deal.II/base/parameter_acceptor.h>

#include <vector>

namespace talus
{
  /// Carries mass, momentum and forces from the points to the background grid
  /// and motion back, with the weights of the generalized interpolation
  /// material point method. @cite bardenhagen2004
  template <int dim>
  class Transfer : public dealii::ParameterAcceptor
  {
  public:
    Transfer();

    /// Throw ExcUser if the parameters contradict each other.
    void
    check() const;

    /// For which bodies the anti-locking mean over cells is on.
    void
    use_cell_mean(const std::vector<bool> &of_body)
    {
      cell_mean_of_body_ = of_body;
    }

    bool
    uses_cell_mean(const unsigned int body) const
    {
      return cell_mean_of_body_[body];
    }

    // The workspace must be that of the points of the batch.

    /// First half of the anti-locking pair: store at each point the difference
    /// between the mean over its cell of q = tr_dim(sigma)/dim and its own q.
    void
    average_mean_stress(const Points<dim>  &points,
                        StepWorkspace<dim> &workspace,
                        const Batch        &batch) const;

    /// Add mass, momentum, internal and external force and reference volume of
    /// the points to their nodes.
    void
    scatter(const Points<dim>        &points,
            const StepWorkspace<dim> &workspace,
            const Batch              &batch,
            const Grid<dim>          &grid,
            const Loads<dim>         &loads,
            NodalFields<dim>         &nodes) const;

    /// Update velocity and position of the points from the motion of the nodes
    /// and put their velocity gradient into the workspace, where those are noted
    /// that left their cell. Returns the work of the loads, J.
    double
    gather(const NodalFields<dim> &nodes,
           const Grid<dim>        &grid,
           const Loads<dim>       &loads,
           Points<dim>            &points,
           StepWorkspace<dim>     &workspace,
           const Batch            &batch,
           double                  dt) const;

    /// Second half of the anti-locking pair: replace the rate of volume change
    /// by its mean over the cell.
    void
    average_dilatation(const Points<dim>  &points,
                       StepWorkspace<dim> &workspace,
                       const Batch        &batch) const;

    const BoxShape &
    box_shape() const
    {
      return box_shape_;
    }

    /// Mass below which a node near cells of this size and soil of this density
    /// carries nothing, kg.
    double
    least_mass(const double density, const double cell_size) const;

  private:
    /// Whether any body in the batch is averaged over its cells.
    bool
    takes_cell_mean(const Points<dim> &points, const Batch &batch) const;

    /// Replace a quantity of the points by the difference between its mean over
    /// the segment, weighted by volume, and itself; by zero where the body is
    /// not averaged.
    void
    subtract_from_mean(const Points<dim> &points,
                       const Batch       &batch,
                       const double      *volume,
                       double            *quantity) const;

    double      flip_fraction_ = 1.;
    std::string box_rule_      = "right stretch";
    double      mass_cut_off_  = 1e-9;
    BoxShape    box_shape_;

    std::vector<bool> cell_mean_of_body_;
  };
} // namespace talus

#endif
