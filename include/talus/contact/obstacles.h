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
  /// The rigid bodies of a case, section Obstacles, which may have none.
  template <int dim>
  class Obstacles : public dealii::ParameterAcceptor
  {
  public:
    /// @p names must be known before the parameters are declared: each
    /// obstacle has a section of its name.
    explicit Obstacles(const std::vector<std::string> &names);

    /// To be called after parsing, see Obstacle::prepare(). Throws ExcUser.
    void
    prepare(const Constants          &constants,
            const SurfaceSource<dim> *surfaces = nullptr);

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

    /// Their shapes, where they are at the start.
    std::vector<const Shape<dim> *>
    shapes() const;

    /// Distance of @p x from the nearest surface, m; negative inside an
    /// obstacle.
    double
    signed_distance(const dealii::Point<dim> &x) const;

    /// Numbers of obstacles, ascending.
    using Numbers = std::vector<unsigned int>;

    /// Return all obstacles whose bounding boxes, where they are now, are not
    /// farther from @p x than @p distance, m, and perhaps some others: by an
    /// index, so that many obstacles cost no more than few.
    Numbers
    near(const dealii::Point<dim> &x, const double distance) const
    {
      return index_.near(x, distance);
    }

    /// Return all obstacles whose bounding boxes are not farther from @p box than
    /// @p distance, m, and perhaps some others.
    Numbers
    near(const Box<dim> &box, const double distance) const
    {
      return index_.near(box, distance);
    }

    /// Distance of @p x from the nearest surface of @p some of the obstacles, m;
    /// the largest number if these are none.
    double
    signed_distance(const dealii::Point<dim> &x, const Numbers &some) const;

    /// Return the number of the obstacle, among @p some, in which @p x lies
    /// deepest, or which is nearest to @p x.
    unsigned int
    nearest(const dealii::Point<dim> &x, const Numbers &some) const;

    /// Whether the shear stress that one of them passes depends on the depth
    /// below the mudline, so that set_depth() must be called.
    bool
    depend_on_depth() const;

    void
    set_depth(const typename ShearStressCap<dim>::Depth &depth);

    /// Whether one of them moves.
    bool
    move() const;

    /// Those that move go on by a step of @p dt from time @p t.
    void
    advance(double t, double dt);

    /// Index the obstacles where they are now. To be called after their places
    /// were restored from a checkpoint; prepare() and advance() do it themselves.
    void
    locate();

    /// Sentences for the log on where obstacles lie.
    std::vector<std::string>
    facts() const;

    /// Sentences for the log on shapes that only stand for what was asked for.
    std::vector<std::string>
    remarks() const;

    /// Whether one of them has a maximum shear stress.
    bool
    limit_shear_stress() const;

    /// Let all surfaces pass @p factor times their maximum shear stress [-].
    void
    scale_maximum_shear_stress(double factor);

    /// Multiply all that resists sliding on the surfaces by @p factor from now
    /// on [-].
    void
    scale_strength(double factor);

    void
    list_state(StateList &list);

  private:
    std::vector<std::string>                    listed_names_;
    std::vector<std::unique_ptr<Obstacle<dim>>> obstacles_;
    BoxIndex<dim>                               index_;
  };
} // namespace talus

#endif
