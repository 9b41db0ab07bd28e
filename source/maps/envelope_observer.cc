// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/maps/bed_shear.h>
#include <talus/maps/envelope_observer.h>

namespace talus
{
  using namespace dealii;

  template <int dim>
  EnvelopeObserver<dim>::EnvelopeObserver(const std::string           &name,
                                          Problem<dim>                &problem,
                                          std::shared_ptr<MapSettings> settings)
    : name_(name)
    , problem_(problem)
    , settings_(std::move(settings))
  {}



  /// Make columns and envelope. A checkpoint is read before the mesh exists, so
  /// restored rows wait until columns are known.
  template <int dim>
  void
  EnvelopeObserver<dim>::begin(const OutputSettings &settings,
                               const State<dim>     &state,
                               const Beginning /*beginning*/)
  {
    const double h = state.grid.cell_size();
    folder_        = settings.folder;
    sums_          = std::make_unique<ColumnSums<dim>>(make_columns(state));
    envelope_      = std::make_unique<Envelope<dim>>(
      sums_->columns().size(),
      typename Envelope<dim>::Settings{settings_->smallest_thickness(h),
                                       settings_->arrival_thresholds(h),
                                       impact()});
    if (is_first_rank(state.communicator()))
      envelope_->restore(restored_);
    restored_.clear();
  }



  template <int dim>
  void
  EnvelopeObserver<dim>::start(const State<dim> &state)
  {
    sample(state);
    if (is_first_rank(state.communicator()))
      envelope_->start(*sums_);
  }



  template <int dim>
  void
  EnvelopeObserver<dim>::follow(const State<dim> &state)
  {
    if (state.step % settings_->steps_between_samples() == 0)
      sample(state);
  }



  /// Add the soil of @p state to the envelope. Collective.
  template <int dim>
  void
  EnvelopeObserver<dim>::sample(const State<dim> &state)
  {
    last_sample_ = state.step;
    sums_->sum_soil(state, impact().is_used() ? &problem_.materials : nullptr);
    add_bed_shear(state, problem_.contact, problem_.boundaries, *sums_);
    sums_->sum_over_ranks(state.communicator());
    if (is_first_rank(state.communicator()))
      envelope_->add(*sums_, state.time);
  }



  /// The last files must show the final state.
  template <int dim>
  void
  EnvelopeObserver<dim>::observe(const State<dim> &state)
  {
    if (last_sample_ != state.step)
      sample(state);
    if (is_first_rank(state.communicator()))
      write_files(state);
  }



  template <int dim>
  void
  EnvelopeObserver<dim>::list_state(StateList &list)
  {
    if (!this->is_enabled(OutputSettings()))
      return;
    const unsigned int n_columns =
      Envelope<dim>::n_numbers(settings_->n_arrival_thresholds());
    list.add_table(
      {name_,
       "column, thickness [m], mass [kg/m^2], thickness at start [m]; value "
       "and time of the "
       "maxima of thickness, speed, momentum flux, bed shear stress, impact "
       "pressure; times of arrival; SI units",
       n_columns,
       [this]() {
         return envelope_ ? envelope_->save() : std::vector<double>();
       },
       [this](const std::vector<double> &rows) { restored_ = rows; }});
  }



  template <int dim>
  std::filesystem::path
  EnvelopeObserver<dim>::path_of_output(const std::filesystem::path &name)
  {
    written_.push_back(folder_ / name);
    return written_.back();
  }



  template <int dim>
  void
  EnvelopeObserver<dim>::sync()
  {
    for (const std::filesystem::path &path : written_)
      {
        const std::string error = sync_to_disk(path);
        AssertThrow(error.empty(), ExcUser(failed_write(path, error)));
      }
    written_.clear();
  }



  template class EnvelopeObserver<2>;
  template class EnvelopeObserver<3>;
} // namespace talus
