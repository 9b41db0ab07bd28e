// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_profile_h
#define talus_observers_profile_h

#include <talus/contact/ground.h>
#include <talus/observers/table_observer.h>

#include <vector>

namespace talus
{
  /// The soil in one column of cells of size h (`Grid/Cell size`).
  struct ProfileColumn
  {
    double x;         ///< of the column's centre, m
    double z;         ///< of the column's centre, m; 0 in 2-D
    double ground;    ///< height of the ground below the soil, m
    double lowest;    ///< lower edge of the lowest box, m
    double highest;   ///< upper edge of the highest box, m
    double thickness; ///< volume of the soil over the column's area, m
    double mass;      ///< kg
    /// Mass-weighted mean of the points' velocities along x and z, m/s.
    double velocity_x;
    double velocity_z;
  };



  /// The columns with soil, by growing x (then z). Each column has of a point
  /// the share of its box, see box_lengths(), that lies in the column: volume,
  /// mass and momentum. What is outside the mesh counts to the outermost
  /// columns. Collective, the result is on the first rank.
  template <int dim>
  std::vector<ProfileColumn>
  find_profile(const State<dim> &state, const Ground<dim> &ground);



  /// profile.csv: for each output time, one row per column of the mesh (of
  /// size h) with points.
  template <int dim>
  class Profile : public TableObserver<dim>
  {
  public:
    /// @p obstacles that belong to the ground, null for none, must outlive it.
    explicit Profile(const Obstacles<dim> *obstacles = nullptr);

    bool
    is_enabled(const OutputSettings &settings) const override
    {
      return settings.write_runout;
    }

    /// Append the rows of one output time.
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
