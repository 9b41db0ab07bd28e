// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/maps/envelope.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    constexpr double not_yet = std::numeric_limits<double>::quiet_NaN();

    /// Peaks of a history, in the order of the columns of a checkpoint.
    template <typename History>
    auto
    peaks_of(History &history)
    {
      using PeakPointer = decltype(&history.speed);
      return std::array<PeakPointer, 5>{{&history.max_thickness,
                                         &history.speed,
                                         &history.momentum_flux,
                                         &history.bed_shear_stress,
                                         &history.impact_pressure}};
    }
  } // namespace



  template <int dim>
  void
  Envelope<dim>::add(const ColumnSums<dim> &sums, const double t)
  {
    for (const unsigned int column : reached_)
      histories_[column].thickness = histories_[column].mass = 0;
    for (const unsigned int column : sums.with_soil())
      {
        ColumnHistory &history = histories_[column];
        if (std::isnan(history.max_thickness.time))
          {
            reached_.push_back(column);
            history.arrival.assign(settings_.arrival_thresholds.size(),
                                   not_yet);
          }
        history.thickness = sums.thickness(column);
        history.mass      = sums.mass(column);
        history.max_thickness.add(history.thickness, t);
        for (unsigned int i = 0; i < history.arrival.size(); ++i)
          if (std::isnan(history.arrival[i]) &&
              history.thickness >= settings_.arrival_thresholds[i])
            history.arrival[i] = t;
        if (history.thickness < settings_.smallest_thickness)
          continue;
        const double speed = sums.velocity(column).norm();
        history.speed.add(speed, t);
        history.momentum_flux.add(sums.momentum_flux(column), t);
        history.bed_shear_stress.add(sums.bed_shear_stress(column), t);
        history.impact_pressure.add(
          settings_.impact.pressure(sums.density(column),
                                    speed,
                                    sums.strength(column)),
          t);
      }
  }



  template <int dim>
  std::vector<double>
  Envelope<dim>::save() const
  {
    std::vector<double> rows;
    for (const unsigned int column : reached())
      {
        const ColumnHistory &history = histories_[column];
        rows.insert(rows.end(),
                    {double(column),
                     history.thickness,
                     history.mass,
                     history.thickness_at_start});
        for (const Peak *peak : peaks_of(history))
          rows.insert(rows.end(), {peak->value, peak->time});
        rows.insert(rows.end(), history.arrival.begin(), history.arrival.end());
      }
    return rows;
  }



  template <int dim>
  void
  Envelope<dim>::restore(const std::vector<double> &rows)
  {
    const unsigned int n = n_numbers(settings_.arrival_thresholds.size());
    for (std::size_t i = 0; i + n <= rows.size(); i += n)
      {
        const double *number = &rows[i];
        const double  column = *number++;
        AssertThrow(column >= 0 && column < histories_.size(),
                    ExcUser(text("A checkpoint has a maximum for column ",
                                 column,
                                 ", but the map has ",
                                 histories_.size(),
                                 " columns. Remove the checkpoint, so that the "
                                 "previous checkpoint is used.")));
        ColumnHistory &history = histories_[column];
        reached_.push_back(column);
        history.thickness          = *number++;
        history.mass               = *number++;
        history.thickness_at_start = *number++;
        for (Peak *peak : peaks_of(history))
          {
            peak->value = *number++;
            peak->time  = *number++;
          }
        history.arrival.assign(number, &rows[i] + n);
      }
  }



  std::vector<HistoryField>
  history_fields(const std::vector<double> &arrival_thresholds)
  {
    using History                    = ColumnHistory;
    std::vector<HistoryField> fields = {
      {"thickness at start",
       "m",
       [](const History &history) { return history.thickness_at_start; }},
      {"final thickness",
       "m",
       [](const History &history) { return history.thickness; }},
      {"final mass",
       "kg/m^2",
       [](const History &history) { return history.mass; }},
      {"erosion", "m", [](const History &history) {
         return history.thickness_at_start - history.thickness;
       }}};
    const auto add_peak = [&](const std::string &name,
                              const std::string &unit,
                              Peak History::*peak) {
      fields.push_back(
        {"maximum " + name, unit, [peak](const History &history) {
           return (history.*peak).value;
         }});
      fields.push_back(
        {"time of maximum " + name, "s", [peak](const History &history) {
           return (history.*peak).time;
         }});
    };
    add_peak("thickness", "m", &History::max_thickness);
    add_peak("speed", "m/s", &History::speed);
    add_peak("momentum flux", "N/m", &History::momentum_flux);
    add_peak("bed shear", "Pa", &History::bed_shear_stress);
    for (unsigned int i = 0; i < arrival_thresholds.size(); ++i)
      fields.push_back({text("arrival time ", arrival_thresholds[i], " m"),
                        "s",
                        [i](const History &history) {
                          return i < history.arrival.size() ? history.arrival[i]
                                                            : not_yet;
                        }});
    return fields;
  }



  template class Envelope<2>;
  template class Envelope<3>;
} // namespace talus
