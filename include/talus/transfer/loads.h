// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_loads_h
#define talus_transfer_loads_h

#include <talus/transfer/loads_view.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace talus
{
  /// Forces on the points that do not come from stress, as
  /// accelerations, m/s^2.
  template <int dim>
  struct Loads
  {
    /// Weight per mass, for each body.
    std::vector<dealii::Tensor<1, dim>> acceleration_of_body;

    /// True if acceleration_of_point holds an additional acceleration per
    /// point.
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
