#ifndef talus_boundaries_boundary_work_h
#define talus_boundaries_boundary_work_h

#include <deal.II/base/tensor.h>

namespace talus
{
  /// What the boundaries did to the soil in one step, or in all steps so far.
  template <int dim>
  struct BoundaryWork
  {
    /// Energy that friction took from the soil, J.
    double friction = 0;
    /// Energy that normal contact, walls and tractions took from the soil, J;
    /// negative where they drive it.
    double contact = 0;
    /// Energy that local damping took from the soil, J.
    double damping = 0;
    /// Impulse that the seabed gave to the soil, N s.
    dealii::Tensor<1, dim> seabed_impulse;
    /// Impulse that walls and tractions gave to the soil, N s.
    dealii::Tensor<1, dim> wall_impulse;

    BoundaryWork &
    operator+=(const BoundaryWork &other)
    {
      friction += other.friction;
      contact += other.contact;
      damping += other.damping;
      seabed_impulse += other.seabed_impulse;
      wall_impulse += other.wall_impulse;
      return *this;
    }
  };
} // namespace talus

#endif
