// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_mudline_h
#define talus_problem_mudline_h

#include <talus/problem/body.h>

#include <memory>
#include <optional>
#include <vector>

namespace talus
{
  /// Upper surface of the soil at the start: the first soil met on the way down
  /// from the top of the mesh along y.
  template <int dim>
  class Mudline
  {
  public:
    using Bodies = std::vector<std::unique_ptr<Shape<dim>>>;

    /// @p bodies in a mesh that fills @p domain.
    Mudline(Bodies bodies, const Box<dim> &domain)
      : bodies_(std::move(bodies))
      , domain_(domain)
    {}

    /// Return the depth of @p x, in a body, below the mudline, m, accurate to
    /// 1e-12 of the mesh; 0 without soil from @p x upwards.
    double
    depth(const dealii::Point<dim> &x) const;

    /// Return the height of the mudline in the vertical through @p x, m, with
    /// the accuracy of depth(); NaN if the vertical has no soil in the mesh.
    double
    height(const dealii::Point<dim> &x) const;

  private:
    std::optional<double>
    highest_soil(const dealii::Point<dim> &x, double bottom) const;
    bool
    is_soil(const dealii::Point<dim> &x) const;
    double
    clear_height(const dealii::Point<dim> &x, double radius) const;

    Bodies   bodies_;
    Box<dim> domain_;
  };



  /// Return the mudline of @p bodies in a mesh that fills @p domain.
  template <int dim>
  Mudline<dim>
  mudline_of(const std::vector<std::unique_ptr<Body<dim>>> &bodies,
             const Box<dim>                                &domain);
} // namespace talus

#endif
