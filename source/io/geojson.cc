// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/geojson.h>

#include <boost/property_tree/json_parser.hpp>

namespace talus
{
  using namespace dealii;

  namespace
  {
    using Tree = boost::property_tree::ptree;



    /// The member of an object; one without content if it has none. (get_child()
    /// returns its default by reference, which must live on.)
    const Tree &
    member(const Tree &object, const std::string &name)
    {
      static const Tree none;
      return object.get_child(name, none);
    }



    /// Append the polygons, each a list of rings, of a GeoJSON object and of all
    /// in it.
    void
    collect_polygons(const Tree &object, std::vector<Tree> &polygons)
    {
      const std::string type = object.get("type", "");
      if (type == "Polygon")
        polygons.push_back(member(object, "coordinates"));
      else if (type == "MultiPolygon")
        for (const auto &[key, polygon] : member(object, "coordinates"))
          polygons.push_back(polygon);
      else if (type == "Feature")
        collect_polygons(member(object, "geometry"), polygons);
      else
        for (const std::string list : {"features", "geometries"})
          for (const auto &[key, part] : member(object, list))
            collect_polygons(part, polygons);
    }



    /// Corners of a ring.
    MapPolygons::Ring
    corners_of(const Tree &ring)
    {
      MapPolygons::Ring corners;
      for (const auto &[key, position] : ring)
        {
          // Behind the first two there may be a height.
          std::vector<double> numbers;
          for (const auto &[no_key, number] : position)
            numbers.push_back(number.template get_value<double>());
          corners.emplace_back(numbers.at(0), numbers.at(1));
        }
      return corners;
    }



    /// Return the coordinate system that @p file names: WGS 84 without a name.
    std::string
    coordinate_system(const Tree &file)
    {
      const std::string name      = file.get("crs.properties.name", "");
      const auto        ends_with = [&](const std::string &end) {
        return name.size() >= end.size() &&
               name.compare(name.size() - end.size(), end.size(), end) == 0;
      };
      return name.empty() || ends_with("CRS84") || ends_with(":4326") ? wgs_84
                                                                      : name;
    }
  } // namespace



  bool
  is_geojson(const std::filesystem::path &path)
  {
    return path.extension() == ".geojson" || path.extension() == ".json";
  }



  MapPolygons
  read_geojson(const std::filesystem::path &path)
  {
    const std::string file = "The outline '" + path.string() + "' ";
    MapPolygons       result;
    try
      {
        Tree              tree;
        std::vector<Tree> polygons;
        boost::property_tree::read_json(path.string(), tree);
        collect_polygons(tree, polygons);
        for (const Tree &polygon : polygons)
          {
            auto &rings = result.polygons.emplace_back();
            for (const auto &[key, ring] : polygon)
              rings.push_back(corners_of(ring));
          }
        result.coordinate_system = coordinate_system(tree);
      }
    catch (const boost::property_tree::ptree_error &error)
      {
        AssertThrow(false,
                    ExcUser(file + "cannot be read as GeoJSON: " +
                            error.what() + ". Save it anew."));
      }
    catch (const std::out_of_range &)
      {
        AssertThrow(false,
                    ExcUser(file + "has a corner with less than two numbers, "
                                   "where longitude and latitude were "
                                   "expected. Save it anew."));
      }
    return result;
  }
} // namespace talus
