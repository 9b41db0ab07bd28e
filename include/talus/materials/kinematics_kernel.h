// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_kinematics_kernel_h
#define talus_materials_kinematics_kernel_h

#include <talus/base/series.h>
#include <talus/points/points_kernel.h>

namespace talus
{
  /// Deformation in the neighbourhood of a point during one step.
  template <int dim, typename Number>
  struct Motion
  {
    /// H = dt L': gradient of the displacement of the step with respect to the
    /// position at its start.
    Matrix<dim, Number> increment;
    /// Volume at the start and at the end of the step, m^dim.
    Number volume_before, volume_after;
    /// det(I + H) - 1.
    Number dilatation;
  };



  /// Advance the tensor T in column @p column of point(s) @p p by a step with
  /// the gradient @p increment of the displacement, T <- (I + H) T. Exact for
  /// lines of material in the step: each point moves on a straight line.
  /// Returns the new tensor.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE Matrix<dim, Number>
                      advance_tensor(const PointsView<dim>     &points,
                                     const unsigned int         column,
                                     const unsigned int         p,
                                     const Matrix<dim, Number> &increment)
  {
    const auto before = load_matrix<dim, Number>(points, column, p);
    auto       after  = product(increment, before);
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        after[i][j] += before[i][j];
    store_matrix(points, column, p, after);
    return after;
  }



  /// Advance the edges of point(s) @p p over @p dt seconds with the velocity
  /// gradient L' in the workspace.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE Motion<dim, Number>
                      advance_edges(const PointsView<dim>    &points,
                                    const WorkspaceView<dim> &workspace,
                                    const unsigned int        p,
                                    const double              dt)
  {
    Motion<dim, Number> motion;
    motion.increment = load_velocity_gradient<dim, Number>(workspace, p);
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        motion.increment[i][j] *= dt;
    motion.volume_before = volume_of_points<dim, Number>(points, p);
    motion.volume_after  = determinant(
      advance_tensor<dim>(points, points.edges, p, motion.increment));
    motion.dilatation = determinant_increment(motion.increment);
    return motion;
  }



  /// Half of the rotation of a step. In 2-D a symmetric tensor rotates by twice
  /// the angle of the axes, so the half rotation is stored as cosine and sine
  /// of the full angle.
  template <int dim, typename Number>
  struct HalfRotation
  {
    Matrix<3, Number> r;
  };

  template <typename Number>
  struct HalfRotation<2, Number>
  {
    Number cosine, sine;
  };



  /// Half of the rotation of Hughes and Winget in 2-D,
  /// Q = (I - W/2)^-1 (I + W/2) for the skew part W of @p G; its angle phi has
  /// tan(phi/2) = w/2.
  template <typename Number>
  TALUS_ALWAYS_INLINE HalfRotation<2, Number>
                      half_rotation(const Matrix<2, Number> &G)
  {
    const Number t = 0.25 * (G[1][0] - G[0][1]), scale = 1. / (1. + t * t);
    return {(1. - t * t) * scale, 2. * t * scale};
  }



  /// Half of the rotation of Hughes and Winget in 3-D. With the axial vector w
  /// of W, c = cos(phi/2) and Rodrigues' formula,
  ///   r = I + c W/2 + c^2 W^2 / (4 (1 + c)), Q = r r.
  template <typename Number>
  TALUS_ALWAYS_INLINE HalfRotation<3, Number>
                      half_rotation(const Matrix<3, Number> &G)
  {
    Matrix<3, Number> W;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        W[i][j] = 0.5 * (G[i][j] - G[j][i]);
    const Number w2 = W[0][1] * W[0][1] + W[0][2] * W[0][2] + W[1][2] * W[1][2];
    const Number c2 = 1. / (1. + 0.25 * w2), c = sqrt(c2);
    const Number linear = 0.5 * c, square = 0.25 * c2 / (1. + c);

    HalfRotation<3, Number> half{identity<3, Number>()};
    const auto              W2 = product(W, W);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        half.r[i][j] += linear * W[i][j] + square * W2[i][j];
    return half;
  }



