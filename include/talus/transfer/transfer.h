// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_transfer_h
#define talus_transfer_transfer_h

#include <talus/transfer/box_rule.h>
#include <talus/transfer/step_context.h>
#include <talus/transfer/transfer_scheme.h>

#include <deal.II/base/parameter_acceptor.h>

#include <vector>

namespace talus
{
  template <int dim>
  class GroupMemory;



  /// Transfers mass, momentum and forces from the points to the background grid
  /// and the motion of the grid back, with the weights of the generalized
  /// interpolation material point method. @cite bardenhagen2004
  template <int dim>
  class Transfer : public dealii::ParameterAcceptor
  {
  public:
    Transfer();

    /// Set for each body whether the cell averages of B-bar are used.
    void
    use_bbar(const std::vector<bool> &of_body)
    {
      bbar_of_body_.assign(of_body.begin(), of_body.end());
    }

    unsigned int
    n_bodies() const
    {
      return bbar_of_body_.size();
    }

    bool
    uses_bbar(const unsigned int body) const
    {
      return bbar_of_body_[body] != 0;
    }

    // Precondition of all functions below: the workspace belongs to the batch.

    /// First half of the B-bar pair: store for each point the shift
    /// mean(q - u) - q, Pa, with q = tr_dim(sigma)/dim, the excess pore
    /// pressure u, and the mean over the points of the cell, of all bodies that
    /// use B-bar. The shift is -u for other bodies.
    void
    apply_bbar_to_stress(const Points<dim>  &points,
                         StepWorkspace<dim> &workspace,
                         const Batch        &batch) const;

    /// Add mass, momentum, internal and external force and reference volume of
    /// the points of a batch to their nodes. Stores the groups of the points in
    /// @p groups, if given.
    void
    scatter(const StepContext<dim> &context,
            const Batch            &batch,
            GroupMemory<dim>       *groups = nullptr) const;

    /// Update velocity and position of the points of a batch from the motion of
    /// the nodes. The workspace receives the velocity gradients, 1/s, and the
    /// indices of the points that left their cell.
    ///
    /// @param dt time step, s
    /// @param velocity_update update of the velocities in place of scheme()
    /// @param groups groups stored by scatter() for the same points, or null
    /// @return work of the loads, J
    double
    gather(const StepContext<dim> &context,
           const Batch            &batch,
           double                  dt,
           const VelocityUpdate   &velocity_update,
           GroupMemory<dim>       *groups = nullptr) const;

    double
    gather(const StepContext<dim> &context,
           const Batch            &batch,
           const double            dt,
           GroupMemory<dim>       *groups = nullptr) const
    {
      return gather(context, batch, dt, scheme_.velocity_update(), groups);
    }

    /// Second half of the B-bar pair: replace the rate of volume change of each
    /// point by the mean over the cell.
    void
    apply_bbar_to_dilatation(const Points<dim>  &points,
                             StepWorkspace<dim> &workspace,
                             const Batch        &batch) const;

    const TransferScheme &
    scheme() const
    {
      return scheme_;
    }

    const BoxShape &
    box_shape() const
    {
      return box_shape_;
    }

    /// Mass, kg, below which a node does not move; for cells of size
    /// @p cell_size, m, and soil of @p density, kg/m^3.
    double
    mass_cutoff(const double density, const double cell_size) const;

  private:
    /// Whether any body in the batch uses B-bar.
    bool
    uses_bbar(const Points<dim> &points, const Batch &batch) const;

    void
    set_cell_means(const Points<dim> &points,
                   const Batch       &batch,
                   const double      *quantity,
                   const double      *weighted,
                   double            *mean) const;

    template <typename Quantity, typename Add>
    void
    shift_to_cell_means(const Points<dim>  &points,
                        StepWorkspace<dim> &workspace,
                        const Batch        &batch,
                        const Quantity     &quantity,
                        const Add          &add) const;

    template <typename Pressure>
    void
    set_shift(const Points<dim>  &points,
              StepWorkspace<dim> &workspace,
              const Batch        &batch,
              double             *shift,
              const Pressure     &pressure) const;

    /// Declares 'Splitting/Shear', which chooses boxes as well as splits.
    struct Shear : dealii::ParameterAcceptor
    {
      Shear();

      std::string name = "ignored";
    };

    void
    choose_boxes();

    TransferScheme scheme_;
    Shear          shear_;
    std::string    box_rule_     = "axis-parallel";
    double         mass_cut_off_ = 1e-9;
    BoxShape       box_shape_;

    std::vector<unsigned char> bbar_of_body_;
  };
} // namespace talus

#endif
