// SPDX-License-Identifier: LGPL-2.1-or-later
// Softening by the displacement across a shear band as wide as the cell of the
// point, against the curve of strength over displacement.

#include <talus/base/errors.h>
#include <talus/materials/materials.h>

#include "specimen.h"

namespace softening_displacement_test
{
  using namespace talus;

  constexpr double d = 0.05, residual = 1500., remaining = 0.3; // m, Pa, -
  const Elastic    soil_of_band{2e6, 0.3};
  const std::vector<std::string> laws = {"von Mises",
                                         "Bingham",
                                         "Herschel-Bulkley"};



  /// Without viscosity.
  std::string
  parameters(const std::string &law, const double displacement = d)
  {
    std::ostringstream out;
    out << "set Undrained shear strength = " << s_u
        << "\nset Softening displacement = " << displacement << '\n';
    if (law == "von Mises")
      out << "set Residual undrained shear strength = " << residual;
    else
      out << "set Remoulded strength ratio = " << remaining << "\nset "
          << (law == "Bingham" ? "Viscosity" : "Consistency") << " = 0";
    return soil_of_band.parameters(out.str());
  }



  /// Strength after the plastic displacement @p u across the band, m; Pa.
  double
  strength_at(const std::string &law, const double u)
  {
    return law == "von Mises"
             ? s_u - (s_u - residual) * std::min(u / d, 1.)
             : s_u * (remaining + (1. - remaining) * std::exp(-3. * u / d));
  }



  template <int dim>
  double *
  column(Specimen<dim> &soil, const std::string &name)
  {
    return soil.points.data(soil.points.find(name));
  }



  template <int dim>
  Specimen<dim>
  specimen(const std::string &law, const double h, const unsigned int n = 1)
  {
    Specimen<dim> soil(law, parameters(law), n);
    std::fill_n(column(soil, "cell size"), n, h);
    return soil;
  }



  /// Shear a point by @p gamma in @p n_steps steps, and hold each state against
  /// the curve. @p u is the plastic displacement across the band, m.
  void
  shear(Specimen<2>       &soil,
        const std::string &law,
        const double       gamma,
        const unsigned int n_steps,
        double            &u)
  {
    const double h = column(soil, "cell size")[0];
    for (unsigned int step = 0; step < n_steps; ++step)
      {
        const double tau_before = std::sqrt(0.5 * soil.deviator_squared());
        soil.step(pure_shear(0.5 * gamma / n_steps));
        const double tau = std::sqrt(0.5 * soil.deviator_squared());
        u += h * (gamma / n_steps - (tau - tau_before) / soil_of_band.mu);
        EXPECT_NEAR(column(soil, "softening")[0], u / d, 1e-11);
        if (u > 1e-9)
          {
            EXPECT_NEAR(tau, strength_at(law, u), 1e-8 * s_u);
          }
        EXPECT_NEAR(soil.law->shear_strength(soil.points, 0),
                    strength_at(law, u),
                    1e-8 * s_u);
      }
  }



  // Elastic soil is in series with the band, so the displacement is that of the
  // plastic flow.
  TEST(SofteningDisplacement, SameCurveOnCellsOfAnySize)
  {
    for (const std::string &law : laws)
      for (const double h : {0.5, 0.25, 0.01})
        for (const unsigned int n_steps : {7, 200})
          {
            SCOPED_TRACE(text(law, ", h = ", h, ", ", n_steps, " steps"));
            auto   soil = specimen<2>(law, h);
            double u    = 0.;
            shear(soil, law, 2. * d / h + s_u / soil_of_band.mu, n_steps, u);
            EXPECT_GT(u, 1.9 * d);
          }
  }



  // A point that enters a larger or smaller cell keeps its strength, and goes
  // on along the same curve.
  TEST(SofteningDisplacement, StrengthDoesNotJumpBetweenCells)
  {
    for (const std::string &law : laws)
      for (const double h : {0.5, 0.125})
        {
          SCOPED_TRACE(text(law, ", to h = ", h));
          auto   soil = specimen<2>(law, 0.25);
          double u    = 0.;
          shear(soil, law, 0.4 * d / 0.25, 20, u);
          EXPECT_GT(u, 0.3 * d);
          const double before = soil.law->shear_strength(soil.points, 0);
          const auto   stress = soil.stress();
          column(soil, "cell size")[0] = h;
          EXPECT_EQ(soil.law->shear_strength(soil.points, 0), before);
          soil.step({});
          expect_near(soil.stress(), stress, 1e-8 * s_u);
          shear(soil, law, 0.4 * d / h, 20, u);
          EXPECT_GT(u, 0.6 * d);
        }
  }



