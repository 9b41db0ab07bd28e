// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_envelope_observer_h
#define talus_maps_envelope_observer_h

#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/maps/envelope.h>
#include <talus/maps/map_settings.h>
#include <talus/observers/observer.h>
#include <talus/problem/problem.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Observer that samples the columns of a plan during the run and writes
  /// their envelope whenever fields are due. A derived class defines the
  /// columns and writes the files.
  template <int dim>
  class EnvelopeObserver : public Observer<dim>
  {
  public:
    /// @p name identifies the envelope in checkpoints.
    EnvelopeObserver(const std::string           &name,
                     Problem<dim>                &problem,
                     std::shared_ptr<MapSettings> settings)
      : name_(name)
      , problem_(problem)
      , settings_(std::move(settings))
    {}

    void
    begin(const OutputSettings &settings,
          const State<dim>     &state,
          Beginning             beginning) override;

    void
    start(const State<dim> &state) override
    {
      sample(state);
      if (is_first_rank(state.communicator()))
        envelope_->start(*sums_);
    }

    void
    follow(const State<dim> &state) override
    {
      const double size = std::pow(sums_->columns().area(), 1. / (dim - 1));
      if (!(state.max_path - path_at_sample_ <
            settings_->motion_between_samples() * size))
        sample(state);
    }

    void
    observe(const State<dim> &state) override
    {
      // The last files must show the final state.
      if (last_sample_ != state.step)
        sample(state);
      prepare_files(state);
      if (is_first_rank(state.communicator()))
        write_files(state);
    }

    /// Add the envelope to the state of the run if the observer is enabled.
    void
    list_state(StateList &list) override;

    void
    sync() override
    {
      for (const std::filesystem::path &path : written_)
        {
          const std::string error = sync_to_disk(path);
          AssertThrow(error.empty(), ExcUser(failed_write(path, error)));
        }
      written_.clear();
    }

  protected:
    const Envelope<dim> &
    envelope() const
    {
      return *envelope_;
    }

    const PlanColumns<dim> &
    columns() const
    {
      return sums_->columns();
    }

    const Problem<dim> &
    problem() const
    {
      return problem_;
    }

    const MapSettings &
    settings() const
    {
      return *settings_;
    }

    /// Return the path of file @p name in the output folder, and remember the
    /// file for sync(). The caller writes the file now.
    std::filesystem::path
    path_of_output(const std::filesystem::path &name)
    {
      written_.push_back(folder_ / name);
      return written_.back();
    }

  private:
    virtual std::shared_ptr<const PlanColumns<dim>>
    make_columns(const State<dim> &state) const = 0;

    virtual ImpactFormula
    impact() const
    {
      return {};
    }

    /// Collect further data for the files. Collective.
    virtual void
    prepare_files(const State<dim> & /*state*/)
    {}

    /// Write the envelope to files. Called on the first rank only.
    virtual void
    write_files(const State<dim> &state) = 0;

    void
    sample(const State<dim> &state);

    std::string                        name_;
    Problem<dim>                      &problem_;
    std::shared_ptr<MapSettings>       settings_;
    std::filesystem::path              folder_;
    std::unique_ptr<ColumnSums<dim>>   sums_;
    std::unique_ptr<Envelope<dim>>     envelope_;
    std::vector<double>                restored_; ///< rows of a checkpoint
    unsigned long                      last_sample_    = 0; ///< step
    double                             path_at_sample_ = 0; ///< max_path, m
    std::vector<std::filesystem::path> written_;            ///< not synced
  };
} // namespace talus

#endif
