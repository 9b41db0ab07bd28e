// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_points_output_h
#define talus_observers_points_output_h

#include <talus/observers/series_observer.h>

#include <string>
#include <vector>

namespace talus
{
  /// Fields of the points for ParaView: every column by name and unit, and the
  /// derived displacement, speed, mean and von Mises stress, volume ratio J and
  /// current length of the boxes.
  ///
  /// Tensors are 3x3 (in 2-D with the out-of-plane stress, and with 1 for the
  /// deformation gradient); a list of scalars gives a field per number. The
  /// points must outlive the fields.
  template <int dim>
  std::vector<Field>
  point_fields(const State<dim> &state);



  /// Series of files "points": each point as a vertex, or as a quad (hex) of
  /// the size of the box, so that ParaView shows a continuum. Boxes are limited
  /// to the length allowed by the weights, see box_edges(). Values are stored
  /// at vertices, or at cells for boxes.
  template <int dim>
  class PointsOutput : public SeriesObserver<dim>
  {
  public:
    /// @p name of the series.
    explicit PointsOutput(const std::string &name = "points")
      : SeriesObserver<dim>(name)
    {}

    bool
    is_enabled(const OutputSettings &settings) const override
    {
      return settings.write_points;
    }

    void
    begin(const OutputSettings &settings,
          const State<dim>     &state,
          const Beginning       beginning = Beginning::fresh) override
    {
      SeriesObserver<dim>::begin(settings, state, beginning);
      boxes_as_cells_ = settings.boxes_as_cells;
    }

    /// Add a field to the files of each output time. Such a field may need
    /// more than the state.
    void
    add_field(const Field &field)
    {
      further_fields_.push_back(field);
    }

    void
    observe(const State<dim> &state) override
    {
      write(state, further_fields_);
    }

    /// Write the files of an output time, with @p further_fields besides
    /// point_fields(). Collective. Throws ExcUser on failure.
    void
    write(const State<dim>         &state,
          const std::vector<Field> &further_fields = {});

  private:
    bool               boxes_as_cells_ = false;
    std::vector<Field> further_fields_;
  };



  /// Write the points of the local rank as vertices to the VTU file @p path.
  /// The points need not be sorted, and values may be NaN.
  template <int dim>
  void
  write_points(const State<dim> &state, const std::filesystem::path &path);
} // namespace talus

#endif
