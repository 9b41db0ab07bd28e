// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/box_index.h>

#include <deal.II/base/bounding_box.h>

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <iterator>
#include <numeric>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Up to this number of boxes a query costs more than testing all.
    constexpr unsigned int few = 4;

    /// Return a finite box: the tree computes means of the ends of boxes.
    template <int dim>
    BoundingBox<dim>
    finite_box(const Box<dim> &box, const double margin)
    {
      constexpr double far = 1e30; // m
      Point<dim>       lower, upper;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = std::clamp(box.lower[d] - margin, -far, far);
          upper[d] = std::clamp(box.upper[d] + margin, -far, far);
        }
      return BoundingBox<dim>({lower, upper});
    }
  } // namespace



  template <int dim>
  struct BoxIndex<dim>::Tree
  {
    RTree<std::pair<BoundingBox<dim>, unsigned int>> boxes;
  };



  template <int dim>
  BoxIndex<dim>::BoxIndex(const std::vector<Box<dim>> &boxes)
    : n_boxes_(boxes.size())
  {
    if (n_boxes_ <= few)
      return;
    std::vector<std::pair<BoundingBox<dim>, unsigned int>> entries;
    for (unsigned int k = 0; k < n_boxes_; ++k)
      entries.emplace_back(finite_box(boxes[k], 0.), k);
    tree_ = std::make_shared<const Tree>(Tree{pack_rtree(entries)});
  }



  template <int dim>
  std::vector<unsigned int>
  BoxIndex<dim>::near(const Box<dim> &box, const double distance) const
  {
    std::vector<unsigned int> numbers;
    if (!tree_)
      {
        numbers.resize(n_boxes_);
        std::iota(numbers.begin(), numbers.end(), 0u);
        return numbers;
      }
    for (auto entry = tree_->boxes.qbegin(
           boost::geometry::index::intersects(finite_box(box, distance)));
         entry != tree_->boxes.qend();
         ++entry)
      numbers.push_back(entry->second);
    std::sort(numbers.begin(), numbers.end());
    return numbers;
  }



  template class BoxIndex<2>;
  template class BoxIndex<3>;
} // namespace talus
