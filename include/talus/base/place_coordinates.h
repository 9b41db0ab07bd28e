// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_place_coordinates_h
#define talus_base_place_coordinates_h

#include <talus/base/box.h>

#include <deal.II/base/point.h>

#include <string>

namespace talus
{
  /// Whether places are given in the axes of the mesh, or on the map.
  enum class PlanCoordinates
  {
    mesh,
    map
  };



  /// Coordinates in which the user gives the places of a section, entry
  /// `Coordinates`: coordinates of the mesh or, in 3-D, of the map: easting,
  /// northing and height in place of x, y, z; easting, northing in place of
  /// x, z; easting, height in place of x, y. The functions return places in the
  /// axes of the mesh, in which y is up and z points to the south.
  class PlaceCoordinates
  {
  public:
    /// @p origin of the mesh on the map: easting, northing, height, m.
    explicit PlaceCoordinates(const PlanCoordinates   coordinates,
                              const dealii::Point<3> &origin = {})
      : coordinates_(coordinates)
      , origin_(origin)
    {}

    /// For a section with the path @p section, from the text of the entry,
    /// "mesh" or "map". Throws ExcUser for the map in 2-D, where a place has
    /// only its x along the section of the map.
    PlaceCoordinates(const std::string      &section,
                     const std::string      &coordinates,
                     int                     dim,
                     const dealii::Point<3> &origin);

    bool
    are_of_map() const
    {
      return coordinates_ == PlanCoordinates::map;
    }

    PlanCoordinates
    kind() const
    {
      return coordinates_;
    }

    /// Return x, z of a place of the plan.
    dealii::Point<2>
    in_plan(const dealii::Point<2> &place) const;

    /// Return x, y of a place of an elevation along x.
    dealii::Point<2>
    in_elevation(const dealii::Point<2> &place) const;

    /// Return x, y (, z) of a place.
    template <int dim>
    dealii::Point<dim>
    in_space(const dealii::Point<dim> &place) const;

    /// Return the components along x, y (, z) of a vector.
    template <int dim>
    dealii::Tensor<1, dim>
    direction(const dealii::Tensor<1, dim> &vector) const;

    /// Return the box between two corners, those with the smallest and the
    /// largest coordinates. It has no positive length along an axis along which
    /// @p upper does not exceed @p lower.
    template <int dim>
    Box<dim>
    box(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper) const;

  private:
    PlanCoordinates  coordinates_;
    dealii::Point<3> origin_;
  };
} // namespace talus

#endif
