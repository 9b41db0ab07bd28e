// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_maps_h
#define talus_maps_maps_h

#include <talus/maps/bed_columns.h>
#include <talus/maps/envelope_observer.h>
#include <talus/maps/map_axes.h>
#include <talus/maps/pore_columns.h>

#include <functional>
#include <string>
#include <vector>

namespace talus
{
  /// Maps of maximum values and final state of the slide in plan. In 3-D:
  /// rasters maps/NAME.asc, aligned with the raster of the bathymetry (and
  /// NAME.tif, if requested), and the same fields on the ground as maps.vtu. In
  /// 2-D: the table maps.csv. doc/output.md lists the fields.
  template <int dim>
  class Maps : public EnvelopeObserver<dim>
  {
  public:
    Maps(Problem<dim> &problem, std::shared_ptr<MapSettings> settings)
      : EnvelopeObserver<dim>("maps", problem, std::move(settings))
    {}

    bool
    is_enabled(const OutputSettings & /*settings*/) const override
    {
      return this->settings().is_enabled();
    }

    /// Throw ExcUser if the named raster does not exist, or if the maps have
    /// too many cells.
    void
    check(const State<dim> &state) const override;

    /// Folder of the rasters; empty in 2-D.
    std::string
    subfolder() const override
    {
      return dim == 3 ? folder_name : "";
    }

    static constexpr const char *table_name   = "maps.csv";
    static constexpr const char *surface_name = "maps.vtu";
    static constexpr const char *folder_name  = "maps";

  private:
    std::shared_ptr<const PlanColumns<dim>>
    make_columns(const State<dim> &state) const override
    {
      return std::make_shared<LatticeColumns<dim>>(axes(state));
    }
    void
    prepare_files(const State<dim> &state) override
    {
      bed_.sum(state, this->problem(), this->columns());
      pore_.find(state, this->columns());
    }
    void
    write_files(const State<dim> &state) override;

    /// Quantity of a map by column, written to each kind of file.
    struct MapField
    {
      std::string                                name, unit;
      std::function<double(unsigned int column)> value;
    };
    std::vector<MapField>
    fields() const;

    MapAxes<dim>
    axes(const State<dim> &state) const;
    void
    find_ground(const State<dim> &state);
    double
    elevation(unsigned int column) const;
    std::string
    coordinate_system() const;
    void
    write_table();
    void
    write_raster(const std::filesystem::path &name, const Raster &raster);
    void
    write_rasters();
    void
    write_surface(const State<dim> &state);

    BedColumns<dim>  bed_;
    PoreColumns<dim> pore_;
    MapAxes<dim>     axes_;
    /// Height of the ground at the corners of the columns, m, x fastest.
    std::vector<double> ground_;
  };
} // namespace talus

#endif
