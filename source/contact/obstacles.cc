// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/contact/obstacles.h>

#include <algorithm>
#include <limits>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Obstacles<dim>::Obstacles(const std::vector<std::string> &names)
    : ParameterAcceptor("/Obstacles")
  {
    add_parameter("Names",
                  listed_names_,
                  "Names of the rigid bodies that soil cannot enter (seabed, "
                  "pipeline, wall), separated by commas; each body has a "
                  "section with its name. Empty: none.");
    for (const std::string &name : names)
      obstacles_.push_back(std::make_unique<Obstacle<dim>>(name));
  }



  template <int dim>
  void
  Obstacles<dim>::prepare(const Constants          &constants,
                          const SurfaceSource<dim> *surfaces)
  {
    for (const auto &obstacle : obstacles_)
      obstacle->prepare(constants, surfaces);
    bodies_.clear();
    for (unsigned int k = 0; k < obstacles_.size(); ++k)
      if (obstacles_[k]->body().exists())
        bodies_.push_back(k);
    locate();
  }



  template <int dim>
  void
  Obstacles<dim>::prescribe_velocity(
    const std::string                            &name,
    const typename Obstacle<dim>::VelocityOfTime &velocity)
  {
    std::string names;
    for (const auto &obstacle : obstacles_)
      {
        if (obstacle->name() == name)
          {
            obstacle->prescribe_velocity(velocity);
            return;
          }
        names += (names.empty() ? "'" : ", '") + obstacle->name() + "'";
      }
    AssertThrow(false,
                ExcUser("The velocity of an obstacle '" + name +
                        "' is prescribed, but " +
                        (names.empty() ? "there are no obstacles"
                                       : "the obstacles are " + names) +
                        ". Give a name of 'Obstacles/Names'."));
  }



  template <int dim>
  void
  Obstacles<dim>::locate()
  {
    std::vector<Box<dim>> boxes;
    for (const auto &obstacle : obstacles_)
      boxes.push_back(obstacle->bounding_box());
    index_ = BoxIndex<dim>(boxes);
  }



  template <int dim>
  std::vector<std::string>
  Obstacles<dim>::facts() const
  {
    std::vector<std::string> result;
    for (const auto &obstacle : obstacles_)
      if (const std::string fact = obstacle->fact(); !fact.empty())
        result.push_back(fact);
    return result;
  }



  template <int dim>
  std::vector<std::string>
  Obstacles<dim>::remarks() const
  {
    std::vector<std::string> result;
    for (const auto &obstacle : obstacles_)
      result.push_back(obstacle->remark());
    return result;
  }



  template <int dim>
  std::vector<const Shape<dim> *>
  Obstacles<dim>::shapes() const
  {
    std::vector<const Shape<dim> *> result;
    for (const auto &obstacle : obstacles_)
      result.push_back(&obstacle->shape());
    return result;
  }



  template <int dim>
  double
  Obstacles<dim>::signed_distance(const Point<dim> &x) const
  {
    double result = std::numeric_limits<double>::max();
    for (const auto &obstacle : obstacles_)
      result = std::min(result, obstacle->signed_distance(x));
    return result;
  }



  template <int dim>
  double
  Obstacles<dim>::signed_distance(const Point<dim> &x,
                                  const Numbers    &some) const
  {
    double result = std::numeric_limits<double>::max();
    for (const unsigned int k : some)
      result = std::min(result, obstacles_[k]->signed_distance(x));
    return result;
  }



  template <int dim>
  unsigned int
  Obstacles<dim>::nearest(const Point<dim> &x, const Numbers &some) const
  {
    return *std::min_element(some.begin(),
                             some.end(),
                             [&](const unsigned int a, const unsigned int b) {
                               return obstacles_[a]->signed_distance(x) <
                                      obstacles_[b]->signed_distance(x);
                             });
  }



  template <int dim>
  bool
  Obstacles<dim>::move() const
  {
    for (const auto &obstacle : obstacles_)
      if (obstacle->moves())
        return true;
    return false;
  }



  template <int dim>
  void
  Obstacles<dim>::advance(const double t, const double dt)
  {
    for (const auto &obstacle : obstacles_)
      obstacle->advance(t, dt);
    if (move())
      locate();
  }



  template <int dim>
  void
  Obstacles<dim>::advance_bodies(const double dt)
  {
    for (const unsigned int k : bodies_)
      obstacles_[k]->advance_body(dt);
    if (!bodies_.empty())
      locate();
  }



  template <int dim>
  bool
  Obstacles<dim>::change_by_slip() const
  {
    return std::any_of(obstacles_.begin(),
                       obstacles_.end(),
                       [](const auto &obstacle) {
                         return obstacle->bed().changes_by_slip();
                       });
  }



  template <int dim>
  void
  Obstacles<dim>::list_state(StateList &list)
  {
    for (const auto &obstacle : obstacles_)
      obstacle->list_state(list);
  }



  template class Obstacles<2>;
  template class Obstacles<3>;
} // namespace talus
