// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_contact_area_remark_h
#define talus_simulation_contact_area_remark_h

#include <talus/base/quantity.h>
#include <talus/boundaries/boundaries.h>
#include <talus/contact/contact.h>
#include <talus/simulation/remark_observer.h>

namespace talus
{
  /// Contact area and footprint for the rows of statistics.csv, and a remark if
  /// soil does not touch the ground below: the contact area differs from the
  /// footprint (see list_contact_area()) by more than a twentieth.
  template <int dim>
  class ContactAreaRemark : public RemarkObserver<dim>
  {
  public:
    ContactAreaRemark(const Boundaries<dim> &boundaries,
                      const Contact<dim>    &contact,
                      Log                   &log)
      : RemarkObserver<dim>("contact area remark", log)
      , boundaries_(boundaries)
      , contact_(contact)
    {}

    /// Append contact area and footprint, and keep both for the remark of the
    /// same row: the sums over all points are made once. Collective.
    void
    list_quantities(const State<dim> &state, Quantities &list);

  private:
    Remark
    remark(const State<dim> &state) const override;

    Quantities             areas_; ///< contact area, footprint; last row
    const Boundaries<dim> &boundaries_;
    const Contact<dim>    &contact_;
  };
} // namespace talus

#endif
