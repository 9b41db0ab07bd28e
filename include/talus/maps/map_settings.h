// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_map_settings_h
#define talus_maps_map_settings_h

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace talus
{
  /// Settings of the user in section Maps.
  class MapSettings : public dealii::ParameterAcceptor
  {
  public:
    MapSettings();

    /// Throw ExcUser if a thickness exceeds the @p height of the mesh, m, or if
    /// a threshold is listed twice.
    void
    check(double height) const;

    bool
    is_enabled() const
    {
      return is_enabled_;
    }

    /// Return whether rasters are also written as GeoTIFF.
    bool
    writes_geotiff() const
    {
      return writes_geotiff_;
    }

    /// Name of the surface whose raster defines the cells of the maps; may be
    /// empty.
    const std::string &
    raster() const
    {
      return raster_;
    }

    /// Cell size of the maps, m; 0: cell size of the raster or, without a
    /// raster, of the mesh.
    double
    cell_size() const
    {
      return cell_size_;
    }

    /// Minimum thickness for speed, flux and stress, m, on a mesh with cells of
    /// @p h, m.
    double
    smallest_thickness(const double h) const
    {
      return smallest_thickness_ > 0 ? smallest_thickness_ : 0.1 * h;
    }

    /// Thicknesses for arrival times, m, at least one, on a mesh with cells of
    /// @p h, m.
    std::vector<double>
    arrival_thresholds(double h) const;

    unsigned int
    n_arrival_thresholds() const
    {
      return arrival_thresholds(1.).size();
    }

    /// Motion of the fastest point between two samples, in cells of the maps
    /// [-].
    double
    motion_between_samples() const
    {
      return motion_between_samples_;
    }

  private:
    bool                is_enabled_     = false;
    bool                writes_geotiff_ = false;
    std::string         raster_         = "";
    double              cell_size_      = 0;
    std::vector<double> arrival_thresholds_;
    double              smallest_thickness_     = 0;
    double              motion_between_samples_ = 0.1;
  };
} // namespace talus

#endif
