// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/points/points_kernel.h>
#include <talus/problem/mudline.h>
#include <talus/problem/quantity_in_depth.h>
#include <talus/problem/strength_field.h>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>

#include <cmath>
#include <map>
#include <optional>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // The correlation of a single realization differs from the kernel by about
    // 1/sqrt(n_waves).
    constexpr unsigned int n_waves = 2000;
  } // namespace



  // The spectral density of the Matern correlation of smoothness nu is a
  // multivariate t distribution with 2 nu degrees of freedom: a normal vector
  // over the root of a mean of 2 nu squares of normal numbers
  // (@cite rasmussen2006, eq. 4.15). Boost's distributions, other than those of
  // the standard library, are the same with every compiler.
  template <int dim>
  RandomField<dim>::RandomField(const StrengthVariation &variation)
    : deviation_(std::sqrt(
        std::log1p(variation.coefficient() * variation.coefficient())))
  {
    boost::random::mt19937                     generator(variation.seed());
    boost::random::normal_distribution<double> normal;
    boost::random::uniform_01<double>          uniform;
    const unsigned int                         n = variation.twice_smoothness();
    for (unsigned int w = 0; w < n_waves; ++w)
      {
        Wave   wave;
        double squares = 0.;
        for (unsigned int i = 0; i < n; ++i)
          squares += std::pow(normal(generator), 2);
        for (unsigned int d = 0; d < dim; ++d)
          wave.vector[d] = normal(generator) / std::sqrt(squares / n) /
                           variation.correlation_length(d);
        wave.phase = 2. * numbers::PI * uniform(generator);
        waves_.push_back(wave);
      }
  }



  template <int dim>
  double
  RandomField<dim>::operator()(const Point<dim> &x) const
  {
    double sum = 0.;
    for (const Wave &wave : waves_)
      sum += std::cos(wave.vector * x + wave.phase);
    const double standard_normal = std::sqrt(2. / n_waves) * sum;
    return std::exp(deviation_ * (standard_normal - 0.5 * deviation_));
  }



  template class RandomField<2>;
  template class RandomField<3>;



  namespace
  {
    const std::string column_of_strength = "undrained shear strength [Pa]";



    /// Strength of a material as a function of place, depth and surfaces,
    /// including the random field.
    template <int dim>
    class StrengthField
    {
    public:
      StrengthField(const std::string       &path,
                    const UndrainedStrength &strength,
                    const Inputs<dim>       &inputs,
                    const Mudline<dim>      &mudline)
        : path_(path)
        , mudline_(mudline)
        , field_(path, strength.words(), column_of_strength, inputs, mudline)
      {
        if (strength.variation().is_active())
          variation_.emplace(strength.variation());
      }

      /// Return the strength at @p x, Pa. Throws ExcUser if it is not positive,
      /// unless the user gave the number 0.
      double
      at(const Point<dim> &x) const
      {
        double strength = field_.at(x);
        if (variation_)
          strength *= (*variation_)(x);
        AssertThrow(strength > 0. || (strength == 0. && field_.number()),
                    ExcUser(text(path_,
                                 " is ",
                                 strength,
                                 " Pa at (",
                                 x,
                                 ") m, ",
                                 mudline_.depth(x),
                                 " m below the mudline. Soil needs a positive "
                                 "strength: change it.")));
        return strength;
      }

    private:
      std::string                     path_;
      const Mudline<dim>             &mudline_;
      QuantityInDepth<dim>            field_;
      std::optional<RandomField<dim>> variation_;
    };
  } // namespace



  template <int dim>
  void
  set_undrained_strength(Points<dim>                                   &points,
                         const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                         const Materials<dim> &materials,
                         const Inputs<dim>    &inputs,
                         const Box<dim>       &domain,
                         const MPI_Comm        communicator)
  {
    const unsigned int column = materials.undrained_strength();
    if (column == numbers::invalid_unsigned_int)
      return;
    const Mudline<dim> mudline = mudline_of(bodies, domain);
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const MaterialModel<dim> &material = materials.of_body(b);
        // Elastic soil has no strength, and the column stays 0.
        if (material.undrained_strength() == nullptr)
          continue;
        const std::string path =
          "'" + material.section().substr(1) + "/Undrained shear strength'";
        const StrengthField<dim> field(path,
                                       *material.undrained_strength(),
                                       inputs,
                                       mudline);
        for (unsigned int p = 0; p < points.size(); ++p)
          if (points.data(points.body)[p] == b)
            points.data(column)[p] =
              field.at(load_place(points, points.initial_position, p));
        material.check_strength(
          materials.strength_range(points, b, communicator));
      }
  }



  namespace
  {
    const std::string column_of_ratio = "overconsolidation ratio [-]";



    /// Vertical effective stress of point @p p along @p down, Pa, compression
    /// positive.
    template <int dim>
    double
    vertical_stress(const Points<dim>    &points,
                    const unsigned int    p,
                    const Tensor<1, dim> &down)
    {
      const auto sigma = load_stress<dim, double>(points, p);
      double     sum   = 0.;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          sum -= down[i] * down[j] *
                 sigma[stress_index<dim>(std::min(i, j), std::max(i, j))];
      return sum;
    }



    /// Throw ExcUser if the soil of point @p p has no effective stress, or a
    /// @p ratio of less than 1 at the entry @p path.
    template <int dim>
    void
    check_consolidation(const Points<dim> &points,
                        const unsigned int p,
                        const std::string &body,
                        const std::string &path,
                        const double       ratio,
                        const double       vertical)
    {
      const auto x = load_place(points, points.initial_position, p);
      AssertThrow(vertical > 0. &&
                    mean_normal(load_stress<dim, double>(points, p)) < 0.,
                  ExcUser(text("The soil of the body '",
                               body,
                               "' has no effective stress at (",
                               x,
                               ") m, and modified Cam clay has no stiffness "
                               "without it. Give 'Bodies/",
                               body,
                               "/K0', or less 'Excess pore pressure'.")));
      AssertThrow(ratio >= 1.,
                  ExcUser(text(path,
                               " is ",
                               ratio,
                               " at (",
                               x,
                               ") m, but the largest stress of the past cannot "
                               "be less than that of today. Give 1 or more.")));
    }



    /// Remark on undrained shear strengths from @p least to @p largest, Pa.
    Remark
    note_of_strength(const std::string  &body,
                     const StrengthRange range,
                     const StrengthRange ratio)
    {
      return {text(std::setprecision(4),
                   "the undrained shear strength in plane strain is from ",
                   range.least,
                   " to ",
                   range.largest,
                   " Pa, ",
                   ratio.least,
                   " to ",
                   ratio.largest,
                   " times the vertical effective stress."),
              Severity::information,
              "body '" + body + "'"};
    }
  } // namespace



  template <int dim>
  std::vector<Remark>
  set_preconsolidation(State<dim>                                    &state,
                       const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                       Materials<dim>                                &materials,
                       const Inputs<dim>                             &inputs,
                       const Tensor<1, dim>                          &gravity)
  {
    Points<dim>       &points       = state.points;
    const MPI_Comm     communicator = state.communicator();
    const Mudline<dim> mudline =
      mudline_of(bodies, state.grid.domain_before_growth());
    Tensor<1, dim>      down;
    std::vector<Remark> notes;
    down[1] = 1.;
    if (gravity.norm() > 0.)
      down = gravity / gravity.norm();
    materials.use_initial_pressure(points, communicator);
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const MaterialModel<dim> &material = materials.of_body(b);
        if (material.overconsolidation_ratio() == nullptr)
          continue;
        const std::string path =
          "'" + material.section().substr(1) + "/Overconsolidation ratio'";
        const QuantityInDepth<dim> field(path,
                                         *material.overconsolidation_ratio(),
                                         column_of_ratio,
                                         inputs,
                                         mudline);
        StrengthRange              range, ratios;
        for (unsigned int p = 0; p < points.size(); ++p)
          if (points.data(points.body)[p] == b)
            {
              const auto   x = load_place(points, points.initial_position, p);
              const double ratio    = field.at(x);
              const double vertical = vertical_stress(points, p, down);
              check_consolidation(
                points, p, bodies[b]->name(), path, ratio, vertical);
              const double strength =
                material.consolidate(points, p, vertical, ratio);
              range.include(strength);
              ratios.include(strength / vertical);
            }
        notes.push_back(note_of_strength(bodies[b]->name(),
                                         over_ranks(range, communicator),
                                         over_ranks(ratios, communicator)));
      }
    return notes;
  }



  namespace
  {
    /// Add the table that @p words name, if any, of @p quantity of the
    /// @p material.
    template <int dim>
    void
    add_table(const MaterialModel<dim>         &material,
              const std::string                &quantity,
              const std::string                &column,
              const std::string                &words,
              const std::filesystem::path      &folder,
              std::map<std::string, InputFile> &tables)
    {
      const std::string table = name_of_table(words);
      if (table.empty())
        return;
      const std::string section = material.section();
      const std::string name =
        quantity + " of " + section.substr(section.rfind('/') + 1);
      tables[name] = {name,
                      "table",
                      folder / table,
                      table_in_depth(folder / table, column).checksum()};
    }
  } // namespace



  template <int dim>
  std::vector<InputFile>
  tables_of_strength(const Materials<dim>        &materials,
                     const unsigned int           n_bodies,
                     const std::filesystem::path &folder)
  {
    std::map<std::string, InputFile> tables; // by name
    for (unsigned int b = 0; b < n_bodies; ++b)
      {
        const MaterialModel<dim> &law = materials.of_body(b);
        if (const auto *strength = law.undrained_strength())
          add_table(law,
                    "strength",
                    column_of_strength,
                    strength->words(),
                    folder,
                    tables);
        if (const auto *ratio = law.overconsolidation_ratio())
          add_table(law,
                    "overconsolidation ratio",
                    column_of_ratio,
                    *ratio,
                    folder,
                    tables);
      }
    std::vector<InputFile> result;
    for (const auto &[name, table] : tables)
      result.push_back(table);
    return result;
  }



  template decltype(set_undrained_strength<2>) set_undrained_strength<2>;
  template decltype(set_undrained_strength<3>) set_undrained_strength<3>;
  template decltype(set_preconsolidation<2>)   set_preconsolidation<2>;
  template decltype(set_preconsolidation<3>)   set_preconsolidation<3>;
  template decltype(tables_of_strength<2>)     tables_of_strength<2>;
  template decltype(tables_of_strength<3>)     tables_of_strength<3>;
} // namespace talus
