// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_strength_field_h
#define talus_problem_strength_field_h

#include <talus/io/input_file.h>
#include <talus/materials/materials.h>
#include <talus/materials/strength_variation.h>
#include <talus/problem/body.h>
#include <talus/problem/inputs.h>
#include <talus/state/state.h>

#include <deal.II/base/point.h>

#include <filesystem>
#include <memory>
#include <vector>

namespace talus
{
  /// A realization of a lognormal random field of mean 1: a function of the
  /// place, independent of mesh, ranks and the order of evaluation. The
  /// logarithm is a sum of cosines with random wave vectors and phases
  /// (spectral representation, @cite shinozuka1991).
  template <int dim>
  class RandomField
  {
  public:
    explicit RandomField(const StrengthVariation &variation);

    /// Return the value at @p x, m [-].
    double
    operator()(const dealii::Point<dim> &x) const;

  private:
    struct Wave
    {
      dealii::Tensor<1, dim> vector; ///< 1/m
      double                 phase;  ///< rad
    };

    double            deviation_; ///< standard deviation of the logarithm [-]
    std::vector<Wave> waves_;
  };



  /// Set the column `undrained shear strength` of all points, if there is one:
  /// by the number, the expression of place, depth and surfaces, or the table
  /// of the material of each body, times the random field of the material.
  /// Throws ExcUser if the strength of a point is not positive (the number 0 is
  /// allowed), or softening is too fast for the stiffness. Collective.
  /// @param inputs constants, surfaces, and the folder of the tables
  /// @param domain domain of the mesh
  template <int dim>
  void
  set_undrained_strength(Points<dim>                                   &points,
                         const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                         const Materials<dim> &materials,
                         const Inputs<dim>    &inputs,
                         const Box<dim>       &domain,
                         MPI_Comm              communicator);



  /// Set the preconsolidation pressure of the points of laws that have one from
  /// the effective stress at the start: along @p gravity, m/s^2, it was the
  /// overconsolidation ratio times as large. Returns the range of undrained
  /// shear strengths that follows. Throws ExcUser if soil has no effective
  /// stress, or the ratio is less than 1. Collective.
  template <int dim>
  std::vector<Remark>
  set_preconsolidation(State<dim>                                    &state,
                       const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                       Materials<dim>                                &materials,
                       const Inputs<dim>                             &inputs,
                       const dealii::Tensor<1, dim>                  &gravity);



  /// Return the tables in @p folder for the strengths and the overconsolidation
  /// ratios of the materials of @p n_bodies bodies, each table once.
  template <int dim>
  std::vector<InputFile>
  tables_of_strength(const Materials<dim>        &materials,
                     unsigned int                 n_bodies,
                     const std::filesystem::path &folder);
} // namespace talus

#endif
