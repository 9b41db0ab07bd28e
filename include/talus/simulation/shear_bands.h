// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_shear_bands_h
#define talus_simulation_shear_bands_h

#include <talus/observers/table_observer.h>
#include <talus/problem/problem.h>

#include <string>
#include <vector>

namespace talus
{
  /// Table bands.csv: how far the soil of each softening body has yielded, a
  /// row per time of statistics.csv. Only if a body softens.
  template <int dim>
  class ShearBands : public TableObserver<dim>
  {
  public:
    explicit ShearBands(const Problem<dim> &problem)
      : TableObserver<dim>("bands.csv")
      , problem_(problem)
      , length_(problem.bodies().names().size(), 0.)
    {}

    bool
    is_enabled(const OutputSettings &settings) const override;

    void
    observe(const State<dim> &state) override;

    /// List time and extents of the last row, for the rate of growth.
    void
    list_state(StateList &list) override;

  private:
    std::vector<std::string>
    columns(const OutputSettings &settings,
            const State<dim>     &state) const override;

    std::vector<unsigned int>
    softening_bodies() const;

    const Problem<dim> &problem_;
    double              time_ = 0.; ///< time of the last row, s
    std::vector<double> length_;    ///< yielded, by body, m (3-D: m^2)
  };
} // namespace talus

#endif
