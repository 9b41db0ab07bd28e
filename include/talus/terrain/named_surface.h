// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_terrain_named_surface_h
#define talus_terrain_named_surface_h

#include <talus/base/box.h>
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
  /// Surface with a name given by the user: the raster of a file, an
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

    /// Return whether the surface is an expression, possibly in earlier
    /// surfaces.
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

    /// Whether the numbers of the file are heights.
    bool
    has_heights() const
    {
      return quantity_ == "height";
    }

    /// Return the path of the file, from @p folder.
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

    /// Return the name of the map to which the file is projected; empty if the
    /// file is used unchanged.
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

    /// Throw ExcUser unless exactly one description of the surface is given.
    void
    check_entries() const;

    /// Read the raster, from @p folder, or the outline. @p origin of the mesh
    /// on the map: easting, northing, height, m. @p mesh is the box of the
    /// mesh, around which a large raster is read; the raster is smoothed over
    /// @p cell_size, m. Throws ExcUser.
    std::shared_ptr<const Surface<dim>>
    read(const std::filesystem::path &folder,
         const dealii::Point<3>      &origin,
         const Box<dim>              &mesh,
         double                       cell_size) const;

    /// Return the corners of the line on the map along which the raster is cut,
    /// 2-D only. Throws ExcUser if the entry is no line.
    std::vector<dealii::Point<2>>
    section() const;

    /// Return the code of the map in `Projection`; empty without the entry.
    /// Throws ExcUser unless the map is in metres.
    std::string
    map() const;

  private:
    void
    add_plan_parameters();
    Raster
    read_file(const std::filesystem::path &file, const Box<2> &plan) const;
    std::shared_ptr<const Surface<dim>>
    read_outlines(const std::filesystem::path &file,
                  const dealii::Point<3>      &origin) const;

    std::string name_;
    std::string file_        = "";
    std::string attribute_   = "";
    std::string quantity_    = "height";
    std::string projection_  = "";
    double      cell_size_   = 0.;
    std::string section_     = "";
    std::string expression_  = "";
    std::string outline_     = "";
    std::string coordinates_ = "mesh";
  };
} // namespace talus

#endif
