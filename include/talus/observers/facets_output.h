// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_facets_output_h
#define talus_observers_facets_output_h

#include <talus/contact/contact.h>
#include <talus/observers/series_observer.h>

namespace talus
{
  /// Series of files "facets": the facets of obstacle surfaces with soil in
  /// their cells in the previous step, one output cell per facet, with the
  /// traction of the soil and further fields.
  ///
  /// A facet is drawn as a line (in 3-D a rectangle) in the mean plane, around
  /// the centroid and with the area of the facet. An integral over the output
  /// cells therefore equals the integral over the facets: the integral of the
  /// traction is the force on the obstacle.
  template <int dim>
  class FacetsOutput : public SeriesObserver<dim>
  {
  public:
    /// @p contact must outlive the observer.
    explicit FacetsOutput(const Contact<dim> &contact)
      : SeriesObserver<dim>("facets")
      , contact_(contact)
    {}

    /// Return whether obstacle output is requested and obstacles exist.
    bool
    is_enabled(const OutputSettings &settings) const override
    {
      return settings.write_obstacles && !contact_.obstacles().empty();
    }

    void
    observe(const State<dim> &state) override;

    void
    list_state(StateList &list) override
    {
      // Without obstacles the checkpoint has no entry for the series.
      if (!contact_.obstacles().empty())
        SeriesObserver<dim>::list_state(list);
    }

  private:
    const Contact<dim> &contact_;
  };
} // namespace talus

#endif
