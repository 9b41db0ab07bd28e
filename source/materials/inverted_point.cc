// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/inverted_point.h>
#include <talus/points/points_kernel.h>

namespace talus
{
  // The loops over points, several at a time, only detect that some determinant
  // is not positive, so that they need no branch. The point is searched here,
  // when the run is lost anyway.
  template <int dim>
  void
  throw_inverted_point(const Points<dim> &points,
                       const unsigned int begin,
                       const unsigned int end)
  {
    for (unsigned int p = begin; p < end; ++p)
      {
        const double J = determinant(
          load_matrix<dim, double>(points, points.deformation_gradient, p));
        // Written to find values that are not a number, too.
        if (J > 0)
          continue;
        AssertThrow(
          false,
          ExcPoint(text("Point ",
                        points.data(points.id)[p],
                        " at (",
                        load_place(points, points.position, p),
                        ") m was turned inside out: the determinant of its "
                        "deformation gradient is ",
                        J,
                        ", but must be positive. Lower 'Time step/CFL number', "
                        "or find the cause of large velocities there.")));
      }
  }



  // The iteration returns NaN if it did not converge, and NaN stays in the
  // plastic variable, by which the point is found here.
  template <int dim>
  void
  throw_unsolved_point(const Points<dim> &points,
                       const unsigned int begin,
                       const unsigned int end,
                       const unsigned int plastic)
  {
    for (unsigned int p = begin; p < end; ++p)
      AssertThrow(points.data(plastic)[p] >= 0.,
                  ExcPoint(
                    text("The viscoplastic flow of point ",
                         points.data(points.id)[p],
                         " at (",
                         load_place(points, points.position, p),
                         ") m could not be computed. Find the cause of large "
                         "velocities there, or change the consistency of the "
                         "material.")));
  }



  template decltype(throw_inverted_point<2>) throw_inverted_point<2>;
  template decltype(throw_inverted_point<3>) throw_inverted_point<3>;
  template decltype(throw_unsolved_point<2>) throw_unsolved_point<2>;
  template decltype(throw_unsolved_point<3>) throw_unsolved_point<3>;
} // namespace talus
