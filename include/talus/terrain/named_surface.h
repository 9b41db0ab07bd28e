// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_terrain_named_surface_h
#define talus_terrain_named_surface_h

#include <talus/base/raster.h>
#include <talus/geometry/expression_surface.h>
#include <talus/geometry/surface.h>

#include <deal.II/base/parameter_acceptor.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// A surface that the user has given a name to: the raster of a file, an
  /// expression, or the distance from an outline.
  template <int dim>
  class NamedSurface : public dealii::ParameterAcceptor
  {
  public:
    explicit NamedSurface(const std::string &name);

    const std::string &
    name() const
    {
      return name_;
    }

    /// Whether it is an expression, which may name others.
    bool
    is_expression() const
    {
      return !expression_.empty();
    }

    bool
    has_file() const
    {
      return !file_.empty();
    }

    /// Of the raster, from @p folder.
    std::filesystem::path
    file(const std::filesystem::path &folder) const
    {
      return folder / file_;
    }

    const std::string &
    expression() const
    {
      return expression_;
    }

    /// Return the map that the file is brought to, in the user's words; empty if
    /// it is used as it is.
    const std::string &
    projection() const
    {
      return projection_;
    }

    std::string
    path(const std::string &entry) const
    {
      return "'Surfaces/" + name_ + "/" + entry + "'";
    }

    /// Throw ExcUser unless the user has said in one way what the surface is.
    void
    check_entries() const;

    /// Read the raster, from @p folder, or the outline. @p origin of the mesh on
    /// the map: easting, northing, height, m. Throws ExcUser.
    std::shared_ptr<const Surface<dim>>
    read(const std::filesystem::path &folder,
         const dealii::Point<3>      &origin) const;

    /// Corners of the line on the map along which the raster is cut, 2-D only.
    /// Throws ExcUser if it is none.
    std::vector<dealii::Point<2>>
    section() const;

    /// Return the code of the map in `Projection`; empty if there is none. Throws
    /// ExcUser if it is no map in metres.
    std::string
    map() const;

  private:
    Raster
    read_file(const std::filesystem::path &file) const;
    std::shared_ptr<const Surface<dim>>
    read_outline(const dealii::Point<3> &origin) const;
    std::shared_ptr<const Surface<dim>>
    read_outline_file(const std::filesystem::path &file,
                      const dealii::Point<3>      &origin) const;

    std::string name_;
    std::string file_        = "";
    std::string projection_  = "";
    double      cell_size_   = 0.;
    std::string section_     = "";
    std::string expression_  = "";
    std::string outline_     = "";
    std::string coordinates_ = "mesh";
  };
} // namespace talus

#endif
