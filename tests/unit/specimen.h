// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_tests_unit_specimen_h
#define talus_tests_unit_specimen_h

#include <talus/base/errors.h>
#include <talus/materials/material_model.h>
#include <talus/points/points_kernel.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace talus
{
  // A law and a few points of it, driven by prescribed velocity gradients.

  constexpr double pi  = 3.14159265358979323846;
  constexpr double s_u = 2500.; ///< of the soil of the paper, Pa



  /// For a section of its own: several laws may be alive in one test,
  /// ParameterAcceptor::clear() must not meet living objects, and what is
  /// parsed is written to those that died, too.
  inline std::string
  name_of_new_soil()
  {
    static unsigned int counter = 0;
    return "soil " + std::to_string(counter++);
  }



  /// The law that @p make makes in a section of its own, with "set ..." lines
  /// @p parameters, checked.
  template <int dim, typename Make>
  std::unique_ptr<MaterialModel<dim>>
  make_law_by(const Make &make, const std::string &parameters)
  {
    using dealii::ParameterAcceptor;
    const std::string                   soil = name_of_new_soil();
    std::unique_ptr<MaterialModel<dim>> law  = make("/Materials/" + soil);
    ParameterAcceptor::declare_all_parameters();
    ParameterAcceptor::prm.parse_input_from_string(
      "subsection Materials\nsubsection " + soil + "\n" + parameters +
      "\nend\nend\n");
    ParameterAcceptor::parse_all_parameters();
    law->check();
    if (const auto *strength = law->undrained_strength())
      law->check_strength(
        {strength->number().value_or(s_u), strength->number().value_or(s_u)});
    return law;
  }



  /// The law @p name with "set ..." lines @p parameters, checked.
  template <int dim>
  std::unique_ptr<MaterialModel<dim>>
  make_law(const std::string &name, const std::string &parameters)
  {
    return make_law_by<dim>(
      [&](const std::string &section) {
        return make_material<dim>(name, section);
      },
      parameters);
  }



  template <int dim>
  class Specimen
  {
  public:
    std::unique_ptr<MaterialModel<dim>> law;
    Points<dim>                         points;
    StepWorkspace<dim>                  workspace;

    Specimen(const std::string &name,
             const std::string &parameters,
             const unsigned int n_points = 1)
      : Specimen(make_law<dim>(name, parameters), n_points)
    {}

    explicit Specimen(std::unique_ptr<MaterialModel<dim>> the_law,
                      const unsigned int                  n_points = 1)
      : law(std::move(the_law))
    {
      law->add_columns(points);
      if (law->is_hyperelastic())
        deformation = points.find("deformation gradient");
      points.append(n_points);
      law->initialize(points, 0, n_points);
      workspace.reinit(0, n_points);
      for (unsigned int p = 0; p < n_points; ++p)
        {
          points.data(points.reference_volume)[p] = volume;
          points.data(points.mass)[p]             = law->density() * volume;
          set_F(identity<dim, double>(), p);
        }
    }

    /// The undeformed cell is a box of 0.37 m x 1 m (x 1 m).
    void
    set_F(const Matrix<dim, double> &F, const unsigned int p = 0)
    {
      auto edges = F;
      for (unsigned int i = 0; i < dim; ++i)
        edges[i][0] *= volume;
      store_matrix(points, points.edges, p, edges);
      if (law->is_hyperelastic())
        store_matrix(points, deformation, p, F);
    }

    Matrix<dim, double>
    F(const unsigned int p = 0) const
    {
      if (law->is_hyperelastic())
        return load_matrix<dim, double>(points, deformation, p);
      auto F = load_matrix<dim, double>(points, points.edges, p);
      for (unsigned int i = 0; i < dim; ++i)
        F[i][0] /= volume;
      return F;
    }

    void
    set_increment(const Matrix<dim, double> &H, const unsigned int p = 0)
    {
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          workspace.velocity_gradient(i, j)[p] = H[i][j] / dt;
    }

    /// One step of point @p p with dt L' = @p H.
    void
    step(const Matrix<dim, double> &H, const unsigned int p = 0)
    {
      set_increment(H, p);
      law->update_stress(points, workspace, p, p + 1, dt);
    }

    /// Energy per undeformed volume of a hyperelastic law at @p F; sets the
    /// stress of point 0, too.
    double
    energy_at(const Matrix<dim, double> &F)
    {
      set_F(F);
      law->update_stress(points, workspace, 0, 1, 0.);
      return elastic_energy() / volume;
    }

    Stress<dim, double>
    stress(const unsigned int p = 0) const
    {
      return load_stress<dim, double>(points, p);
    }

    double
    mean_stress(const unsigned int p = 0) const
    {
      const auto sigma = stress(p);
      return (sigma[0] + sigma[1] + sigma[2]) / 3.;
    }

    /// s : s of the deviator s.
    double
    deviator_squared(const unsigned int p = 0) const
    {
      const auto   sigma = stress(p);
      const double m     = mean_stress(p);
      double       sum   = 0.;
      for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
        sum +=
          c < 3 ? (sigma[c] - m) * (sigma[c] - m) : 2. * sigma[c] * sigma[c];
      return sum;
    }

    double
    elastic_energy() const
    {
      return points.data(points.elastic_energy)[0];
    }

    double
    plastic_work() const
    {
      return points.data(points.plastic_work)[0];
    }

    double
    plastic_strain() const
    {
      return points.data(points.find("plastic strain"))[0];
    }

    double
    wave_speed(const unsigned int p = 0) const
    {
      return law->wave_speed(points, p);
    }

    static constexpr double volume = 0.37;
    static constexpr double dt     = 0.01;

  private:
    /// Column of F of a hyperelastic law.
    unsigned int deformation = dealii::numbers::invalid_unsigned_int;
  };



  /// Young's modulus and Poisson's ratio as parameters and as moduli.
  struct Elastic
  {
    double E, nu;
    double mu     = E / (2. * (1. + nu));
    double lambda = E * nu / ((1. + nu) * (1. - 2. * nu));
    double bulk   = lambda + 2. / 3. * mu;

    std::string
    parameters(const std::string &more = "") const
    {
      std::ostringstream out;
      out.precision(17);
      out << "set Young's modulus = " << E << "\nset Poisson's ratio = " << nu
          << "\nset Density = 600\n"
          << more;
      return out.str();
    }

    /// Parameters by which the @p law has the moduli without stress, too.
    std::string
    parameters_of(const std::string &law) const
    {
      return law != "modified Cam clay"
               ? parameters()
               : text(std::setprecision(17),
                      "set Attraction = 1e5\nset Density = 600"
                      "\nset Slope of compression line = ",
                      1e6 / bulk,
                      "\nset Slope of swelling line = ",
                      2e5 / bulk,
                      "\nset Poisson's ratio = ",
                      nu);
    }
  };



  /// dim x dim matrix with entries in [-size, size].
  template <int dim>
  Matrix<dim, double>
  random_matrix(std::mt19937 &random, const double size)
  {
    Matrix<dim, double> A;
    for (auto &row : A.rows)
      for (double &entry : row)
        entry = size * (2. * random() / 4294967295. - 1.);
    return A;
  }



  template <int dim>
  Matrix<dim, double>
  add(Matrix<dim, double> A, const Matrix<dim, double> &B, const double scale)
  {
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        A[i][j] += scale * B[i][j];
    return A;
  }



  template <int dim>
  Matrix<dim, double>
  transpose(const Matrix<dim, double> &A)
  {
    Matrix<dim, double> B;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        B[i][j] = A[j][i];
    return B;
  }



  /// Rotation by @p angle: in 3-D about the axis (1, 2, -2)/3.
  template <int dim>
  Matrix<dim, double>
  rotation(const double angle)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    if constexpr (dim == 2)
      return {{{{{c, -s}}, {{s, c}}}}};
    else
      {
        const double            x = 1. / 3., y = 2. / 3., z = -2. / 3.;
        const Matrix<3, double> K = {
          {{{{0., -z, y}}, {{z, 0., -x}}, {{-y, x, 0.}}}}};
        return add(add(identity<3, double>(), K, s), product(K, K), 1. - c);
      }
  }



  /// R sigma R^T.
  template <int dim>
  Stress<dim, double>
  rotated(const Matrix<dim, double> &R, const Stress<dim, double> &sigma)
  {
    Matrix<dim, double> S;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        S[i][j] = sigma[stress_index<dim>(std::min(i, j), std::max(i, j))];
    S           = product(product(R, S), transpose(R));
    auto result = sigma;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        result[stress_index<dim>(i, j)] = S[i][j];
    return result;
  }



  template <std::size_t n>
  void
  expect_near(const std::array<double, n> &a,
              const std::array<double, n> &b,
              const double                 tolerance)
  {
    for (unsigned int c = 0; c < n; ++c)
      EXPECT_NEAR(a[c], b[c], tolerance) << "component " << c;
  }



  /// The soil of the paper, Pa.
  const Elastic paper{250e3, 0.49};



  /// dt L' whose mid-point strain is exactly diag(g, -g) and whose determinant
  /// is exactly one: pure shear with q = 2 sqrt(3) mu (sum of g) if elastic.
  inline Matrix<2, double>
  pure_shear(const double g)
  {
    return {{{{{g / (1. - g / 2.), 0.}}, {{0., -g / (1. + g / 2.)}}}}};
  }



  template <int dim>
  Matrix<dim, double>
  simple_shear(const double gamma)
  {
    Matrix<dim, double> H{};
    H[0][1] = gamma;
    return H;
  }
} // namespace talus

#endif
