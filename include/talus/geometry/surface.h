// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_surface_h
#define talus_geometry_surface_h

#include <deal.II/base/point.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace talus
{
  /// Surface with one height y at each place of the plan (x in 2-D, x and z in
  /// 3-D): a seabed, a boundary between layers.
  template <int dim>
  class Surface
  {
  public:
    /// Surface with the name given by the user.
    using Named = std::pair<std::string, std::shared_ptr<const Surface<dim>>>;

    struct Value
    {
      double                 height; ///< y, m
      dealii::Tensor<1, dim> slope;  ///< along x (and z); 0 along y [-]
    };

    virtual ~Surface() = default;

    /// Return height and slope at the place of @p x in plan. Throws ExcUser
    /// where the surface is undefined.
    virtual Value
    at(const dealii::Point<dim> &x) const = 0;

    /// Return the height of at(), perhaps at lower cost.
    virtual double
    height(const dealii::Point<dim> &x) const
    {
      return at(x).height;
    }

    /// Return whether the surface is defined at the place of @p x in plan.
    virtual bool
    is_known_at(const dealii::Point<dim> &x) const = 0;

    /// Return an upper bound of the change of the height within @p distance, m,
    /// of @p x in plan, m.
    virtual double
    largest_change(const dealii::Point<dim> &x, double distance) const = 0;
  };



  /// Looks up surfaces by name, and knows the place of the mesh on the map.
  template <int dim>
  class SurfaceSource
  {
  public:
    virtual ~SurfaceSource() = default;

    /// Return the surface for an @p expression in names, x (and z), as "mudline
    /// - 5"; @p path is the parameter, for messages. Throws ExcUser.
    virtual std::shared_ptr<const Surface<dim>>
    surface(const std::string &path, const std::string &expression) const = 0;

    /// Return all surfaces with names, for use in expressions.
    virtual std::vector<typename Surface<dim>::Named>
    named() const
    {
      return {};
    }

    /// Easting, northing and height of the mesh's origin on the map, m.
    virtual const dealii::Point<3> &
    origin() const = 0;

    /// In 2-D, return the corners on the map, easting and northing in m, of the
    /// line along which the rasters are cut; x is the length along the line.
    /// Throws ExcUser, naming the parameter @p path, unless all rasters share
    /// one line.
    virtual std::vector<dealii::Point<2>>
    section(const std::string &path) const = 0;

    /// Return the corners on the map, easting and northing in m, of the line in
    /// @p file, a GIS file in the folder of the parameters. Throws ExcUser,
    /// naming the parameter @p path, if the file cannot be read or has no line.
    virtual std::vector<dealii::Point<2>>
    read_route(const std::string &path, const std::string &file) const = 0;
  };
} // namespace talus

#endif
