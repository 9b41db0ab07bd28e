#ifndef talus_transfer_loads_h
#define talus_transfer_loads_h

#include <deal.II/base/tensor.h>

#include <vector>

namespace talus
{
  /// Forces on the points that do not come from stress, as accelerations, m/s^2.
  template <int dim>
  struct Loads
  {
    /// Weight divided by mass, for each body.
    std::vector<dealii::Tensor<1, dim>> acceleration_of_body;

    /// True if the points' column body_acceleration() holds what is to be added
    /// for each point.
    bool varies = false;
  };
} // namespace talus

#endif
