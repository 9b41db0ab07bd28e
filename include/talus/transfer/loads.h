#ifndef talus_transfer_loads_h
#define talus_transfer_loads_h

#include <talus/base/lanes.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace talus
{
  /// Forces on the points that do not come from stress, as accelerations, m/s^2.
  template <int dim>
  struct Loads
  {
    /// Weight divided by mass, for each body.
    std::vector<dealii::Tensor<1, dim>> acceleration_of_body;

    /// True if acceleration_of_point holds what is to be added for each point.
    bool                                           varies = false;
    std::array<dealii::AlignedVector<double>, dim> acceleration_of_point;

    /// Acceleration of point(s) @p p of this body along axis @p d.
    template <typename Number>
    Number
    acceleration(const unsigned int body,
                 const unsigned int p,
                 const unsigned int d) const
    {
      const auto constant = broadcast<Number>(acceleration_of_body[body][d]);
      return varies ? constant + load<Number>(&acceleration_of_point[d][p])
                    : constant;
    }
  };
} // namespace talus

#endif
