// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_profile_h
#define talus_observers_profile_h

#include <talus/contact/ground.h>
#include <talus/observers/table_observer.h>

#include <vector>

namespace talus
{
  /// Soil in a column of cells of size h (`Grid/Cell size`).
  struct ProfileColumn
  {
    double x;         ///< centre of the column, m
    double z;         ///< centre of the column, m; 0 in 2-D
    double ground;    ///< height of the ground below the soil, m
    double lowest;    ///< bottom of the lowest box, m
    double highest;   ///< top of the highest box, m
    double thickness; ///< volume of soil per plan area of the column, m
    double mass;      ///< mass of soil in the column, kg
    /// Mass-weighted mean velocity of the soil along x and z, m/s.
    double velocity_x;
    double velocity_z;
  };



  /// Return the columns with soil, sorted by x (then z). A point contributes
  /// volume, mass and momentum to each column by the fraction of the box inside
  /// the column, see box_lengths(). Soil outside the mesh is assigned to the
  /// outermost columns. Collective; the result is valid on the first rank only.
  template <int dim>
  std::vector<ProfileColumn>
  find_profile(const State<dim> &state, const Ground<dim> &ground);



  /// Table profile.csv: for each output time, a row per column of cells (of
  /// size h) with soil.
  template <int dim>
  class Profile : public TableObserver<dim>
  {
  public:
    /// @p obstacles may belong to the ground and must outlive the observer;
    /// null for no obstacles.
    explicit Profile(const Obstacles<dim> *obstacles = nullptr)
      : TableObserver<dim>(file_name)
      , obstacles_(obstacles)
    {}

    bool
    is_enabled(const OutputSettings &settings) const override
    {
      return settings.write_runout;
    }

    /// Append the rows of the current output time.
    void
    observe(const State<dim> &state) override;

    static constexpr const char *file_name = "profile.csv";

  private:
    std::vector<std::string>
    columns(const OutputSettings &settings,
            const State<dim>     &state) const override;

    const Obstacles<dim> *obstacles_;
  };
} // namespace talus

#endif
