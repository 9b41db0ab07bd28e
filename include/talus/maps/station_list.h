// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_station_list_h
#define talus_maps_station_list_h

#include <talus/base/box.h>
#include <talus/maps/impact.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace talus
{
  /// Where the user wants to know what passes, section Stations: places and
  /// lines (the route of a pipeline) with names.
  template <int dim>
  class StationList : public dealii::ParameterAcceptor
  {
  public:
    /// A place, or the corners of a line; y does not count.
    struct Named
    {
      std::string                     name;
      std::vector<dealii::Point<dim>> corners;
    };

    StationList();

    bool
    has_points() const
    {
      return !points_.empty();
    }

    bool
    has_lines() const
    {
      return !lines_.empty();
    }

    /// With @p origin of the mesh on the map. They throw ExcUser if an entry
    /// cannot be understood or lies outside of the mesh, which fills @p domain.
    std::vector<Named>
    points(const Box<dim> &domain, const dealii::Point<3> &origin) const;
    std::vector<Named>
    lines(const Box<dim> &domain, const dealii::Point<3> &origin) const;

    /// Of the square (in 2-D the interval) around a place that counts as being
    /// there, on a mesh with cells of @p h; m.
    double
    width(const double h) const
    {
      return width_ > 0 ? width_ : h;
    }

    const ImpactFormula &
    impact() const
    {
      return impact_;
    }

  private:
    void
    check(const Box<dim> &domain) const;
    std::vector<Named>
    parse(const std::string      &entry,
          const std::string      &value,
          const Box<dim>         &domain,
          const dealii::Point<3> &origin) const;

    std::string   points_      = "";
    std::string   lines_       = "";
    std::string   coordinates_ = "mesh";
    double        width_       = 0;
    ImpactFormula impact_;
  };
} // namespace talus

#endif
