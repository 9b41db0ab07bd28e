// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_envelope_h
#define talus_maps_envelope_h

#include <talus/base/state.h>
#include <talus/maps/column_sums.h>
#include <talus/maps/impact.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace talus
{
  /// The largest value so far, and when it was reached.
  struct Peak
  {
    double value = 0;
    double time  = std::numeric_limits<double>::quiet_NaN(); ///< s

    void
    add(const double new_value, const double t)
    {
      if (new_value > value || (time != time && new_value == value))
        {
          value = new_value;
          time  = t;
        }
    }
  };



  /// What has happened in a column since the start of the motion.
  struct ColumnHistory
  {
    double thickness          = 0; ///< now, m
    double mass               = 0; ///< now, per area of the plan, kg/m^2
    double thickness_at_start = 0; ///< m
    Peak   most_thickness;         ///< m
    Peak   speed;                  ///< of the depth-mean velocity, m/s
    Peak   momentum_flux;          ///< N/m
    Peak   bed_shear_stress;       ///< Pa
    Peak   impact_pressure;        ///< Pa
    /// When each threshold of thickness was first reached, s; NaN: not yet.
    std::vector<double> arrival;
  };



  /// Largest values and arrival times over all samples, column by column, as
  /// maps of hazard show them. Of the first rank.
  template <int dim>
  class Envelope
  {
  public:
    struct Settings
    {
      /// Thinner soil, m, has no velocity, flux, shear stress or pressure: of
      /// the last drops that fly ahead these would be the largest.
      double              smallest_thickness = 0;
      std::vector<double> arrival_thresholds; ///< of thickness, m
      ImpactFormula       impact;
    };

    Envelope(unsigned int n_columns, const Settings &settings);

    const Settings &
    settings() const
    {
      return settings_;
    }

    /// The motion begins with this soil.
    void
    start(const ColumnSums<dim> &sums);

    /// Add a sample of time @p t, s.
    void
    add(const ColumnSums<dim> &sums, double t);

    /// Columns that soil has reached, by growing number.
    std::vector<unsigned int>
    reached() const;

    const ColumnHistory &
    operator[](const unsigned int column) const
    {
      return histories_[column];
    }

    /// All columns as rows of a checkpoint, and back. Throws ExcUser if
    /// @p rows are not those of such an envelope.
    std::vector<double>
    save() const;
    void
    restore(const std::vector<double> &rows);

    /// Numbers in such a row.
    static constexpr unsigned int
    n_numbers(const unsigned int n_arrival_thresholds)
    {
      return 14 + n_arrival_thresholds;
    }

  private:
    Settings                   settings_;
    std::vector<ColumnHistory> histories_;
    std::vector<unsigned int>  reached_; ///< in the order of their arrival
  };



  /// A number that tells of the history of a column, for maps and tables.
  struct HistoryField
  {
    std::string name, unit;
    std::function<double(const ColumnHistory &)>
      value; ///< NaN: nothing to tell
  };

  /// All of them, but for the impact pressure.
  std::vector<HistoryField>
  history_fields(const std::vector<double> &arrival_thresholds);
} // namespace talus

#endif
