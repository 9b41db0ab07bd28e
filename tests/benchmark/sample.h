// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_tests_benchmark_sample_h
#define talus_tests_benchmark_sample_h

#include <talus/materials/material_model.h>
#include <talus/points/step_workspace.h>
#include <talus/transfer/box_rule.h>

#include <memory>
#include <string>

namespace talus
{
  /// Points of one law in simple shear, few enough for the second-level cache.
  /// They can be sheared for ever: volumes stay, and the stress of plastic laws
  /// does, too. One at a time: deal.II's parameters are global.
  template <int dim>
  struct Sample
  {
    static constexpr unsigned int n_points = 512;

    std::unique_ptr<MaterialModel<dim>> law;
    Points<dim>                         points;
    StepWorkspace<dim>                  workspace;
    double                              dt = 1e-3; ///< s

    explicit Sample(const std::string &name)
    {
      using dealii::ParameterAcceptor;
      ParameterAcceptor::clear();
      ParameterAcceptor::prm.clear();
      law = make_material<dim>(name, "/Materials/soil");
      ParameterAcceptor::declare_all_parameters();
      ParameterAcceptor::parse_all_parameters();
      law->check();
      law->add_columns(points);
      points.append(n_points);
      workspace.reinit(0, n_points);
      for (unsigned int p = 0; p < n_points; ++p)
        set_point(p);
      law->initialize(points, 0, n_points);
      begin_stretch(points, 0, n_points, BoxRule::second_moments);
    }

    ~Sample()
    {
      law.reset();
      dealii::ParameterAcceptor::clear();
      dealii::ParameterAcceptor::prm.clear();
    }

  private:
    void
    set_point(const unsigned int p)
    {
      points.data(points.mass)[p]             = law->density();
      points.data(points.reference_volume)[p] = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        {
          points.data(points.edges, d * (dim + 1))[p] = 1.;
          for (unsigned int e = 0; e < dim; ++e)
            workspace.velocity_gradient(d, e)[p] = 0.;
        }
      workspace.velocity_gradient(0, 1)[p] = 0.1 * (1. + p % 7); // 1/s
    }
  };
} // namespace talus

#endif
