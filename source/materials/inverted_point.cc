// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/inverted_point.h>
#include <talus/points/points_kernel.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  namespace
  {
    /// Return the weight per area, rho g H, Pa, of the soil above point @p p on
    /// this rank: up to the highest point with a box in plan over the point.
    template <int dim>
    double
    weight_above(const Points<dim> &points,
                 const unsigned int p,
                 const double       density)
    {
      double height = 0;
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          bool is_above = true;
          for (unsigned int d = 0; d < dim; ++d)
            if (d != 1)
              is_above &= std::abs(points.data(points.position, d)[q] -
                                   points.data(points.position, d)[p]) <=
                          points.data(points.box_length, d)[q];
          if (is_above)
            height = std::max(height,
                              points.data(points.position, 1)[q] -
                                points.data(points.position, 1)[p]);
        }
      return density * 9.81 * height;
    }



    /// Return sentences with the likely causes, the likeliest first. Soil with
    /// a shear modulus below the weight above would be squeezed to a fraction
    /// of its height, which indicates a wrong unit.
    std::string
    causes_of_inversion(const double shear_modulus, const double weight)
    {
      const std::string shorter_steps =
        "ower 'Time step/CFL number', or find the cause of large velocities "
        "there.";
      const std::string moduli = text("the shear modulus is ",
                                      shear_modulus,
                                      " Pa, the submerged weight of the soil "
                                      "above, per area, ",
                                      weight,
                                      " Pa");
      if (shear_modulus < weight)
        return "The soil is too soft to bear its weight: " + moduli +
               ". Check that stiffnesses are given in Pa, not in kPa. If the "
               "stiffnesses are right, l" +
               shorter_steps;
      return "L" + shorter_steps +
             " If the run still fails, check that stiffnesses are given in "
             "Pa: " +
             moduli + ".";
    }
  } // namespace



  // The loops over points, several at a time, only detect that some determinant
  // is not positive, so that they need no branch. The point is searched here,
  // when the run is lost anyway.
  template <int dim>
  void
  throw_inverted_point(const Points<dim> &points,
                       const unsigned int begin,
                       const unsigned int end,
                       const double       shear_modulus,
                       const double       density)
  {
    for (unsigned int p = begin; p < end; ++p)
      {
        const double J = volume_of_points<dim, double>(points, p) /
                         points.data(points.reference_volume)[p];
        // Written to find values that are not a number, too.
        if (J > 0)
          continue;
        AssertThrow(false,
                    ExcPoint(text(
                      "Point ",
                      points.data(points.id)[p],
                      " at (",
                      load_place(points, points.position, p),
                      ") m was turned inside out: the determinant of its "
                      "deformation gradient is ",
                      J,
                      ", but must be positive. ",
                      causes_of_inversion(shear_modulus,
                                          weight_above(points, p, density)))));
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
                    text("The plastic flow of point ",
                         points.data(points.id)[p],
                         " at (",
                         load_place(points, points.position, p),
                         ") m could not be computed. Find the cause of large "
                         "velocities there, or change the consistency, the "
                         "rate coefficient or the compression lines of the "
                         "material.")));
  }



  template decltype(throw_inverted_point<2>) throw_inverted_point<2>;
  template decltype(throw_inverted_point<3>) throw_inverted_point<3>;
  template decltype(throw_unsolved_point<2>) throw_unsolved_point<2>;
  template decltype(throw_unsolved_point<3>) throw_unsolved_point<3>;
} // namespace talus
