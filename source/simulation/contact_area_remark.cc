// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/base/errors.h>
#include <talus/observers/footprint.h>
#include <talus/simulation/contact_area_remark.h>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  ContactAreaRemark<dim>::list_quantities(const State<dim> &state,
                                          Quantities       &list)
  {
    areas_.clear();
    list_contact_area(state, boundaries_, contact_, areas_);
    list.insert(list.end(), areas_.begin(), areas_.end());
  }



  // The contact area is 0 before the first step of a run, and there is no
  // footprint without ground.
  template <int dim>
  Remark
  ContactAreaRemark<dim>::remark(const State<dim> &state) const
  {
    TalusAssert(areas_.size() == 2, ExcInternalError());
    const Quantity &area = areas_[0], &footprint = areas_[1];
    const double    ratio = area.value / footprint.value;
    if (area.value == 0 || footprint.value == 0 ||
        (ratio >= 0.95 && ratio <= 1.05))
      return "";
    return text(std::setprecision(4),
                "At t = ",
                state.time,
                " s the soil touches ",
                area.value,
                ' ',
                area.unit,
                " of the ",
                footprint.value,
                ' ',
                footprint.unit,
                " of ground below, a ratio of ",
                ratio,
                "; expected 0.95 to 1.05. Either soil is in the air, or "
                "friction acts on a wrong area: look at the fields, and "
                "compare with smaller cells.");
  }



  template class ContactAreaRemark<2>;
  template class ContactAreaRemark<3>;
} // namespace talus
