// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_map_settings_h
#define talus_maps_map_settings_h

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace talus
{
  /// What the user wants of maps, section Maps.
  class MapSettings : public dealii::ParameterAcceptor
  {
  public:
    MapSettings();

    /// Throw ExcUser if soil in a mesh of this @p height [m] cannot be as thick
    /// as asked for, or a threshold stands there twice.
    void
    check(double height) const;

    bool
    is_enabled() const
    {
      return is_enabled_;
    }

    /// Whether rasters are written as GeoTIFF, too.
    bool
    writes_geotiff() const
    {
      return writes_geotiff_;
    }

    /// Name of the surface whose raster gives the cells; may be empty.
    const std::string &
    raster() const
    {
      return raster_;
    }

    /// Of the maps, m; 0: that of the raster or, without one, of the mesh.
    double
    cell_size() const
    {
      return cell_size_;
    }

    /// On a mesh with cells of @p h, m.
    double
    smallest_thickness(const double h) const
    {
      return smallest_thickness_ > 0 ? smallest_thickness_ : 0.1 * h;
    }

    /// Of thickness, m; one at least.
    std::vector<double>
    arrival_thresholds(double h) const;

    unsigned int
    n_arrival_thresholds() const
    {
      return arrival_thresholds(1.).size();
    }

    unsigned int
    steps_between_samples() const
    {
      return steps_between_samples_;
    }

  private:
    bool                is_enabled_     = false;
    bool                writes_geotiff_ = false;
    std::string         raster_         = "";
    double              cell_size_      = 0;
    std::vector<double> arrival_thresholds_;
    double              smallest_thickness_    = 0;
    unsigned int        steps_between_samples_ = 1;
  };
} // namespace talus

#endif
