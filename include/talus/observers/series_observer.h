// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_series_observer_h
#define talus_observers_series_observer_h

#include <talus/io/series.h>
#include <talus/observers/observer.h>

#include <string>

namespace talus
{
  /// Observer with a series of VTU files. A derived class provides the content.
  template <int dim>
  class SeriesObserver : public Observer<dim>
  {
  public:
    /// @p name of the series.
    explicit SeriesObserver(const std::string &name)
      : name_(name)
    {}

    void
    begin(const OutputSettings &settings,
          const State<dim>     &state,
          const Beginning       beginning = Beginning::fresh) override
    {
      series_.begin(settings.folder, name_, state.communicator(), beginning);
    }

    void
    list_state(StateList &list) override
    {
      series_.list_state("files of " + name_, list);
    }

    std::vector<std::string>
    missing_files(const OutputSettings &settings) const override
    {
      return series_.missing_files(settings.folder, name_);
    }

    void
    sync() override
    {
      series_.sync();
    }

  protected:
    FieldSeries series_;

  private:
    std::string name_;
  };
} // namespace talus

#endif
