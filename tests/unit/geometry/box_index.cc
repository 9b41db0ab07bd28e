// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/box_index.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace box_index_test
{
  using namespace talus;
  using dealii::Point;

  constexpr double infinite = std::numeric_limits<double>::infinity();

  /// Whether two boxes are at most @p distance apart along each axis.
  template <int dim>
  bool
  are_near(const Box<dim> &a, const Box<dim> &b, const double distance)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (a.lower[d] - b.upper[d] > distance ||
          b.lower[d] - a.upper[d] > distance)
        return false;
    return true;
  }



  template <int dim>
  std::vector<Box<dim>>
  random_boxes(const unsigned int n)
  {
    std::mt19937                           random(n);
    std::uniform_real_distribution<double> place(0., 100.), length(0., 3.);
    std::vector<Box<dim>>                  boxes(n);
    for (Box<dim> &box : boxes)
      for (unsigned int d = 0; d < dim; ++d)
        {
          box.lower[d] = place(random);
          box.upper[d] = box.lower[d] + length(random);
        }
    return boxes;
  }



  template <int dim>
  void
  expect_all_that_are_near(std::vector<Box<dim>> boxes)
  {
    boxes[3].lower[1]       = -infinite; // a pile without end
    boxes[7].lower[0]       = -infinite; // a wall or a bed
    boxes[7].lower[dim - 1] = -infinite;
    boxes[7].upper[0] = boxes[7].upper[dim - 1] = infinite;
    const BoxIndex<dim> index(boxes);
    for (const Box<dim> &box : random_boxes<dim>(50))
      for (const double distance : {0., 2., infinite})
        {
          std::vector<unsigned int> expected;
          for (unsigned int k = 0; k < boxes.size(); ++k)
            if (are_near(boxes[k], box, distance))
              expected.push_back(k);
          EXPECT_EQ(index.near(box, distance), expected);
        }
  }



  TEST(BoxIndexTest, FindsAllThatAreNear)
  {
    expect_all_that_are_near<2>(random_boxes<2>(300));
    expect_all_that_are_near<3>(random_boxes<3>(300));
  }



  /// Few boxes are not searched, and all are returned.
  TEST(BoxIndexTest, FewBoxes)
  {
    EXPECT_TRUE(BoxIndex<2>().near(Point<2>(), infinite).empty());
    const BoxIndex<2> index(random_boxes<2>(2));
    EXPECT_EQ(index.near(Point<2>(-50., 0.), 1.),
              (std::vector<unsigned int>{0, 1}));
  }
} // namespace box_index_test
