// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/ground.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Ground<dim>::Ground(const Box<dim> &domain, const Obstacles<dim> *obstacles)
    : domain_(domain)
    , obstacles_(obstacles != nullptr && !obstacles->empty() ? obstacles
                                                             : nullptr)
  {
    if (is_bottom_face())
      return;
    std::vector<Box<dim>> boxes;
    for (unsigned int k = 0; k < obstacles_->size(); ++k)
      if (belongs_to_ground((*obstacles_)[k], domain))
        {
          members_.push_back(k);
          boxes.push_back((*obstacles_)[k].bounding_box());
        }
    index_ = BoxIndex<dim>(boxes);
  }



  // The tolerance keeps a pipe on the bottom of the mesh out of the ground,
  // despite round-off. The bounding box of an oblique pipe gives no answer.
  template <int dim>
  bool
  Ground<dim>::belongs_to_ground(const Obstacle<dim> &obstacle,
                                 const Box<dim>      &domain)
  {
    if (std::isfinite(obstacle.shape().width()))
      return false;
    const Box<dim> box       = obstacle.bounding_box();
    const double   tolerance = 1e-6 * domain.length(1);
    bool           crosses   = true;
    for (unsigned int d = 0; d < dim; ++d)
      if (d != 1)
        crosses = crosses && box.lower[d] <= domain.lower[d] + tolerance &&
                  box.upper[d] >= domain.upper[d] - tolerance;
    return crosses || box.lower[1] < domain.lower[1] - tolerance;
  }



  template <int dim>
  typename Ground<dim>::Members
  Ground<dim>::members_in_column(const Point<dim> &x) const
  {
    Box<dim> column{x, x};
    column.lower[1] = -std::numeric_limits<double>::infinity();
    column.upper[1] = std::numeric_limits<double>::infinity();
    Members members;
    for (const unsigned int i : index_.near(column, 0.))
      members.push_back(members_[i]);
    return members;
  }



  /// Return y of the surface at @p x, m, between @p y_open outside and
  /// @p y_inside inside of @p members, m. Regula falsi: the first step is exact
  /// for a plane. Halving the value at an end that stays (Illinois) prevents
  /// slow convergence.
  template <int dim>
  double
  Ground<dim>::surface_at(const Members    &members,
                          const Point<dim> &x,
                          double            y_open,
                          double            y_inside) const
  {
    const auto distance = [&](const double y) {
      Point<dim> place = x;
      place[1]         = y;
      return obstacles_->signed_distance(place, members);
    };
    const double error  = 1e-12 * domain_.length(1);
    double       open   = distance(y_open);
    double       inside = distance(y_inside);
    for (unsigned int i = 0; i < 100 && std::abs(y_open - y_inside) > error;
         ++i)
      {
        const double y = (open > inside) ? (y_inside * open - y_open * inside) /
                                             (open - inside)
                                         : 0.5 * (y_open + y_inside);
        const double value = distance(y);
        if (std::abs(value) <= error)
          return y;
        if (value > 0)
          {
            y_open = y;
            open   = value;
            inside *= 0.5;
          }
        else
          {
            y_inside = y;
            inside   = value;
            open *= 0.5;
          }
      }
    return y_inside;
  }



  /// Steps as long as the distance cannot pass over a surface, but become small
  /// beside a wall: the minimum is 1e-4 of the height of the mesh.
  template <int dim>
  double
  Ground<dim>::elevation(const Members &members, const Point<dim> &x) const
  {
    const double bottom = domain_.lower[1];
    if (members.empty())
      return bottom;
    const double least = 1e-4 * domain_.length(1);
    double       phi   = obstacles_->signed_distance(x, members);
    const bool   is_up = phi <= 0;
    Point<dim>   place = x;
    for (double y = x[1];;)
      {
        const double step = std::max(std::abs(phi), least);
        const double next = is_up ? y + step : std::max(y - step, bottom);
        place[1]          = next;
        phi               = obstacles_->signed_distance(place, members);
        if (is_up != (phi <= 0))
          return std::max(bottom,
                          is_up ? surface_at(members, x, next, y)
                                : surface_at(members, x, y, next));
        if (is_up && next >= domain_.upper[1])
          return domain_.upper[1];
        // Written so that NaN ends the search, too.
        if (!is_up && !(next > bottom))
          return bottom;
        y = next;
      }
  }



  template <int dim>
  double
  Ground<dim>::elevation(const Point<dim> &x) const
  {
    return elevation(members_in_column(x), x);
  }



  template <int dim>
  bool
  Ground<dim>::encloses(const Point<dim> &x) const
  {
    if (is_bottom_face())
      return x[1] <= domain_.lower[1];
    const Members members = members_in_column(x);
    return std::any_of(members.begin(), members.end(), [&](const auto k) {
      return (*obstacles_)[k].contains(x);
    });
  }



  template <int dim>
  Tensor<1, dim>
  Ground<dim>::layer_normal(const Point<dim> &x) const
  {
    Members members = members_in_column(x);
    while (!members.empty())
      {
        Point<dim> place           = x;
        place[1]                   = elevation(members, x);
        const unsigned int nearest = obstacles_->nearest(place, members);
        if ((*obstacles_)[nearest].signed_distance(place) >
            1e-9 * domain_.length(1))
          break; // the bottom face of the mesh
        const Tensor<1, dim> normal = (*obstacles_)[nearest].normal(place);
        if (normal[1] >= min_vertical)
          return normal;
        members.erase(std::find(members.begin(), members.end(), nearest));
      }
    return Point<dim>::unit_vector(1);
  }



  template class Ground<2>;
  template class Ground<3>;
} // namespace talus
