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
  /// Named places and lines (the route of a pipeline) of the user, for which
  /// passing soil is recorded; section Stations.
  template <int dim>
  class StationList : public dealii::ParameterAcceptor
  {
  public:
    /// Place, or corners of a line, m; y is ignored.
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

    /// Parse the places and the lines. Throw ExcUser if an entry is invalid or
    /// outside of the mesh.
    ///
    /// @param domain of the mesh
    /// @param origin of the mesh on the map, m
    std::vector<Named>
    points(const Box<dim> &domain, const dealii::Point<3> &origin) const;
    std::vector<Named>
    lines(const Box<dim> &domain, const dealii::Point<3> &origin) const;

    /// Side of the square (in 2-D length of the interval) around a place, m, on
    /// a mesh with cells of @p h, m.
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
