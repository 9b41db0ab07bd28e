// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_tsunami_settings_h
#define talus_maps_tsunami_settings_h

#include <deal.II/base/parameter_acceptor.h>

#include <string>

namespace talus
{
  /// Settings of the user in section Tsunami source.
  class TsunamiSettings : public dealii::ParameterAcceptor
  {
  public:
    TsunamiSettings();

    /// Throw ExcUser if the settings do not fit a run in @p dim dimensions.
    void
    check(unsigned int dim) const;

    bool
    is_enabled() const
    {
      return is_enabled_;
    }

    /// Return whether the source is also written as netCDF.
    bool
    writes_netcdf() const
    {
      return writes_netcdf_;
    }

    /// Return whether the source is on longitude and latitude.
    bool
    is_in_degrees() const
    {
      return coordinates_ == "degrees";
    }

    /// Time between two blocks, s.
    double
    interval() const
    {
      return interval_;
    }

    /// Time of the tsunami run at which the slide starts, s.
    double
    start_time() const
    {
      return start_time_ > 0 ? start_time_ : interval_;
    }

    /// Cell size of the source, m; 0: as the maps.
    double
    cell_size() const
    {
      return cell_size_;
    }

    /// Width of the slide across a 2-D section, m.
    double
    width() const
    {
      return width_;
    }

    /// Depth of the water above the slide, m; 0: not given.
    double
    water_depth() const
    {
      return water_depth_;
    }

  private:
    bool   is_enabled_    = false;
    bool   writes_netcdf_ = false;
    double interval_      = 5;
    double start_time_    = 0;
    double cell_size_     = 0;
    double width_         = 0;
    double water_depth_   = 0;

    std::string coordinates_ = "map";
  };
} // namespace talus

#endif
