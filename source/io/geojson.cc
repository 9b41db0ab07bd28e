// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
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



    /// Append the coordinates of all geometries of @p kind, Polygon or LineString,
    /// of a GeoJSON object and of all in it.
    void
    collect(const std::string &kind,
            const Tree        &object,
            std::vector<Tree> &coordinates)
    {
      const std::string type = object.get("type", "");
      if (type == kind)
        coordinates.push_back(member(object, "coordinates"));
      else if (type == "Multi" + kind)
        for (const auto &[key, one] : member(object, "coordinates"))
          coordinates.push_back(one);
      else if (type == "Feature")
        collect(kind, member(object, "geometry"), coordinates);
      else
        for (const std::string list : {"features", "geometries"})
          for (const auto &[key, part] : member(object, list))
            collect(kind, part, coordinates);
    }



    std::vector<Point<2>>
    corners_of(const Tree &positions)
    {
      std::vector<Point<2>> corners;
      for (const auto &[key, position] : positions)
        {
          // Behind the first two there may be a height.
          std::vector<double> numbers;
          for (const auto &[no_key, number] : position)
            numbers.push_back(number.template get_value<double>());
          corners.emplace_back(numbers.at(0), numbers.at(1));
        }
      return corners;
    }



    /// Without a name of a coordinate system, or with that of WGS 84.
    bool
    is_in_degrees(const Tree &file)
    {
      const std::string name      = file.get("crs.properties.name", "");
      const auto        ends_with = [&](const std::string &end) {
        return name.size() >= end.size() &&
               name.compare(name.size() - end.size(), end.size(), end) == 0;
      };
      return name.empty() || ends_with("CRS84") || ends_with(":4326");
    }
  } // namespace



  bool
  is_geojson(const std::filesystem::path &path)
  {
    return path.extension() == ".geojson" || path.extension() == ".json";
  }



  namespace
  {
    /// Read a file, and let @p take have its content and the coordinates of all
    /// geometries of @p kind. Throws ExcUser unless there is one.
    template <typename Take>
    void
    read(const std::filesystem::path &path,
         const std::string           &kind,
         const std::string           &in_words,
         const Take                  &take)
    {
      const std::string file = "The GeoJSON file '" + path.string() + "' ";
      try
        {
          Tree              tree;
          std::vector<Tree> found;
          boost::property_tree::read_json(path.string(), tree);
          collect(kind, tree, found);
          AssertThrow(found.size() == 1,
                      ExcUser(text(file,
                                   "has ",
                                   found.size(),
                                   " ",
                                   in_words,
                                   "s, where one was expected. Save one to a "
                                   "file of its own.")));
          take(file, tree, found[0]);
        }
      catch (const boost::property_tree::ptree_error &error)
        {
          AssertThrow(false,
                      ExcUser(file + "cannot be read: " + error.what() + "."));
        }
      catch (const std::out_of_range &)
        {
          AssertThrow(false,
                      ExcUser(file +
                              "has a corner with less than two numbers."));
        }
    }
  } // namespace



  /// A ring ends where it begins.
  GeojsonPolygon
  read_geojson_polygon(const std::filesystem::path &path)
  {
    GeojsonPolygon result;
    read(path,
         "Polygon",
         "polygon",
         [&](const std::string &file, const Tree &tree, const Tree &rings) {
           AssertThrow(rings.size() == 1,
                       ExcUser(text(file,
                                    "has a polygon of ",
                                    rings.size(),
                                    " rings, where one was expected: the "
                                    "outline, without holes.")));
           result = {corners_of(rings.front().second), is_in_degrees(tree)};
         });
    auto &corners = result.corners;
    if (corners.size() > 1 && corners.front() == corners.back())
      corners.pop_back();
    return result;
  }



  GeojsonLine
  read_geojson_line(const std::filesystem::path &path)
  {
    GeojsonLine result;
    read(path,
         "LineString",
         "line",
         [&](const std::string &, const Tree &tree, const Tree &line) {
           result = {corners_of(line), is_in_degrees(tree)};
         });
    return result;
  }
} // namespace talus
