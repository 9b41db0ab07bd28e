// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_box_index_h
#define talus_geometry_box_index_h

#include <talus/base/box.h>

#include <memory>
#include <vector>

namespace talus
{
  /// Index of many boxes by place: finds boxes near a place without testing
  /// all. Boxes may be infinite.
  template <int dim>
  class BoxIndex
  {
  public:
    explicit BoxIndex(const std::vector<Box<dim>> &boxes = {});

    /// Return the numbers, ascending, of all boxes within @p distance, m, of
    /// @p box, and possibly of some farther boxes.
    std::vector<unsigned int>
    near(const Box<dim> &box, double distance) const;

    std::vector<unsigned int>
    near(const dealii::Point<dim> &x, const double distance) const
    {
      return near(Box<dim>{x, x}, distance);
    }

  private:
    struct Tree;

    unsigned int                n_boxes_;
    std::shared_ptr<const Tree> tree_; ///< none if there are few boxes
  };
} // namespace talus

#endif