  /// Rotate the symmetric tensor @p A by @p half.
  template <typename Number>
  TALUS_ALWAYS_INLINE Stress<2, Number>
  turn(const HalfRotation<2, Number> &half, const Stress<2, Number> &A)
  {
    const Number m = 0.5 * (A[0] + A[1]), d = 0.5 * (A[0] - A[1]);
    const Number turned_d = half.cosine * d - half.sine * A[3];
    return {
      {m + turned_d, m - turned_d, A[2], half.sine * d + half.cosine * A[3]}};
  }



  template <typename Number>
  TALUS_ALWAYS_INLINE Stress<3, Number>
  turn(const HalfRotation<3, Number> &half, const Stress<3, Number> &A)
  {
    const Matrix<3, Number> S = {
      {{{{A[0], A[3], A[4]}}, {{A[3], A[1], A[5]}}, {{A[4], A[5], A[2]}}}}};
    const auto        rS = product(half.r, S);
    Stress<3, Number> B;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
        B[stress_index<3>(i, j)] = rS[i][0] * half.r[j][0] +
                                   rS[i][1] * half.r[j][1] +
                                   rS[i][2] * half.r[j][2];
    return B;
  }



  /// Strain of one step for the rate laws.
  template <int dim, typename Number>
  struct StrainIncrement
  {
    /// ln det(I + H).
    Number volumetric;
    /// Deviator of sym G, G = H (I + H/2)^-1; shear components are not doubled.
    Stress<dim, Number> deviatoric;
    /// Half of the rotation by skew G.
    HalfRotation<dim, Number> half_rotation;
  };



  /// Displacement of a step seen from mid-step: gradient G with respect to the
  /// position at mid-step, and half of the rotation by skew G.
  template <int dim, typename Number>
  struct MidStep
  {
    Matrix<dim, Number>       G;
    HalfRotation<dim, Number> half_rotation;
  };



  /// Compute G = H (I + H/2)^-1 and half of the rotation. In 2-D
  ///   G = (H + (det H)/2 I)/D, D = det(I + H/2);
  /// with the difference w of the shears, the half rotation of half_rotation(),
  /// t = w/(4 D), shares the division.
  template <typename Number>
  TALUS_ALWAYS_INLINE MidStep<2, Number>
                      mid_step(const Matrix<2, Number> &H)
  {
    const Number det = determinant(H);
    const Number D = 1. + 0.5 * trace(H) + 0.25 * det, D4 = 4. * D;
    const Number w = H[1][0] - H[0][1], square = D4 * D4 + w * w;
    const Number both      = 1. / (D * square);
    const Number inverse_D = both * square, inverse_square = both * D;

    MidStep<2, Number> result;
    result.G[0][0]              = (H[0][0] + 0.5 * det) * inverse_D;
    result.G[0][1]              = H[0][1] * inverse_D;
    result.G[1][0]              = H[1][0] * inverse_D;
    result.G[1][1]              = (H[1][1] + 0.5 * det) * inverse_D;
    result.half_rotation.cosine = (D4 * D4 - w * w) * inverse_square;
    result.half_rotation.sine   = 2. * w * D4 * inverse_square;
    return result;
  }



  template <typename Number>
  TALUS_ALWAYS_INLINE MidStep<3, Number>
                      mid_step(const Matrix<3, Number> &H)
  {
    auto middle = identity<3, Number>();
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        middle[i][j] += 0.5 * H[i][j];
    MidStep<3, Number> result;
    result.G             = product(H, inverse(middle));
    result.half_rotation = half_rotation(result.G);
    return result;
  }



  /// Split the motion of a step into strain and rotation. G, the gradient of
  /// the displacement with respect to the position at mid-step, is free of
  /// strain for rotations of any size @cite hughes1980. The trace of G
  /// approximates ln det(I + H) only to third order and is not used: pressure
  /// and volume would drift apart.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE StrainIncrement<dim, Number>
                      strain_increment(const Motion<dim, Number> &motion)
  {
    const auto                   middle = mid_step(motion.increment);
    const auto                  &G      = middle.G;
    StrainIncrement<dim, Number> strain;
    strain.volumetric = log1p_by_series(motion.dilatation);

    const Number        mean = trace(G) * (1. / 3.);
    Stress<dim, Number> D;
    D[2] = Number(0.);
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        D[stress_index<dim>(i, j)] = 0.5 * (G[i][j] + G[j][i]);
    strain.deviatoric    = add_mean(D, Number(-mean));
    strain.half_rotation = middle.half_rotation;
    return strain;
  }
} // namespace talus

#endif
