// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_envelope_h
#define talus_maps_envelope_h

#include <talus/base/state_list.h>
#include <talus/maps/column_sums.h>
#include <talus/maps/impact.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace talus
{
  /// Maximum value so far, and the time of the maximum.
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



  /// History of a column since the start of the motion.
  struct ColumnHistory
  {
    double thickness          = 0; ///< current, m
    double mass               = 0; ///< current, per plan area, kg/m^2
    double thickness_at_start = 0; ///< m
    Peak   max_thickness;          ///< m
    Peak   speed;                  ///< depth-mean speed, m/s
    Peak   momentum_flux;          ///< N/m
    Peak   bed_shear_stress;       ///< Pa
    Peak   impact_pressure;        ///< Pa
    /// Time of first reaching each threshold of thickness, s; NaN: not yet.
    std::vector<double> arrival;
  };



  /// Maximum values and arrival times over all samples, by column, as in hazard
  /// maps. Used on the first rank only.
  template <int dim>
  class Envelope
  {
  public:
    struct Settings
    {
      /// Below this thickness of soil, m, velocity, flux, shear stress and
      /// pressure do not count: thin soil flying ahead would give the
      /// largest values.
      double              smallest_thickness = 0;
      std::vector<double> arrival_thresholds; ///< thickness, m
      ImpactFormula       impact;
    };

    Envelope(const unsigned int n_columns, const Settings &settings)
      : settings_(settings)
      , histories_(n_columns)
    {}

    const Settings &
    settings() const
    {
      return settings_;
    }

    /// Record the thickness at the start of the motion.
    void
    start(const ColumnSums<dim> &sums)
    {
      for (const unsigned int column : sums.with_soil())
        histories_[column].thickness_at_start = sums.thickness(column);
    }

    /// Add a sample at time @p t, s.
    void
    add(const ColumnSums<dim> &sums, double t);

    /// Columns reached by soil, sorted by number.
    std::vector<unsigned int>
    reached() const
    {
      std::vector<unsigned int> columns = reached_;
      std::sort(columns.begin(), columns.end());
      return columns;
    }

    const ColumnHistory &
    operator[](const unsigned int column) const
    {
      return histories_[column];
    }

    /// Convert all reached columns to rows of a checkpoint, and restore them.
    /// restore() throws ExcUser if @p rows do not fit the number of columns.
    std::vector<double>
    save() const;
    void
    restore(const std::vector<double> &rows);

    /// Number of values per row of a checkpoint.
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



  /// Quantity derived from the history of a column, for maps and tables.
  struct HistoryField
  {
    std::string                                  name, unit;
    std::function<double(const ColumnHistory &)> value; ///< NaN: undefined
  };

  /// Return all fields except the impact pressure.
  std::vector<HistoryField>
  history_fields(const std::vector<double> &arrival_thresholds);
} // namespace talus

#endif
