// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/maps/plan_columns.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Return the fraction of [@p lower, @p upper] inside [@p from, @p to) [-].
    double
    share_of_interval(const double lower,
                      const double upper,
                      const double from,
                      const double to)
    {
      if (!(upper > lower))
        return lower >= from && lower < to ? 1. : 0.;
      return std::max(0., std::min(upper, to) - std::max(lower, from)) /
             (upper - lower);
    }
  } // namespace



  template <int dim>
  unsigned int
  LatticeColumns<dim>::size() const
  {
    unsigned int n = 1;
    for (const Axis &axis : axes_)
      n *= axis.number;
    return n;
  }



  template <int dim>
  double
  LatticeColumns<dim>::area() const
  {
    double area = 1;
    for (const Axis &axis : axes_)
      area *= axis.size;
    return area;
  }



  template <int dim>
  Point<dim>
  LatticeColumns<dim>::centre(unsigned int column) const
  {
    Point<dim> x;
    for (unsigned int a = 0; a < axes_.size(); ++a)
      {
        const Axis &axis = axes_[a];
        x[axis_of_plan<dim>(a)] =
          axis.lower + (column % axis.number + 0.5) * axis.size;
        column /= axis.number;
      }
    return x;
  }



  namespace
  {
    /// Columns along an axis overlapped by a box, and the fraction of the box
    /// in the first, the last, and each intermediate column.
    struct SharesAlongAxis
    {
      int    first = 0, last = 0;
      double in_first = 1, in_last = 1, between = 1;

      double
      operator[](const int i) const
      {
        return i == first ? in_first : i == last ? in_last : between;
      }
    };



    /// Distribute a box over the columns along an axis. All coordinates are in
    /// widths of a column, from the lower face of the first column.
    ///
    /// @param centre of the box
    /// @param half width of the box
    /// @param end number of the last column
    inline SharesAlongAxis
    shares_along_axis(const double centre, const double half, const double end)
    {
      const double    lower = centre - half, upper = centre + half;
      SharesAlongAxis shares;
      // Compared as doubles: the coordinates of a point have no bounds.
      shares.first =
        static_cast<int>(std::max(0., std::min(std::floor(lower), end)));
      shares.last =
        static_cast<int>(std::max(0., std::min(std::floor(upper), end)));
      if (shares.first == shares.last)
        return shares;
      shares.between  = 0.5 / half;
      shares.in_first = (shares.first + 1 - lower) * shares.between;
      shares.in_last  = (upper - shares.last) * shares.between;
      return shares;
    }
  } // namespace



  /// Called for each point in each step. Therefore divisions are needed only
  /// for boxes across a face, and a call handles many points.
  template <int dim>
  void
  LatticeColumns<dim>::find_shares(const Footprints<dim> &footprints,
                                   ColumnShares          &shares) const
  {
    std::array<double, 2> scale = {{1., 1.}}, first = {{0., 0.}};
    for (unsigned int a = 0; a < axes_.size(); ++a)
      {
        scale[a] = 1. / axes_[a].size;
        first[a] = axes_[a].lower;
      }
    const auto along = [&](const unsigned int a, const unsigned int i) {
      return shares_along_axis((footprints.centre[a][i] - first[a]) * scale[a],
                               footprints.half[a][i] * scale[a],
                               axes_[a].number - 1.);
    };
    const unsigned int n_x = axes_[0].number;
    for (unsigned int item = 0; item < footprints.size(); ++item)
      {
        const SharesAlongAxis x = along(0, item);
        const SharesAlongAxis z =
          dim == 3 ? along(dim - 2, item) : SharesAlongAxis();
        for (int k = z.first; k <= z.last; ++k)
          for (int i = x.first; i <= x.last; ++i)
            if (const double share = z[k] * x[i]; share > 0.)
              shares.add(item, k * n_x + i, share);
      }
  }



  template <int dim>
  SquareColumns<dim>::SquareColumns(const std::vector<Point<dim>> &centres,
                                    const double                   width)
    : centres_(centres)
    , width_(width)
    , by_x_(centres.size())
  {
    for (Point<dim> &centre : centres_)
      centre[1] = 0.;
    std::iota(by_x_.begin(), by_x_.end(), 0);
    std::stable_sort(by_x_.begin(),
                     by_x_.end(),
                     [this](const unsigned int a, const unsigned int b) {
                       return centres_[a][0] < centres_[b][0];
                     });
  }



  template <int dim>
  std::vector<unsigned int>::const_iterator
  SquareColumns<dim>::first_behind(const double x) const
  {
    return std::lower_bound(by_x_.begin(),
                            by_x_.end(),
                            x,
                            [this](const unsigned int a, const double x) {
                              return centres_[a][0] < x;
                            });
  }



  template <int dim>
  bool
  SquareColumns<dim>::may_reach(const Box<dim> &box) const
  {
    const double half = 0.5 * width_;
    const auto   it   = first_behind(box.lower[0] - half);
    return it != by_x_.end() && centres_[*it][0] <= box.upper[0] + half;
  }



  template <int dim>
  void
  SquareColumns<dim>::find_shares(const Footprints<dim> &footprints,
                                  ColumnShares          &shares) const
  {
    const double own_half = 0.5 * width_;
    for (unsigned int item = 0; item < footprints.size(); ++item)
      {
        const double x     = footprints.centre[0][item];
        const double reach = footprints.half[0][item] + own_half;
        for (auto it = first_behind(x - reach);
             it != by_x_.end() && centres_[*it][0] <= x + reach;
             ++it)
          {
            double share = 1.;
            for (unsigned int a = 0; a < dim - 1; ++a)
              {
                const double from =
                  centres_[*it][axis_of_plan<dim>(a)] - own_half;
                const double centre = footprints.centre[a][item];
                const double half   = footprints.half[a][item];
                share *= share_of_interval(centre - half,
                                           centre + half,
                                           from,
                                           from + width_);
              }
            if (share > 0.)
              shares.add(item, *it, share);
          }
      }
  }



  template class LatticeColumns<2>;
  template class LatticeColumns<3>;
  template class SquareColumns<2>;
  template class SquareColumns<3>;
} // namespace talus
