// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_loads_h
#define talus_transfer_loads_h

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace talus
{
  /// The loads on the points of one body, as functions of one point take them.
  template <int dim>
  struct LoadsView
  {
    /// Weight divided by mass, m/s^2.
    std::array<double, dim> weight;
    /// What is added at each point, m/s^2; null if nothing is.
    std::array<const double *, dim> of_point;
  };

  /// Forces on the points that do not come from stress, as accelerations, m/s^2.
  template <int dim>
  struct Loads
  {
    /// Weight divided by mass, for each body.
    std::vector<dealii::Tensor<1, dim>> acceleration_of_body;

    /// True if acceleration_of_point holds what is to be added for each point.
    bool                                           varies = false;
    std::array<dealii::AlignedVector<double>, dim> acceleration_of_point;

    LoadsView<dim>
    view(const unsigned int body) const
    {
      LoadsView<dim> loads;
      for (unsigned int d = 0; d < dim; ++d)
        {
          loads.weight[d] = acceleration_of_body[body][d];
          loads.of_point[d] =
            varies ? acceleration_of_point[d].data() : nullptr;
        }
      return loads;
    }
  };
} // namespace talus

#endif
