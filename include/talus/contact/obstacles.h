// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_obstacles_h
#define talus_contact_obstacles_h

#include <talus/contact/obstacle.h>
#include <talus/geometry/box_index.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// All rigid bodies of a case, section Obstacles; may be empty.
  template <int dim>
  class Obstacles : public dealii::ParameterAcceptor
  {
  public:
    /// @p names must be known before the parameters are declared: each obstacle
    /// has a section of its name.
    explicit Obstacles(const std::vector<std::string> &names);

    /// Prepare all obstacles, see Obstacle::prepare(). Call after parsing.
    /// Throws ExcUser.
    void
    prepare(const Constants          &constants,
            const SurfaceSource<dim> *surfaces = nullptr);

    /// Let a function prescribe the velocity of the obstacle @p name, see
    /// Obstacle::prescribe_velocity(). Call before prepare(). Throws ExcUser
    /// without an obstacle of this name.
    void
    prescribe_velocity(const std::string                            &name,
                       const typename Obstacle<dim>::VelocityOfTime &velocity);

    unsigned int
    size() const
    {
      return obstacles_.size();
    }

    bool
    empty() const
    {
      return obstacles_.empty();
    }

    const Obstacle<dim> &
    operator[](const unsigned int k) const
    {
      return *obstacles_[k];
    }

    Obstacle<dim> &
    operator[](const unsigned int k)
    {
      return *obstacles_[k];
    }

    /// Shapes of all obstacles, at the start of the run.
    std::vector<const Shape<dim> *>
    shapes() const;

    /// Distance of @p x from the nearest surface, m; negative inside an
    /// obstacle.
    double
    signed_distance(const dealii::Point<dim> &x) const;

    /// Numbers of obstacles, ascending.
    using Numbers = std::vector<unsigned int>;

    /// Return all obstacles whose bounding boxes, at their present positions,
    /// are not farther from @p x than @p distance, m; more may be included. A
    /// spatial index makes the cost independent of the number of obstacles.
    Numbers
    near(const dealii::Point<dim> &x, const double distance) const
    {
      return index_.near(x, distance);
    }

    /// Return all obstacles near @p box, as near() above does for a place.
    Numbers
    near(const Box<dim> &box, const double distance) const
    {
      return index_.near(box, distance);
    }

    /// Distance of @p x from the nearest surface of the obstacles @p some, m;
    /// negative inside; the largest number if @p some is empty.
    double
    signed_distance(const dealii::Point<dim> &x, const Numbers &some) const;

    /// Return the number of the obstacle, among @p some, with the smallest
    /// signed distance from @p x. @p some must not be empty.
    unsigned int
    nearest(const dealii::Point<dim> &x, const Numbers &some) const;

    /// Whether any obstacle moves.
    bool
    move() const;

    /// Numbers of the obstacles with a mass, which move by forces; known after
    /// prepare().
    const Numbers &
    bodies() const
    {
      return bodies_;
    }

    /// Advance obstacles with a prescribed velocity from time @p t, s, by a
    /// step @p dt, s.
    void
    advance(double t, double dt);

    /// Advance the obstacles with a mass by a step @p dt, s.
    void
    advance_bodies(double dt);

    /// Index the obstacles at their present positions. Call after positions
    /// were restored from a checkpoint; prepare() and the functions that
    /// advance call locate() themselves.
    void
    locate();

    /// Return sentences for the log on the positions of obstacles.
    std::vector<std::string>
    facts() const;

    /// Return sentences for the log on shapes that are substitutes.
    std::vector<std::string>
    remarks() const;

    /// Whether slip takes a part of a maximum shear stress away.
    bool
    change_by_slip() const;

    void
    list_state(StateList &list);

  private:
    std::vector<std::string>                    listed_names_;
    std::vector<std::unique_ptr<Obstacle<dim>>> obstacles_;
    Numbers                                     bodies_;
    BoxIndex<dim>                               index_;
  };
} // namespace talus

#endif
