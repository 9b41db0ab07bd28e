// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_runout_h
#define talus_maps_runout_h

#include <talus/maps/column_sums.h>
#include <talus/maps/plan_path.h>
#include <talus/observers/table_observer.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Parameters of runout.csv, section Runout.
  class RunoutSettings : public dealii::ParameterAcceptor
  {
  public:
    RunoutSettings();

    /// Return the corners of the path given by the user, in plan coordinates of
    /// the mesh, m; empty if the path of the centre of mass is used. Throws
    /// ExcUser.
    ///
    /// @param dim dimension of the simulation
    /// @param origin of the mesh on the map, m
    std::vector<dealii::Point<2>>
    corners(unsigned int dim, const dealii::Point<3> &origin) const;

    /// Minimum thickness of soil that counts, m, on a mesh with cells of @p h,
    /// m.
    double
    smallest_thickness(const double h) const
    {
      return smallest_thickness_ > 0. ? smallest_thickness_ : 0.1 * h;
    }

  private:
    std::string path_               = "";
    std::string coordinates_        = "mesh";
    double      smallest_thickness_ = 0.;
  };



  /// Table runout.csv: position of the slide along a path in plan, a row
  /// whenever a row of the statistics is due.
  ///
  /// The path is a polyline of the user, or the path of the centre of mass so
  /// far, from the start of the motion until more than 1 % of the soil has left
  /// the mesh. Front and rear are the outermost
  /// columns, one cell wide, with soil thicker than `Runout/Smallest
  /// thickness`; runout is the distance of the front from the front at the
  /// start, both measured along the current path.
  template <int dim>
  class Runout : public TableObserver<dim>
  {
  public:
    /// @p origin of the mesh on the map, m, must outlive the observer.
    explicit Runout(const dealii::Point<3> &origin)
      : TableObserver<dim>("runout.csv")
      , origin_(origin)
    {}

    bool
    is_enabled(const OutputSettings &settings) const override
    {
      return settings.write_runout;
    }

    void
    check(const State<dim> & /*state*/) const override
    {
      settings_.corners(dim, origin_);
    }

    void
    begin(const OutputSettings &settings,
          const State<dim>     &state,
          Beginning             beginning) override;

    /// Append front and rear along x (and z) of the soil in columns thicker
    /// than `Runout/Smallest thickness`, m: edges of boxes, within the
    /// outermost columns. NaN without thick soil. Collective.
    void
    list_thick_soil(const State<dim> &state, Quantities &list);

    /// Record the columns with soil, and the first corner of the path.
    void
    start(const State<dim> &state) override;

    void
    observe(const State<dim> &state) override;

    void
    list_state(StateList &list) override;

  private:
    struct Centre
    {
      dealii::Point<2> place; ///< in plan, m
      double           speed; ///< in plan, m/s
      double           mass;  ///< kg
    };

    std::vector<std::string>
    columns(const OutputSettings &settings,
            const State<dim>     &state) const override;
    dealii::Point<2>
    in_plan(const dealii::Point<dim> &x) const
    {
      return dim == 2 ? dealii::Point<2>(x[0], 0.)
                      : dealii::Point<2>(x[0], x[dim - 1]);
    }
    void
    make_sums(const State<dim> &state);
    void
    sum_columns(const State<dim> &state);
    Box<dim>
    thick_columns(const State<dim> &state) const;
    Centre
    centre_of_mass(const State<dim> &state) const;
    bool
    has_way_ended(const Centre &centre) const;
    void
    extend_way(const Centre &centre, double h);
    std::vector<dealii::Point<2>>
    way_until(const Centre &centre, double h) const;
    std::vector<double>
    row(const State<dim> &state, const Centre &centre) const;

    const dealii::Point<3>          &origin_;
    RunoutSettings                   settings_;
    std::unique_ptr<ColumnSums<dim>> sums_;
    std::vector<dealii::Point<2>>    user_path_; ///< m; may be empty
    std::vector<dealii::Point<2>>    way_; ///< path of the centre of mass, m
    std::vector<unsigned int>        release_; ///< columns, on the first rank
    double                           mass_at_start_ = 0; ///< kg
  };
} // namespace talus

#endif
