// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_bodies_h
#define talus_problem_bodies_h

#include <talus/problem/body.h>
#include <talus/problem/body_thickness.h>
#include <talus/problem/mudline.h>

#include <deal.II/base/parameter_acceptor.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Bodies of soil at the start of a run, in the order of the column `body` of
  /// the points, with their common surface, the mudline.
  template <int dim>
  class Bodies : public dealii::ParameterAcceptor
  {
  public:
    using List = std::vector<std::unique_ptr<Body<dim>>>;

    /// Declare the parameters: a section for each of @p names.
    explicit Bodies(const std::vector<std::string> &names);

    /// Give the shapes access to the named surfaces. Call before any query of
    /// shapes.
    void
    use_surfaces(const SurfaceSource<dim> &surfaces);

    const List &
    list() const
    {
      return list_;
    }

    unsigned int
    size() const
    {
      return list_.size();
    }

    std::vector<std::string>
    names() const;

    /// Name of the material of each body.
    std::vector<std::string>
    names_of_materials() const;

    /// Boxes around the bodies in a mesh that fills @p domain.
    std::vector<Box<dim>>
    bounding_boxes(const Box<dim> &domain) const;

    /// Return whether points may start outside of the cells of this rank:
    /// bodies are displaced or clipped.
    bool
    may_leave_cells() const;

    /// Set the velocities of @p points to the initial velocities of their
    /// bodies, m/s, at time @p t, s.
    void
    set_velocity(Points<dim>     &points,
                 double           t,
                 const Constants &constants) const;

    /// Return whether initial velocities are given half a step before the
    /// start.
    bool
    have_velocity_of_half_step() const
    {
      return initial_velocity_time_ == "half step";
    }

    /// Determine the mudline in a mesh that fills @p domain. Return the depth
    /// below the mudline, m, as a function of the place; empty if the mudline
    /// was known.
    std::function<double(const dealii::Point<dim> &)>
    find_mudline(const Box<dim> &domain);

    /// Return a function for the height of the mudline, m, in the vertical
    /// through a place; NaN where there is no soil. Empty if bodies are
    /// displaced at the start. Call after find_mudline().
    std::function<double(const dealii::Point<dim> &)>
    mudline() const;

    /// Measure the thickness of the bodies filled with @p points. Return a
    /// remark for each thin body; @p slides as in notes_on_thickness().
    /// Collective.
    std::vector<Remark>
    measure_thickness(const Points<dim> &points,
                      const Grid<dim>   &grid,
                      bool               slides);

    /// Thickness of the bodies; empty before measure_thickness().
    const std::vector<BodyThickness> &
    thickness() const
    {
      return thickness_;
    }

  private:
    bool
    are_displaced() const;

    std::string                         initial_velocity_time_ = "start";
    std::vector<std::string>            listed_names_;
    List                                list_;
    std::shared_ptr<const Mudline<dim>> mudline_;
    std::vector<BodyThickness>          thickness_;
  };
} // namespace talus

#endif
