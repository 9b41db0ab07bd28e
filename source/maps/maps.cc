// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/contact/ground.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/esri_grid.h>
#include <talus/io/files.h>
#include <talus/io/gdal_raster.h>
#include <talus/io/vtu_writer.h>
#include <talus/maps/maps.h>
#include <talus/observers/state_cells.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  Maps<dim>::check(const State<dim> &state) const
  {
    this->settings().check(state.grid.domain_before_growth().length(1));
    axes(state);
    if (dim == 3 && this->settings().writes_geotiff())
      check_geotiff(coordinate_system());
  }



  template <int dim>
  std::string
  Maps<dim>::coordinate_system() const
  {
    const Raster *raster =
      this->problem().surfaces().raster(this->settings().raster());
    return raster != nullptr ? raster->coordinate_system : "";
  }



  template <int dim>
  MapAxes<dim>
  Maps<dim>::axes(const State<dim> &state) const
  {
    return map_axes(this->problem(), state, this->settings());
  }



  /// Evaluated once, unless obstacles move. Outside of the mesh the ground has
  /// the height of the mesh edge.
  template <int dim>
  void
  Maps<dim>::find_ground(const State<dim> &state)
  {
    if (!ground_.empty() && !this->problem().obstacles.move())
      return;
    ground_.clear();
    axes_                     = axes(state);
    const Box<dim>     domain = state.grid.domain_before_growth();
    const Ground<dim>  ground(domain, &this->problem().obstacles);
    const unsigned int n_z = (dim == 3 ? axes_[dim - 2].number : 0);
    for (unsigned int k = 0; k <= n_z; ++k)
      for (unsigned int i = 0; i <= axes_[0].number; ++i)
        {
          Point<dim> x;
          x[dim - 1] = axes_[dim - 2].lower + k * axes_[dim - 2].size;
          x[0]       = axes_[0].lower + i * axes_[0].size;
          x[1]       = domain.upper[1];
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = std::clamp(x[d], domain.lower[d], domain.upper[d]);
          ground_.push_back(ground.elevation(x));
        }
  }



  /// Return the indices into ground_ of the corners of a column, in the order
  /// of deal.II.
  template <int dim>
  std::vector<unsigned int>
  corners_of_column(const unsigned int column, const unsigned int n_x)
  {
    const unsigned int i = column % n_x, k = column / n_x;
    const unsigned int first = k * (n_x + 1) + i;
    if (dim == 2)
      return {first, first + 1};
    return {first, first + 1, first + n_x + 1, first + n_x + 2};
  }



  template <int dim>
  double
  Maps<dim>::elevation(const unsigned int column) const
  {
    double     sum     = 0;
    const auto corners = corners_of_column<dim>(column, axes_[0].number);
    for (const unsigned int corner : corners)
      sum += ground_[corner];
    return sum / corners.size();
  }



  template <int dim>
  void
  Maps<dim>::write_files(const State<dim> &state)
  {
    find_ground(state);
    if constexpr (dim == 2)
      write_table();
    else
      {
        write_rasters();
        write_surface(state);
      }
  }



  /// All fields of the history, including the arrival time for each threshold
  /// of the settings, the state of a bed that softens, and the pore pressure.
  template <int dim>
  std::vector<typename Maps<dim>::MapField>
  Maps<dim>::fields() const
  {
    std::vector<MapField> result;
    for (const HistoryField &field :
         history_fields(this->envelope().settings().arrival_thresholds))
      result.push_back(
        {field.name, field.unit, [this, field](const unsigned int column) {
           return field.value(this->envelope()[column]);
         }});
    const auto add = [&](const std::string &name,
                         const std::string &unit,
                         const auto        &columns,
                         const auto         value) {
      if (columns.is_used())
        result.push_back(
          {name, unit, [&columns, value](const unsigned int column) {
             return (columns.*value)(column);
           }});
    };
    add("slip of the bed", "m", bed_, &BedColumns<dim>::slip);
    add("share of bed shear stress left",
        "-",
        bed_,
        &BedColumns<dim>::share_left);
    add("largest pore pressure ratio",
        "-",
        pore_,
        &PoreColumns<dim>::largest_ratio);
    add("excess pore pressure at the bed",
        "Pa",
        pore_,
        &PoreColumns<dim>::at_bed);
    return result;
  }



  template <int dim>
  void
  Maps<dim>::write_table()
  {
    const Envelope<dim>      &envelope = this->envelope();
    const LatticeColumns<dim> columns(axes_);
    const auto                fields = this->fields();
    write_file(this->path_of_output(table_name), [&](std::ostream &out) {
      out.precision(16);
      out << "x [m],ground [m]";
      for (const MapField &field : fields)
        out << ',' << field.name << " [" << field.unit << ']';
      for (const unsigned int column : envelope.reached())
        {
          out << '\n' << columns.centre(column)[0] << ',' << elevation(column);
          for (const MapField &field : fields)
            out << ',' << csv_field(field.value(column));
        }
      out << '\n';
    });
  }



  /// Write a raster in all formats; @p name is the path without extension.
  template <int dim>
  void
  Maps<dim>::write_raster(const std::filesystem::path &name,
                          const Raster                &raster)
  {
    const auto grid = this->path_of_output(name.string() + ".asc");
    make_folder(grid.parent_path());
    write_esri_grid(grid, raster);
    if (const std::string map = well_known_text(raster.coordinate_system);
        !map.empty())
      write_file(this->path_of_output(name.string() + ".prj"),
                 [&](std::ostream &out) { out << map << '\n'; });
    if (this->settings().writes_geotiff())
      write_geotiff(this->path_of_output(name.string() + ".tif"), raster);
  }



  template <int dim>
  void
  Maps<dim>::write_rasters()
  {
    if constexpr (dim == 3)
      {
        const Point<3>    &origin = this->problem().origin();
        Raster             raster = map_frame(axes_, origin);
        const unsigned int n      = raster.n_columns * raster.n_rows;
        for (unsigned int column = 0; column < n; ++column)
          raster.values.push_back(origin[2] + elevation(column));
        raster.coordinate_system = coordinate_system();
        const auto write         = [&](std::string name) {
          std::replace(name.begin(), name.end(), ' ', '-');
          const auto path = std::filesystem::path(folder_name) / name;
          write_raster(path, raster);
        };
        write("ground");
        for (const MapField &field : fields())
          {
            raster.values.assign(n, std::numeric_limits<double>::quiet_NaN());
            for (const unsigned int column : this->envelope().reached())
              raster.values[column] = field.value(column);
            write(field.name);
          }
      }
  }



  template <int dim>
  void
  Maps<dim>::write_surface(const State<dim> &state)
  {
    const Envelope<dim> &envelope = this->envelope();
    std::vector<Field>   fields;
    for (const MapField &field : this->fields())
      fields.push_back({field.name,
                        field.unit,
                        FieldKind::scalar,
                        [field](const unsigned int column, double *value) {
                          *value = field.value(column);
                        }});
    OutputCells cells =
      state_cells(state, fields, ItemsAt::cells, CellShape::quad);
    const unsigned int n_x = axes_[0].number;
    for (const unsigned int column : envelope.reached())
      {
        for (const unsigned int corner : corners_of_column<dim>(column, n_x))
          {
            const unsigned int row = corner / (n_x + 1);
            Point<dim>         x;
            x[dim - 1] = axes_[dim - 2].lower + row * axes_[dim - 2].size;
            x[0]       = axes_[0].lower + corner % (n_x + 1) * axes_[0].size;
            x[1]       = ground_[corner];
            cells.add_vertex(x);
          }
        cells.items.push_back(column);
      }
    write_file(this->path_of_output(surface_name),
               [&](std::ostream &out) { write_vtu(out, cells); });
  }



  template class Maps<2>;
  template class Maps<3>;
} // namespace talus