  // Several registers side by side, with cells and strengths of all sizes.
  TEST(SofteningDisplacement, BatchEqualsPointByPoint)
  {
    constexpr unsigned int n = 43;
    for (const std::string &law : laws)
      for (const bool viscous : {false, true})
        {
          const std::string more =
            viscous && law != "von Mises"
              ? std::string("\nset ") +
                  (law == "Bingham" ? "Viscosity" : "Consistency") + " = 100"
              : "";
          Specimen<2>  batch(law, parameters(law) + more, n);
          Specimen<2>  single(law, parameters(law) + more, n);
          std::mt19937 random(7);
          for (unsigned int p = 0; p < n; ++p)
            column(batch, "cell size")[p] = column(single, "cell size")[p] =
              0.5 / (1 + p % 4);
          for (unsigned int step = 0; step < 10; ++step)
            {
              for (unsigned int p = 0; p < n; ++p)
                {
                  const auto H =
                    random_matrix<2>(random, p % 3 == 0 ? 1e-4 : 0.03);
                  batch.set_increment(H, p);
                  single.step(H, p);
                }
              batch.law->update_stress(
                batch.points, batch.workspace, 0, n, batch.dt);
            }
          for (unsigned int p = 0; p < n; ++p)
            {
              expect_near(batch.stress(p),
                          single.stress(p),
                          1e-13 * soil_of_band.bulk);
              EXPECT_NEAR(column(batch, "softening")[p],
                          column(single, "softening")[p],
                          1e-13);
            }
          EXPECT_GT(column(batch, "softening")[1], 0.1);
        }
  }



  // (s_u - s_res) h < G d, and 3 (1 - r) s_u h < G d.
  TEST(SofteningDisplacement, LimitOfStrengthFallsWithTheCellSize)
  {
    for (const std::string &law : laws)
      for (const double h : {0.5, 0.25})
        {
          const auto soil = specimen<2>(law, h);
          soil.law->use_cell_size(h);
          const double lost =
            law == "von Mises" ? s_u - residual : 3. * (1. - remaining) * s_u;
          const double expected = 0.99 * soil_of_band.mu * d / (lost * h);
          EXPECT_NEAR(soil.law->largest_strength_factor({s_u, s_u}),
                      expected,
                      1e-12 * expected);
        }
  }



  TEST(SofteningDisplacement, ChildrenInherit)
  {
    const auto soil = specimen<2>("von Mises", 0.5);
    for (const Column &column : soil.points.columns())
      if (column.name == "softening")
        {
          EXPECT_EQ(column.inheritance, Inheritance::copied);
        }
    EXPECT_NO_THROW(soil.points.find("softening"));
    EXPECT_THROW(Specimen<2>("von Mises", "").points.find("softening"),
                 dealii::ExceptionBase);
  }



  /// What check() says, without line breaks.
  std::string
  sentence(const std::string &law, const std::string &lines)
  {
    std::string line, word;
    try
      {
        make_law<2>(law, lines);
      }
    catch (const ExcUser &error)
      {
        std::istringstream words(error.what());
        while (words >> word)
          line += word + ' ';
      }
    return line;
  }



  TEST(SofteningDisplacement, ContradictionsAreRefused)
  {
    const std::string by_d = "set Softening displacement = 0.05\n";
    const auto expect = [](const std::string &found, const std::string &part) {
      EXPECT_NE(found.find(part), std::string::npos) << found;
    };
    expect(sentence("von Mises", by_d + "set Hardening modulus = -100"),
           "both `Softening displacement` and `Hardening modulus`");
    expect(
      sentence("Bingham",
               by_d + "set Remoulded strength ratio = 0.5\n"
                      "set Plastic shear strain to remould = 2"),
      "both `Softening displacement` and `Plastic shear strain to remould`");
    expect(sentence("Herschel-Bulkley", by_d), "nothing softens");
    expect(sentence("von Mises", "set Residual undrained shear strength = 700"),
           "nothing says over what the material softens");
    EXPECT_EQ(sentence("von Mises", by_d), "");
  }
} // namespace softening_displacement_test
