// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/problem/mudline.h>
#include <talus/problem/random_field.h>
#include <talus/problem/strength_field.h>
#include <talus/problem/time_table.h>

#include <map>
#include <optional>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Return the checked table in @p file: an invalid or endless file is found
    /// before a resumed run asks for the checksum.
    TimeTable
    strength_table(const std::filesystem::path &file)
    {
      return {file,
              {"undrained shear strength [Pa]"},
              std::make_pair(std::string("depth"), std::string("m"))};
    }



    /// Strength of a material as a function of place and depth, including the
    /// random field.
    template <int dim>
    class StrengthField
    {
    public:
      StrengthField(const std::string           &path,
                    const UndrainedStrength     &strength,
                    const Constants             &constants,
                    const std::filesystem::path &folder);

      /// Return the strength at @p x, @p depth below the mudline, m; Pa.
      double
      at(const Point<dim> &x, double depth);

    private:
      std::optional<double>            number_;
      std::optional<TimeTable>         table_;
      std::unique_ptr<Expression<dim>> expression_;
      std::optional<RandomField<dim>>  variation_;
    };



    template <int dim>
    StrengthField<dim>::StrengthField(const std::string           &path,
                                      const UndrainedStrength     &strength,
                                      const Constants             &constants,
                                      const std::filesystem::path &folder)
      : number_(strength.number())
    {
      if (const std::string table = strength.table(); !table.empty())
        table_ = strength_table(folder / table);
      else if (!number_)
        expression_ =
          std::make_unique<Expression<dim>>(path,
                                            strength.words(),
                                            1,
                                            constants,
                                            dim == 2 ? "x,y,depth"
                                                     : "x,y,z,depth");
      if (strength.variation().is_active())
        variation_.emplace(strength.variation());
    }



    template <int dim>
    double
    StrengthField<dim>::at(const Point<dim> &x, const double depth)
    {
      const double mean = (number_  ? *number_
                           : table_ ? table_->value(0, depth)
                                    : expression_->finite_value(x, depth, 0));
      return variation_ ? mean * (*variation_)(x) : mean;
    }



    template <int dim>
    void
    check_point(const std::string &path,
                const double       strength,
                const Point<dim>  &x,
                const double       depth)
    {
      AssertThrow(strength > 0.,
                  ExcUser(text(path,
                               " is ",
                               strength,
                               " Pa at (",
                               x,
                               ") m, ",
                               depth,
                               " m below the mudline. Soil needs a positive "
                               "strength: change it.")));
    }



    /// Check softening for a range of strengths, as a law of constant strength
    /// does in check().
    template <int dim>
    void
    check_softening(const std::string        &path,
                    const MaterialModel<dim> &material,
                    const StrengthRange      &range)
    {
      const double largest = material.largest_strength_factor(range);
      AssertThrow(
        largest >= 1.,
        ExcUser(
          text(path,
               " is from ",
               range.least,
               " Pa to ",
               range.largest,
               " Pa, but somewhere the soil would soften faster than "
               "elastic unloading permits: the softening would have to be ",
               1. / largest,
               " times slower. Let the soil soften over more strain",
               material.softens_by_displacement()
                 ? " (a larger displacement, or cells smaller by that factor)"
                 : "",
               ", or increase the stiffness.")));
    }
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
        StrengthField<dim> field(path,
                                 *material.undrained_strength(),
                                 inputs.constants,
                                 inputs.folder);
        for (unsigned int p = 0; p < points.size(); ++p)
          if (points.data(points.body)[p] == b)
            {
              const auto   x = load_place(points, points.initial_position, p);
              const double depth     = mudline.depth(x);
              points.data(column)[p] = field.at(x, depth);
              if (material.has_strength_column())
                check_point(path, points.data(column)[p], x, depth);
            }
        const StrengthRange range =
          materials.strength_range(points, b, communicator);
        if (material.has_strength_column())
          material.check_strength(range);
        check_softening(path, material, range);
      }
  }



  template <int dim>
  std::vector<InputFile>
  tables_of_strength(const Materials<dim>        &materials,
                     const unsigned int           n_bodies,
                     const std::filesystem::path &folder)
  {
    std::map<std::string, InputFile> tables; // by material
    for (unsigned int b = 0; b < n_bodies; ++b)
      if (const auto *strength = materials.of_body(b).undrained_strength())
        if (const std::string table = strength->table(); !table.empty())
          {
            const std::string section = materials.of_body(b).section();
            const std::string name    = section.substr(section.rfind('/') + 1);
            const auto        path    = folder / table;
            tables[name]              = {"strength of " + name,
                                         "table",
                                         path,
                                         strength_table(path).checksum()};
          }
    std::vector<InputFile> result;
    for (const auto &[name, table] : tables)
      result.push_back(table);
    return result;
  }



  template decltype(set_undrained_strength<2>) set_undrained_strength<2>;
  template decltype(set_undrained_strength<3>) set_undrained_strength<3>;
  template decltype(tables_of_strength<2>)     tables_of_strength<2>;
  template decltype(tables_of_strength<3>)     tables_of_strength<3>;
} // namespace talus
