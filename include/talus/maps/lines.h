// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_lines_h
#define talus_maps_lines_h

#include <talus/maps/envelope_observer.h>
#include <talus/maps/station_list.h>

namespace talus
{
  /// Table lines.csv: maximum values over all steps along the lines of the
  /// user, at places not further apart than the width of the columns around the
  /// places.
  template <int dim>
  class Lines : public EnvelopeObserver<dim>
  {
  public:
    Lines(Problem<dim>                           &problem,
          std::shared_ptr<MapSettings>            settings,
          std::shared_ptr<const StationList<dim>> list)
      : EnvelopeObserver<dim>("lines", problem, std::move(settings))
      , list_(std::move(list))
    {}

    bool
    is_enabled(const OutputSettings & /*settings*/) const override
    {
      return list_->has_lines();
    }

    void
    check(const State<dim> &state) const override;

    static constexpr const char *file_name = "lines.csv";

  private:
    /// Place on a line.
    struct Place
    {
      std::string        line;
      double             distance; ///< along the line, m
      dealii::Point<dim> x;
    };

    std::vector<Place>
    places(const State<dim> &state) const;

    std::shared_ptr<const PlanColumns<dim>>
    make_columns(const State<dim> &state) const override;

    ImpactFormula
    impact() const override
    {
      return list_->impact();
    }

    void
    write_files(const State<dim> &state) override;

    std::shared_ptr<const StationList<dim>> list_;
  };
} // namespace talus

#endif
