// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/problem/excess_pore_pressure.h>
#include <talus/problem/quantity_in_depth.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <iomanip>

namespace talus
{
  using namespace dealii;

  namespace
  {
    const std::string column_of_pressure = "excess pore pressure [Pa]";
  } // namespace



  template <int dim>
  ExcessPorePressure<dim>::ExcessPorePressure()
    : ParameterAcceptor("/Excess pore pressure")
  {
    add_parameter(
      "Initial",
      initial_,
      "Pressure of the pore water in excess of still water at the start [Pa], "
      "also in the static stages: a number, an expression in x, y (, z), "
      "depth, the depth below the mudline [m], overburden, the effective "
      "stress across the layers at rest without excess pressure [Pa], and the "
      "names of surfaces (0.5*overburden is a pore pressure ratio r_u of 0.5), "
      "or 'table FILE', a CSV file of the columns depth [m] and " +
        column_of_pressure + ". x, y, z is the initial place. Empty: 0.");
    add_parameter("Final",
                  final_,
                  "Excess pore pressure in the end, given as 'Initial' [Pa]. "
                  "Empty: no change.");
    add_parameter("Stage value",
                  stage_value_,
                  "Pressure in the stage 'strength reduction': 'initial', or "
                  "'final' for the factor of safety after the change. The "
                  "stages 'equilibrium' and 'dynamics' start from 'Initial' in "
                  "any case.",
                  this->prm,
                  Patterns::Selection("initial|final"));
    add_parameter("Start time",
                  ramp_.start_time,
                  "Time at which the pressure begins to change [s].",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Duration",
                  ramp_.duration,
                  "Time over which the pressure changes from 'Initial' to "
                  "'Final', smoothly by half a cosine [s]; 0: at once, in the "
                  "step after the start time.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Bodies",
                  names_of_bodies_,
                  "Names of the bodies whose pore water has the pressure, "
                  "separated by commas; empty: all.");
  }



  template <int dim>
  void
  ExcessPorePressure<dim>::check(const std::vector<std::string> &all_names,
                                 const double                    end_time)
  {
    AssertThrow(exists() || names_of_bodies_.empty(),
                ExcUser("'Excess pore pressure/Bodies' is given, but neither "
                        "'Initial' nor 'Final' there: no soil has an excess "
                        "pressure. Give one of the two or remove the entry."));
    AssertThrow(!final_.empty() ||
                  (ramp_.start_time == 0. && ramp_.duration == 0.),
                ExcUser("'Excess pore pressure/Start time' or 'Duration' is "
                        "given, but 'Final' is empty: the pressure does not "
                        "change. Give 'Final' or remove the times."));
    AssertThrow(!final_.empty() || !is_final_in_stage(),
                ExcUser("'Excess pore pressure/Stage value' is 'final', but "
                        "'Final' is empty: no pressure is known for the stage "
                        "'strength reduction'. Give 'Final', or use "
                        "'initial'."));
    AssertThrow(final_.empty() || ramp_.start_time < end_time,
                ExcUser(text("'Excess pore pressure/Start time' is ",
                             ramp_.start_time,
                             " s, but the run ends at ",
                             end_time,
                             " s, before the pressure changes. Give an earlier "
                             "time or a later 'End time'.")));
    has_pressure_.assign(all_names.size(), names_of_bodies_.empty());
    for (const std::string &name : names_of_bodies_)
      {
        const auto found = std::find(all_names.begin(), all_names.end(), name);
        AssertThrow(found != all_names.end(),
                    ExcUser("'Excess pore pressure/Bodies' lists '" + name +
                            "', but Bodies/Names lists only: " +
                            boost::algorithm::join(all_names, ", ") +
                            ". Correct the name or add the body."));
        has_pressure_[found - all_names.begin()] = true;
      }
  }



  /// A column of the points is kept by checkpoints, ranks and splits.
  template <int dim>
  void
  ExcessPorePressure<dim>::add_columns(Points<dim> &points)
  {
    if (exists())
      points.add_pore_pressure();
    if (!final_.empty())
      change_ = points.add_column("change of excess pore pressure",
                                  "Pa",
                                  1,
                                  Inheritance::copied);
  }



