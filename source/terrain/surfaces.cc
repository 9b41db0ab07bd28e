// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/terrain.h>
#include <talus/io/checksum.h>
#include <talus/io/files.h>
#include <talus/io/map_outline.h>
#include <talus/terrain/bring_to_map.h>
#include <talus/terrain/surfaces.h>

#include <algorithm>
#include <cctype>
#include <iomanip>
#include <set>
#include <sstream>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Surfaces<dim>::Surfaces(const std::vector<std::string> &names)
    : ParameterAcceptor("/Surfaces")
  {
    add_parameter("Names",
                  listed_names_,
                  "Names of the surfaces (mudline, slip surface, boundary of "
                  "a layer) for use in terrains, layers and further "
                  "surfaces, separated by commas; each surface has a section "
                  "of the same name. Empty: none.");
    for (const std::string &name : names)
      named_.push_back(std::make_unique<NamedSurface<dim>>(name));
  }



  namespace
  {
    bool
    is_part_of_name(const unsigned char c)
    {
      return std::isalnum(c) || c == '_';
    }



    /// Check a name: in expressions a name must be a single word without
    /// another meaning.
    void
    check_name(const std::string &name)
    {
      static const std::set<std::string> taken = {
        "x", "y", "z", "t", "pi", "depth", "overburden"};
      AssertThrow(
        !name.empty() && !std::isdigit(name[0]) &&
          std::all_of(name.begin(), name.end(), is_part_of_name) &&
          taken.count(name) == 0,
        ExcUser(
          text("'Surfaces/Names' lists '",
               name,
               "', where a word of letters, digits and '_' was expected, "
               "for use in expressions, except x, y, z, t, pi, depth. Choose "
               "another name.")));
    }
  } // namespace



  // In the order of the list, without circular references.
  template <int dim>
  void
  Surfaces<dim>::prepare(const Constants             &constants,
                         const std::filesystem::path &folder,
                         const Point<3>              &origin,
                         const Box<dim>              &mesh,
                         const double                 cell_size)
  {
    constants_ = &constants;
    origin_    = origin;
    folder_    = folder;
    routes_.clear();
    surfaces_.clear();
    files_.clear();
    for (const auto &named : named_)
      {
        check_name(named->name());
        named->check_entries();
        surfaces_.emplace_back(
          named->name(),
          named->is_expression()
            ? surface(named->path("Expression"), named->expression())
            : named->read(folder, origin, mesh, cell_size));
        if (named->has_file())
          files_.push_back({"raster of " + named->name(),
                            "raster",
                            named->file(folder),
                            text(checksum_of_file(named->file(folder)))});
      }
  }



  template <int dim>
  std::shared_ptr<const Surface<dim>>
  Surfaces<dim>::surface(const std::string &path,
                         const std::string &expression) const
  {
    for (const auto &[name, surface] : surfaces_)
      if (expression == name)
        return surface;
    return std::make_shared<ExpressionSurface<dim>>(path,
                                                    expression,
                                                    *constants_,
                                                    surfaces_);
  }



  template <int dim>
  std::vector<Point<2>>
  Surfaces<dim>::section(const std::string &path) const
  {
    const NamedSurface<dim> *first = nullptr;
    for (const auto &named : named_)
      if (!named->is_expression())
        {
          AssertThrow(
            first == nullptr || named->section() == first->section(),
            ExcUser(
              text(path,
                   " is on the map, but the rasters are cut "
                   "along two lines, ",
                   first->path("Section"),
                   " and ",
                   named->path("Section"),
                   ": a place of the map may have two x. Use the same line "
                   "for all rasters.")));
          if (first == nullptr)
            first = named.get();
        }
    AssertThrow(first != nullptr,
                ExcUser(path + " is on the map, but no section of a raster "
                               "tells where x lies there. Give it in the axes "
                               "of the mesh, or a surface with `File` and "
                               "`Section`."));
    return first->section();
  }



  template <int dim>
  std::string
  Surfaces<dim>::map() const
  {
    for (const auto &named : named_)
      if (!named->projection().empty())
        return named->map();
    return "";
  }



  template <int dim>
  std::vector<Point<2>>
  Surfaces<dim>::read_route(const std::string &path,
                            const std::string &file) const
  {
    // Shape, log and remarks read the same route; the file is read once.
    if (const auto known = routes_.find(file); known != routes_.end())
      return known->second.corners;
    const std::filesystem::path place = folder_ / file;
    protect_input(place);
    MapCorners line    = read_line(place);
    auto      &corners = line.parts[0];
    bring_to_map(corners,
                 line.coordinate_system,
                 map(),
                 path + ": the line of '" + file + "'",
                 "`Projection` of a surface");
    std::string name = "route " + file;
    std::replace(name.begin(), name.end(), '/', ' ');
    routes_[file] = {{name, "route", place, text(checksum_of_file(place))},
                     corners};
    return corners;
  }



  template <int dim>
  std::vector<std::string>
  Surfaces<dim>::notes() const
  {
    std::vector<std::string> result;
    for (const auto &named : named_)
      if (const Raster *map = raster(named->name()))
        {
          const auto [lowest, highest] = range_of(map->values);
          result.push_back(text(
            "The raster of ",
            named->path("File"),
            named->projection().empty() ? " was read" : " was projected to ",
            named->projection(),
            ": ",
            map->n_columns,
            " x ",
            map->n_rows,
            " cells of ",
            map->dx,
            " m, easting from ",
            map->west,
            " m to ",
            map->east(),
            " m, northing from ",
            map->south,
            " m to ",
            map->north(),
            map->has_heights ? " m, heights [m] from " : " m, numbers from ",
            lowest,
            " to ",
            highest,
            map->smoothed_over == 0.
              ? "."
              : text(", smoothed over the smallest cells "
                     "of the mesh, ",
                     map->smoothed_over,
                     " m, which cannot follow smaller "
                     "forms.")));
        }
    return result;
  }



  template <int dim>
  std::vector<std::string>
  Surfaces<dim>::notes_on_rising(const double from, const double to) const
  {
    std::vector<std::string> result;
    for (std::size_t k = 0; dim == 2 && k < named_.size(); ++k)
      {
        const Surface<dim> &surface = *surfaces_[k].second;
        Point<dim>          begin, end;
        begin[0]                = from;
        end[0]                  = to;
        const Raster *const map = raster(named_[k]->name());
        if (map == nullptr || !map->has_heights ||
            !surface.is_known_at(begin) || !surface.is_known_at(end))
          continue;
        const double first = surface.at(begin).height,
                     last  = surface.at(end).height;
        // Less than one in a hundred is flat.
        if (last - first > 0.01 * (to - from))
          result.push_back(
            text(std::setprecision(6),
                 "The surface '",
                 named_[k]->name(),
                 "' rises along its section, from ",
                 first,
                 " m at x = ",
                 from,
                 " m to ",
                 last,
                 " m at x = ",
                 to,
                 " m, where the soil lies: soil slides towards smaller x. "
                 "To reverse the section, list the corners of ",
                 named_[k]->path("Section"),
                 " in the other order."));
      }
    return result;
  }



  template <int dim>
  void
  Surfaces<dim>::list_state(StateList &list) const
  {
    for (const InputFile &file : files_)
      file.list_state(list);
    for (const auto &[name, route] : routes_)
      route.file.list_state(list);
  }



  template <int dim>
  const Raster *
  Surfaces<dim>::raster(const std::string &name) const
  {
    for (const auto &[known, surface] : surfaces_)
      if (name.empty() || name == known)
        if (const auto *terrain =
              dynamic_cast<const Terrain<dim> *>(surface.get()))
          return &terrain->raster();
    return nullptr;
  }



  template class Surfaces<2>;
  template class Surfaces<3>;
} // namespace talus
