// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_state_run_constants_h
#define talus_state_run_constants_h

#include <talus/transfer/box_shape.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace talus
{
  /// Constants of a run, which follow from parameters and initial mesh.
  template <int dim>
  struct RunConstants
  {
    BoxShape box_shape; ///< how the boxes of the points deform
    /// Maximum mass of a node without momentum, kg.
    double mass_cutoff = 0;
    /// Mass of water that moves with the soil divided by the mass of the soil
    /// [-], by body; empty without added mass.
    std::vector<double> added_mass;
    /// Acceleration of gravity at full load, m/s^2.
    dealii::Tensor<1, dim> gravity;
  };
} // namespace talus

#endif
