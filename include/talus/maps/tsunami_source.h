// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_tsunami_source_h
#define talus_maps_tsunami_source_h

#include <talus/io/surface_motion.h>
#include <talus/maps/column_sums.h>
#include <talus/maps/map_axes.h>
#include <talus/maps/map_settings.h>
#include <talus/maps/tsunami_settings.h>
#include <talus/observers/observer.h>
#include <talus/problem/problem.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace talus
{
  /// Source of a tsunami model: the change of the thickness of the soil since
  /// the start, by columns and at constant intervals of time, which is the
  /// change of the height of the sea floor. Written as dtopo, as netCDF if
  /// requested, and summed in a table; doc/tsunami.md explains the files.
  template <int dim>
  class TsunamiSource : public Observer<dim>
  {
  public:
    TsunamiSource(const Problem<dim>                &problem,
                  std::shared_ptr<const MapSettings> maps)
      : problem_(problem)
      , maps_(std::move(maps))
    {}

    bool
    is_enabled(const OutputSettings & /*settings*/) const override
    {
      return settings_.is_enabled();
    }

    void
    check(const State<dim> &state) const override;

    void
    begin(const OutputSettings &settings,
          const State<dim>     &state,
          Beginning             beginning) override;

    void
    start(const State<dim> &state) override;

    /// Take all blocks that the step has reached. Block k belongs to the first
    /// state at or after the time k times 'Interval'.
    void
    follow(const State<dim> &state) override;

    /// Write the files. The last block is the current state.
    void
    observe(const State<dim> &state) override;

    void
    list_state(StateList &list) override;

    void
    sync() override;

  private:
    /// State of the soil at the time of a block. Volumes are those of the slide
    /// in 3-D, and areas of the section, m^2, in 2-D.
    struct Block
    {
      /// Changed columns, with the change of the thickness since the start, m.
      std::vector<std::pair<unsigned int, double>> change;

      double                 volume = 0; ///< volume of all points, m^dim
      double                 mass   = 0; ///< kg
      dealii::Tensor<1, dim> momentum;   ///< kg m/s
    };

    MapAxes<dim>
    axes(const State<dim> &state) const;
    std::string
    coordinate_system() const;
    Raster
    frame() const;
    Block
    block(const State<dim> &state);
    SurfaceMotion
    motion() const;
    void
    write_table();
    std::vector<double>
    row_of_table(unsigned int k) const;
    std::vector<double>
    changes() const;
    void
    restore_changes(const std::vector<double> &rows);
    std::vector<double>
    sums_of_blocks() const;
    void
    restore_sums(const std::vector<double> &rows);

    const Problem<dim>                &problem_;
    std::shared_ptr<const MapSettings> maps_;
    TsunamiSettings                    settings_;
    std::filesystem::path              folder_;
    MapAxes<dim>                       axes_;
    std::unique_ptr<ColumnSums<dim>>   sums_;
    unsigned int                       n_blocks_ = 0; ///< on all ranks
    unsigned long                      step_of_last_block_ = 0;
    bool                               writes_ = false; ///< on the first rank

    // On the first rank only
    std::vector<std::pair<unsigned int, double>> thickness_at_start_; ///< m
    std::vector<Block>                           blocks_;
    double                                       gravity_ = 0; ///< m/s^2
  };
} // namespace talus

#endif
