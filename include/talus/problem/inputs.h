// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_inputs_h
#define talus_problem_inputs_h

#include <talus/base/expression.h>
#include <talus/problem/parameter_preview.h>
#include <talus/terrain/surfaces.h>

#include <filesystem>
#include <vector>

namespace talus
{
  /// Constants, surfaces and files to which entries of the parameter file
  /// refer.
  template <int dim>
  struct Inputs
  {
    explicit Inputs(const ParameterPreview &preview)
      : folder(preview.folder)
      , surfaces(preview.surfaces)
    {}

    /// Read the surfaces. @p origin of the mesh on the map: easting, northing,
    /// height, m. @p mesh is the box of the mesh, @p cell_size that of the
    /// smallest cells, m. Throws ExcUser.
    void
    prepare(const dealii::Point<3> &origin,
            const Box<dim>         &mesh,
            const double            cell_size)
    {
      constants.values(); // throws, also if no expression needs a constant
      surfaces.prepare(constants, folder, origin, mesh, cell_size);
    }

    /// Add the files to the state: a resumed run needs the same files.
    void
    list_state(StateList &list) const
    {
      surfaces.list_state(list);
      for (const InputFile &table : tables)
        table.list_state(list);
    }

    Constants              constants;
    std::filesystem::path  folder; ///< place of the parameter file
    Surfaces<dim>          surfaces;
    std::vector<InputFile> tables; ///< strengths and pressures in depth
  };
} // namespace talus

#endif
