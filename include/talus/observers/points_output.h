// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_points_output_h
#define talus_observers_points_output_h

#include <talus/observers/series_observer.h>

#include <string>
#include <vector>

namespace talus
{
  /// What ParaView gets to see of the points: every column by its name and
  /// unit, and derived from them the displacement, speed, mean and von Mises
  /// stress, volume ratio J and current length of the boxes.
  ///
  /// Tensors are 3x3 (in 2-D with the stress out of the plane, 1 for the
  /// deformation gradient), a list of scalars is one field per number. The
  /// points must outlive the fields.
  template <int dim>
  std::vector<Field>
  point_fields(const State<dim> &state);



  /// The series of files called points: each point as a vertex, or its box as a
  /// quad (hex), so that ParaView shows a continuum. Boxes are as long as the
  /// weights let them be; see box_edges(). The values of a point are at its
  /// vertex or at the cell that is its box.
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
          Beginning             beginning = Beginning::fresh) override;

    void
    observe(const State<dim> &state) override
    {
      write(state);
    }

    /// Write the files of one output time, with these fields besides
    /// point_fields(); collective. Throws ExcUser if that fails.
    void
    write(const State<dim>         &state,
          const std::vector<Field> &further_fields = {});

  private:
    bool boxes_as_cells_ = false;
  };



  /// Write the points of this rank, as vertices, to the VTU file @p path. They
  /// need not be sorted, nor their values be numbers.
  template <int dim>
  void
  write_points(const State<dim> &state, const std::filesystem::path &path);
} // namespace talus

#endif
