// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_terrain_surfaces_h
#define talus_terrain_surfaces_h

#include <talus/base/raster.h>
#include <talus/base/state_list.h>
#include <talus/io/input_file.h>
#include <talus/terrain/named_surface.h>

#include <deal.II/base/parameter_acceptor.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Surfaces of a case, section Surfaces, possibly none: seabeds, slip
  /// surfaces, boundaries between layers, for use in shapes and expressions.
  template <int dim>
  class Surfaces : public dealii::ParameterAcceptor, public SurfaceSource<dim>
  {
  public:
    /// @p names must be known before the parameters are declared.
    explicit Surfaces(const std::vector<std::string> &names);

    /// Read the files, from @p folder; call after parsing. @p origin of the
    /// mesh on the map: easting, northing, height, m. @p mesh is the box of the
    /// mesh. Rasters are smoothed over @p cell_size, m. Throws ExcUser.
    void
    prepare(const Constants             &constants,
            const std::filesystem::path &folder,
            const dealii::Point<3>      &origin,
            const Box<dim>              &mesh,
            double                       cell_size = 0.);

    std::shared_ptr<const Surface<dim>>
    surface(const std::string &path,
            const std::string &expression) const override;

    std::vector<typename Surface<dim>::Named>
    named() const override
    {
      return surfaces_;
    }

    const dealii::Point<3> &
    origin() const override
    {
      return origin_;
    }

    std::vector<dealii::Point<2>>
    section(const std::string &path) const override;

    std::vector<dealii::Point<2>>
    read_route(const std::string &path, const std::string &file) const override;

    /// Return sentences for the log on the places of projected rasters on the
    /// map.
    std::vector<std::string>
    notes() const;

    /// In 2-D, return a remark for each section of a raster that rises from x =
    /// @p from to @p to, the range of the soil, m.
    std::vector<std::string>
    notes_on_rising(double from, double to) const;

    /// Add rasters and routes to the state: a resumed run needs the same files.
    void
    list_state(StateList &list) const;

    /// Return the raster of the surface @p name; without a name, of the first
    /// surface with a raster. Null if there is none.
    const Raster *
    raster(const std::string &name = "") const;

  private:
    /// Return the code of the map of projected files; empty if there is none.
    std::string
    map() const;

    std::vector<std::string>                        listed_names_;
    std::vector<std::unique_ptr<NamedSurface<dim>>> named_;
    const Constants                                *constants_ = nullptr;
    dealii::Point<3>                                origin_;
    std::vector<typename Surface<dim>::Named>       surfaces_;
    std::filesystem::path                           folder_;
    std::vector<InputFile>                          files_;

    struct Route
    {
      InputFile                     file;
      std::vector<dealii::Point<2>> corners; ///< on the map, m
    };
    /// Routes read so far, by file.
    mutable std::map<std::string, Route> routes_;
  };
} // namespace talus

#endif
