// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_lines_h
#define talus_maps_lines_h

#include <talus/maps/envelope_observer.h>
#include <talus/maps/station_list.h>

namespace talus
{
  /// lines.csv: the largest values over all steps along the user's lines, at
  /// places as far apart as the columns around them are wide, or less.
  template <int dim>
  class Lines : public EnvelopeObserver<dim>
  {
  public:
    Lines(Problem<dim>                           &problem,
          std::shared_ptr<MapSettings>            settings,
          std::shared_ptr<const StationList<dim>> list);

    bool
    is_enabled(const OutputSettings & /*settings*/) const override
    {
      return list_->has_lines();
    }

    void
    check(const State<dim> &state) const override;

    static constexpr const char *file_name = "lines.csv";

  private:
    /// A place on a line.
    struct Place
    {
      std::string        line;
      double             distance; ///< along it, m
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
