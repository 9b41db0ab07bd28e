// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_shear_bands_h
#define talus_simulation_shear_bands_h

#include <talus/observers/table_observer.h>
#include <talus/problem/problem.h>
#include <talus/state/state.h>

#include <string>
#include <vector>

namespace talus
{
  /// Extent in plan of a body and of its yielded soil, by columns of cells of
  /// size h: m in 2-D, m^2 in 3-D. A column counts if it holds one such point.
  struct YieldedExtent
  {
    double all      = 0.;
    double yielded  = 0.; ///< with plastic flow
    double residual = 0.; ///< with 95 % of the strength loss
  };

  /// Measure body number @p body. Collective.
  template <int dim>
  YieldedExtent
  yielded_extent(const State<dim>   &state,
                 const Problem<dim> &problem,
                 unsigned int        body);

  /// Return sentences on softening, for a search without balance: how much of
  /// each softening body has yielded in plan, by cells of size h, and over how
  /// much of softening surfaces soil has slipped. Empty if nothing has.
  /// Collective.
  template <int dim>
  std::string
  note_on_softening(const State<dim> &state, const Problem<dim> &problem);



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
