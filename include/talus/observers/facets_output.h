// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_facets_output_h
#define talus_observers_facets_output_h

#include <talus/contact/facet_contact.h>
#include <talus/observers/series_observer.h>

namespace talus
{
  /// The series of files called facets: the parts of the surfaces of obstacles
  /// that had soil in their cells in the step before, each as one cell, with
  /// what the soil did there.
  ///
  /// A facet is drawn as a line (in 3-D a rectangle) in its mean plane, about
  /// its centroid and of its area, so that integrals over the cells are those
  /// over the facets: the integral of the traction is the force on the
  /// obstacle.
  template <int dim>
  class FacetsOutput : public SeriesObserver<dim>
  {
  public:
    /// @p contact must outlive the observer.
    explicit FacetsOutput(const FacetContact<dim> &contact);

    /// Where there are obstacles.
    bool
    is_enabled(const OutputSettings &settings) const override;

    void
    observe(const State<dim> &state) override;

    void
    list_state(StateList &list) override;

  private:
    const FacetContact<dim> &contact_;
  };
} // namespace talus

#endif
