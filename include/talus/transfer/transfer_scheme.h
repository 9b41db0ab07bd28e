// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_transfer_scheme_h
#define talus_transfer_transfer_scheme_h

#include <talus/transfer/velocity_update_kernel.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>

namespace talus
{
  /// Choice of the update of the points' velocities from the grid: FLIP, PIC, a
  /// mean of both, or FLIP with velocities filtered at a fixed interval.
  class TransferScheme : public dealii::ParameterAcceptor
  {
  public:
    TransferScheme();

    /// Update of the velocities of the points in each step.
    VelocityUpdate
    velocity_update() const
    {
      return {flip_fraction_};
    }

    /// Return whether the velocities are filtered at the beginning of the step
    /// after @p step steps; see filter_null_space().
    bool
    filters(const unsigned long step) const
    {
      return is_filtered() && step > 0 && step % filter_interval_ == 0;
    }

    bool
    is_filtered() const
    {
      return name_ == "filtered FLIP";
    }

    /// Number of passes to the grid and back in a filtering [-].
    unsigned int
    filter_order() const
    {
      return filter_order_;
    }

  private:
    std::string  name_            = "FLIP";
    double       flip_fraction_   = 1.;
    unsigned int filter_interval_ = 100;
    unsigned int filter_order_    = 4;
  };
} // namespace talus

#endif
