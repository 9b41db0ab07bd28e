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
  /// The surfaces of a case, section Surfaces, which may have none: seabeds,
  /// slip surfaces, boundaries between layers, for whatever is described by
  /// them.
  template <int dim>
  class Surfaces : public dealii::ParameterAcceptor, public SurfaceSource<dim>
  {
  public:
    /// @p names must be known before the parameters are declared.
    explicit Surfaces(const std::vector<std::string> &names);

    /// To be called after parsing: reads the files, from @p folder. @p origin of
    /// the mesh on the map: easting, northing, height, m. Throws ExcUser.
    void
    prepare(const Constants             &constants,
            const std::filesystem::path &folder,
            const dealii::Point<3>      &origin);

    std::shared_ptr<const Surface<dim>>
    surface(const std::string &path,
            const std::string &expression) const override;

    const dealii::Point<3> &
    origin() const override
    {
      return origin_;
    }

    std::vector<dealii::Point<2>>
    section(const std::string &path) const override;

    std::vector<dealii::Point<2>>
    read_route(const std::string &path, const std::string &file) const override;

    /// Sentences for the log: where projected rasters lie on the map.
    std::vector<std::string>
    notes() const;

    /// In 2-D, a remark for each section of a raster that rises from x = @p from
    /// to @p to, the range of the soil, m.
    std::vector<std::string>
    notes_on_rising(double from, double to) const;

    /// Rasters and routes must be the same when the run is resumed.
    void
    list_state(StateList &list) const;

    /// The raster that the surface @p name was read from; without a name, that
    /// of the first surface that has one. Null if there is none.
    const Raster *
    raster(const std::string &name = "") const;

  private:
    /// Return the code of the map that files are brought to; empty if there is
    /// none.
    std::string
    map() const;

    std::vector<std::string>                            listed_names_;
    std::vector<std::unique_ptr<NamedSurface<dim>>>     named_;
    const Constants                                    *constants_ = nullptr;
    dealii::Point<3>                                    origin_;
    std::vector<typename ExpressionSurface<dim>::Named> surfaces_;
    std::filesystem::path                               folder_;
    std::vector<InputFile>                              files_;

    struct Route
    {
      InputFile                     file;
      std::vector<dealii::Point<2>> corners; ///< on the map, m
    };
    mutable std::map<std::string, Route> routes_; ///< that were read, by file
  };
} // namespace talus

#endif
