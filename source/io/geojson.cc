// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/geojson.h>
#include <talus/io/text_file.h>

#include <boost/property_tree/json_parser.hpp>

#include <sstream>

namespace talus
{
  using namespace dealii;

  namespace
  {
    using Tree = boost::property_tree::ptree;



    /// Return the member of an object; empty if there is none. (get_child()
    /// returns the default by reference, which must live on.)
    const Tree &
    member(const Tree &object, const std::string &name)
    {
      static const Tree none;
      return object.get_child(name, none);
    }



    /// Append the coordinates of all geometries of type @p kind or "Multi" +
    /// @p kind in a GeoJSON object and its members.
    void
    collect(const std::string &kind,
            const Tree        &object,
            std::vector<Tree> &found)
    {
      const std::string type = object.get("type", "");
      if (type == kind)
        found.push_back(member(object, "coordinates"));
      else if (type == "Multi" + kind)
        for (const auto &[key, part] : member(object, "coordinates"))
          found.push_back(part);
      else if (type == "Feature")
        collect(kind, member(object, "geometry"), found);
      else
        for (const std::string list : {"features", "geometries"})
          for (const auto &[key, part] : member(object, list))
            collect(kind, part, found);
    }



    /// Corners of a ring or a line.
    MapFeatures::Corners
    corners_of(const Tree &positions)
    {
      MapFeatures::Corners corners;
      for (const auto &[key, position] : positions)
        {
          // A height may follow the first two numbers.
          std::vector<double> numbers;
          for (const auto &[no_key, number] : position)
            numbers.push_back(number.template get_value<double>());
          corners.emplace_back(numbers.at(0), numbers.at(1));
        }
      return corners;
    }



    /// Return the coordinate system named in @p file; WGS 84 by default.
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



  MapFeatures
  read_geojson(const std::filesystem::path &path)
  {
    const std::string file    = "The file '" + path.string() + "' ";
    const auto        content = read_text_file(path);
    AssertThrow(content.has_value(),
                ExcUser(file + "cannot be read. Give the path of an existing "
                               "file."));
    MapFeatures result;
    try
      {
        Tree               tree;
        std::vector<Tree>  polygons, lines;
        std::istringstream in(*content);
        boost::property_tree::read_json(in, tree);
        collect("Polygon", tree, polygons);
        collect("LineString", tree, lines);
        for (const Tree &polygon : polygons)
          {
            auto &rings = result.polygons.emplace_back();
            for (const auto &[key, ring] : polygon)
              rings.push_back(corners_of(ring));
          }
        for (const Tree &line : lines)
          result.lines.push_back(corners_of(line));
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
