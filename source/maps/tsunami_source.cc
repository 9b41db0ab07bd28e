// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/files.h>
#include <talus/maps/geographic_motion.h>
#include <talus/maps/tsunami_source.h>
#include <talus/points/points_kernel.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace talus
{
  using namespace dealii;

  namespace
  {
    const char *const name_of_dtopo  = "tsunami-source.tt3";
    const char *const name_of_netcdf = "tsunami-source.nc";
    const char *const name_of_table  = "tsunami-source.csv";

    // A dtopo file has a number for every cell and block.
    constexpr double max_cells = 1e7;

    /// Volume of the soil on all ranks, m^dim. Collective.
    template <int dim>
    double
    volume_of_soil(const State<dim> &state)
    {
      double volume = 0;
      for (unsigned int p = 0; p < state.points.size(); ++p)
        volume += volume_of_points<dim, double>(state.points, p);
      return Utilities::MPI::sum(volume, state.communicator());
    }
  } // namespace



  template <int dim>
  void
  TsunamiSource<dim>::check(const State<dim> &state) const
  {
    settings_.check(dim);
    AssertThrow(!settings_.is_in_degrees() ||
                  map_unit(coordinate_system()) == MapUnit::metres,
                ExcUser("'Tsunami source/Coordinates' is degrees, but the "
                        "coordinate system of the map is not known: it is "
                        "that of the raster of 'Maps/Raster', or of the first "
                        "surface with a raster. Give a raster with a "
                        "coordinate system in metres, or use map."));
    const MapAxes<dim> axes = this->axes(state);
    double             n = (dim == 2 ? settings_.width() / axes[0].size : 1.);
    for (const auto &axis : axes)
      n *= axis.number;
    AssertThrow(n <= max_cells,
                ExcUser(text("The tsunami source would have ",
                             n,
                             " cells, where ",
                             max_cells,
                             " are the most. Make 'Tsunami source/Cell size' "
                             "larger.")));
  }



  template <int dim>
  std::string
  TsunamiSource<dim>::coordinate_system() const
  {
    const Raster *raster = problem_.surfaces().raster(maps_->raster());
    return raster != nullptr ? raster->coordinate_system : "";
  }



  template <int dim>
  MapAxes<dim>
  TsunamiSource<dim>::axes(const State<dim> &state) const
  {
    return map_axes(problem_,
                    state,
                    maps_->raster(),
                    settings_.cell_size() > 0 ? settings_.cell_size()
                                              : maps_->cell_size());
  }



  template <int dim>
  void
  TsunamiSource<dim>::begin(const OutputSettings &settings,
                            const State<dim>     &state,
                            const Beginning /*beginning*/)
  {
    folder_ = settings.folder;
    writes_ = is_first_rank(state.communicator());
    axes_   = axes(state);
    sums_   = std::make_unique<ColumnSums<dim>>(
      std::make_shared<LatticeColumns<dim>>(axes_));
    gravity_ = state.constants.gravity.norm();
    // A checkpoint gives its rows to all ranks.
    if (!writes_)
      {
        thickness_at_start_.clear();
        blocks_.clear();
      }
    for (const auto &column : thickness_at_start_)
      AssertThrow(column.first < sums_->columns().size(),
                  ExcUser("The checkpoint belongs to a tsunami source with "
                          "other cells. Resume with the parameters of the "
                          "first run."));
  }



  template <int dim>
  void
  TsunamiSource<dim>::start(const State<dim> &state)
  {
    sums_->sum_soil(state);
    sums_->sum_over_ranks(state.communicator());
    if (is_first_rank(state.communicator()))
      for (const unsigned int column : sums_->with_soil())
        thickness_at_start_.emplace_back(column, sums_->thickness(column));
    std::sort(thickness_at_start_.begin(), thickness_at_start_.end());
    follow(state);
  }



  template <int dim>
  void
  TsunamiSource<dim>::follow(const State<dim> &state)
  {
    if (n_blocks_ * settings_.interval() > state.time)
      return;
    AssertThrow(state.time_step <= settings_.interval(),
                ExcUser(text("'Tsunami source/Interval' is ",
                             settings_.interval(),
                             " s, shorter than the time step of ",
                             state.time_step,
                             " s. Give a longer interval.")));
    const Block now     = block(state);
    step_of_last_block_ = state.step;
    for (; n_blocks_ * settings_.interval() <= state.time; ++n_blocks_)
      if (is_first_rank(state.communicator()))
        blocks_.push_back(now);
  }



  // Sum the soil; the result is complete on the first rank only. Collective.
  template <int dim>
  typename TsunamiSource<dim>::Block
  TsunamiSource<dim>::block(const State<dim> &state)
  {
    Block result;
    result.volume = volume_of_soil(state);
    sums_->sum_soil(state);
    sums_->sum_over_ranks(state.communicator());
    std::map<unsigned int, double> change;
    for (const unsigned int column : sums_->with_soil())
      {
        change[column] = sums_->thickness(column);
        result.mass += (*sums_)[column].mass;
        result.momentum += (*sums_)[column].momentum;
      }
    for (const auto &[column, thickness] : thickness_at_start_)
      change[column] -= thickness;
    for (const auto &column : change)
      if (column.second != 0)
        result.change.push_back(column);
    return result;
  }



  template <int dim>
  void
  TsunamiSource<dim>::observe(const State<dim> &state)
  {
    // Between two blocks the current state stands for the next block.
    const bool  is_between = step_of_last_block_ != state.step;
    const Block now        = is_between ? block(state) : Block();
    if (!is_first_rank(state.communicator()))
      return;
    if (is_between)
      blocks_.push_back(now);
    const SurfaceMotion source = settings_.is_in_degrees()
                                   ? on_degrees(motion(), coordinate_system())
                                   : motion();
    write_dtopo(folder_ / name_of_dtopo, source);
    if (settings_.writes_netcdf())
      write_netcdf(folder_ / name_of_netcdf, source);
    write_table();
    if (is_between)
      blocks_.pop_back();
  }



  /// Return the raster of the source; in 2-D rows of equal height over the
  /// width, symmetric about the section.
  template <int dim>
  Raster
  TsunamiSource<dim>::frame() const
  {
    if constexpr (dim == 3)
      return map_frame(axes_, problem_.origin());
    else
      {
        MapAxes<3> plan;
        plan[0] = {axes_[0].lower, axes_[0].size, axes_[0].number};
        plan[1].number =
          std::max(2., std::round(settings_.width() / axes_[0].size));
        plan[1].size  = settings_.width() / plan[1].number;
        plan[1].lower = -0.5 * settings_.width();
        return map_frame(plan, problem_.origin());
      }
  }



  template <int dim>
  SurfaceMotion
  TsunamiSource<dim>::motion() const
  {
    SurfaceMotion result;
    result.frame      = frame();
    result.start_time = settings_.start_time();
    result.interval   = settings_.interval();
    result.n_blocks   = blocks_.size();
    result.change     = [this, frame = result.frame](const unsigned int k) {
      std::vector<double> values(std::size_t(frame.n_columns) * frame.n_rows);
      for (const auto &[column, change] : blocks_[k].change)
        // A section has the same change in all rows.
        for (std::size_t i = column; i < values.size();
             i += (dim == 2 ? frame.n_columns : values.size()))
          values[i] = change;
      return values;
    };
    return result;
  }



  /// Return a row of the table: time; volumes raised and lowered; change of the
  /// volume of the soil; raised less lowered less change; velocity and
  /// acceleration of the centre of mass along the axes of the plan; speed over
  /// sqrt(g d) if a depth is given.
  template <int dim>
  std::vector<double>
  TsunamiSource<dim>::row_of_table(const unsigned int k) const
  {
    const double width  = (dim == 2 ? settings_.width() : 1.);
    const double area   = sums_->columns().area() * width;
    double       raised = 0, lowered = 0;
    for (const auto &column : blocks_[k].change)
      (column.second > 0 ? raised : lowered) += std::abs(column.second) * area;
    const double volume     = (blocks_[k].volume - blocks_[0].volume) * width;
    std::vector<double> row = {k * settings_.interval(),
                               raised,
                               lowered,
                               volume,
                               raised - lowered - volume};
    const auto          velocity = [this](const unsigned int block) {
      return blocks_[block].mass > 0
                        ? blocks_[block].momentum / blocks_[block].mass
                        : Tensor<1, dim>();
    };
    const Tensor<1, dim> u      = velocity(k);
    const Tensor<1, dim> change = u - velocity(k > 0 ? k - 1 : 0);
    for (unsigned int a = 0; a < dim - 1; ++a)
      row.push_back(u[axis_of_plan<dim>(a)]);
    for (unsigned int a = 0; a < dim - 1; ++a)
      row.push_back(change[axis_of_plan<dim>(a)] / settings_.interval());
    if (settings_.water_depth() > 0)
      row.push_back(u.norm() / std::sqrt(gravity_ * settings_.water_depth()));
    return row;
  }



  template <int dim>
  void
  TsunamiSource<dim>::write_table()
  {
    write_file(folder_ / name_of_table, [this](std::ostream &out) {
      out << "time [s],volume raised [m^3],volume lowered [m^3],"
             "change of soil volume [m^3],closure [m^3],"
          << (dim == 2 ? "centre velocity x [m/s],centre acceleration x [m/s^2]"
                       : "centre velocity x [m/s],centre velocity z [m/s],"
                         "centre acceleration x [m/s^2],"
                         "centre acceleration z [m/s^2]")
          << (settings_.water_depth() > 0 ? ",speed over sqrt(g d) [-]" : "")
          << '\n';
      for (unsigned int k = 0; k < blocks_.size(); ++k)
        {
          const std::vector<double> row = row_of_table(k);
          for (unsigned int i = 0; i < row.size(); ++i)
            out << (i > 0 ? "," : "") << csv_field(row[i]);
          out << '\n';
        }
    });
  }



  template <int dim>
  void
  TsunamiSource<dim>::list_state(StateList &list)
  {
    if (!settings_.is_enabled())
      return;
    list.add("blocks of the tsunami source", "-", n_blocks_, Reduction::equal);
    list.add_table(
      {"tsunami source",
       "block (-1: thickness at the start), column, change of thickness [m]",
       3,
       [this]() { return changes(); },
       [this](const std::vector<double> &rows) { restore_changes(rows); }});
    list.add_table(
      {"sums of the tsunami source",
       "volume, mass, momentum of the soil by block; SI units",
       2 + dim,
       [this]() { return sums_of_blocks(); },
       [this](const std::vector<double> &rows) { restore_sums(rows); }});
  }



  template <int dim>
  std::vector<double>
  TsunamiSource<dim>::changes() const
  {
    std::vector<double> rows;
    const auto          add = [&](const double block, const auto &columns) {
      for (const auto &[column, change] : columns)
        rows.insert(rows.end(), {block, double(column), change});
    };
    add(-1, thickness_at_start_);
    for (unsigned int k = 0; k < blocks_.size(); ++k)
      add(k, blocks_[k].change);
    return rows;
  }



  template <int dim>
  void
  TsunamiSource<dim>::restore_changes(const std::vector<double> &rows)
  {
    for (std::size_t i = 0; i < rows.size(); i += 3)
      {
        // A block without change has no row.
        if (rows[i] >= blocks_.size())
          blocks_.resize(rows[i] + 1);
        (rows[i] < 0 ? thickness_at_start_ : blocks_[rows[i]].change)
          .emplace_back(rows[i + 1], rows[i + 2]);
      }
  }



  template <int dim>
  std::vector<double>
  TsunamiSource<dim>::sums_of_blocks() const
  {
    std::vector<double> rows;
    for (const Block &block : blocks_)
      {
        rows.insert(rows.end(), {block.volume, block.mass});
        for (unsigned int d = 0; d < dim; ++d)
          rows.push_back(block.momentum[d]);
      }
    return rows;
  }



  template <int dim>
  void
  TsunamiSource<dim>::restore_sums(const std::vector<double> &rows)
  {
    blocks_.resize(rows.size() / (2 + dim));
    for (unsigned int k = 0; k < blocks_.size(); ++k)
      {
        const auto row    = rows.begin() + k * (2 + dim);
        blocks_[k].volume = row[0];
        blocks_[k].mass   = row[1];
        for (unsigned int d = 0; d < dim; ++d)
          blocks_[k].momentum[d] = row[2 + d];
      }
  }



  template <int dim>
  void
  TsunamiSource<dim>::sync()
  {
    if (!writes_)
      return;
    for (const char *name : {name_of_dtopo, name_of_netcdf, name_of_table})
      if (std::filesystem::exists(folder_ / name))
        {
          const std::string error = sync_to_disk(folder_ / name);
          AssertThrow(error.empty(),
                      ExcUser(failed_write(folder_ / name, error)));
        }
  }



  template class TsunamiSource<2>;
  template class TsunamiSource<3>;
} // namespace talus