  template <int dim>
  std::vector<InputFile>
  ExcessPorePressure<dim>::tables(const std::filesystem::path &folder) const
  {
    std::vector<InputFile> result;
    for (const auto &[name, words] :
         {std::make_pair("initial", initial_), std::make_pair("final", final_)})
      if (const std::string table = name_of_table(words); !table.empty())
        result.push_back(
          {text(name, " excess pore pressure"),
           "table",
           folder / table,
           table_in_depth(folder / table, column_of_pressure).checksum()});
    return result;
  }



  namespace
  {
    /// Throw ExcUser if @p u, Pa, is more than the soil weighs at any point.
    template <int dim>
    void
    check_weight(const Points<dim>         &points,
                 const std::string         &entry,
                 const std::vector<double> &u,
                 const MPI_Comm             communicator)
    {
      const double *const overburden = points.data(points.overburden());
      unsigned int        at         = 0; // point of the largest ratio
      const auto          ratio      = [&](const unsigned int p) {
        return u[p] / std::max(overburden[p], 1e-300);
      };
      for (unsigned int p = 1; p < u.size(); ++p)
        if (ratio(p) > ratio(at))
          at = p;
      const double of_rank = u.empty() ? 0. : ratio(at);
      const double largest = Utilities::MPI::max(of_rank, communicator);
      if (largest <= 1. + 1e-9 || of_rank < largest)
        return;
      AssertThrow(
        false,
        ExcUser(text(std::setprecision(4),
                     "'Excess pore pressure/",
                     entry,
                     "' is ",
                     u[at],
                     " Pa at (",
                     load_place(points, points.initial_position, at),
                     ") m, more than the weight of the soil above across the "
                     "layers, ",
                     overburden[at],
                     " Pa: the soil would float. The largest ratio is ",
                     largest,
                     ". Give less, for instance 0.9*overburden.")));
    }
  } // namespace



  template <int dim>
  void
  ExcessPorePressure<dim>::set(Points<dim>        &points,
                               const Inputs<dim>  &inputs,
                               const Mudline<dim> &mudline,
                               const MPI_Comm      communicator) const
  {
    const auto values = [&](const std::string &entry,
                            const std::string &words) {
      const QuantityInDepth<dim> field(
        "'Excess pore pressure/" + entry + "'",
        words.empty() ? "0" : words,
        column_of_pressure,
        inputs,
        mudline,
        PlaceExpression<dim>::Variables::space_depth_and_overburden);
      std::vector<double> u(points.size());
      for (unsigned int p = 0; p < points.size(); ++p)
        if (has_pressure_[points.data(points.body)[p]])
          u[p] = field.at(load_place(points, points.initial_position, p),
                          points.data(points.overburden())[p]);
      check_weight(points, entry, u, communicator);
      return u;
    };
    const auto now = values("Initial", initial_);
    std::copy(now.begin(), now.end(), points.data(points.pore_pressure()));
    if (final_.empty())
      return;
    const auto then = values("Final", final_);
    for (unsigned int p = 0; p < points.size(); ++p)
      points.data(change_)[p] = then[p] - now[p];
  }



  template <int dim>
  void
  ExcessPorePressure<dim>::add(Points<dim> &points, const double grown) const
  {
    const double *const change = points.data(change_);
    double *const       u      = points.data(points.pore_pressure());
    for (unsigned int p = 0; p < points.size(); ++p)
      u[p] += grown * change[p];
  }



  template <int dim>
  std::string
  ExcessPorePressure<dim>::note() const
  {
    if (final_.empty())
      return "";
    return text("From t = ",
                ramp_.start_time,
                " s to ",
                ramp_.end_time(),
                " s the excess pore pressure changes to '",
                final_,
                "' Pa; ",
                is_final_in_stage()
                  ? "the stage 'strength reduction' sees this pressure."
                  : "static stages see the initial pressure.");
  }



  template class ExcessPorePressure<2>;
  template class ExcessPorePressure<3>;
} // namespace talus
