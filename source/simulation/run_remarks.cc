// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/base/errors.h>
#include <talus/simulation/run_remarks.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  // Share of the points that is told: a few points among thousands of
  // neighbours leave no gap.
  constexpr double told_share = 1e-3;

  // Square of speed over wave speed: the pressure of an impact, rho v^2/2, then
  // compresses soil by a tenth, the limit for the weight in
  // source/problem/stiffness.cc.
  constexpr double told_square = 0.2;

  // Nodes of less than a tenth of a cell of soil may be much faster than soil.
  constexpr double mass_over_cutoff = 1e8;



  template <int dim>
  void
  RunRemarks<dim>::observe(const State<dim> &state)
  {
    for (Row &row : rows_)
      if (!row.is_written)
        {
          const Remark found = row.reason(state);
          row.is_written     = !found.sentence.empty();
          if (row.is_written)
            log_.remark(found);
        }
  }



  template <int dim>
  void
  RunRemarks<dim>::list_state(StateList &list)
  {
    for (Row &row : rows_)
      list.add(row.name, "-", row.is_written, Reduction::equal);
  }



  template <int dim>
  Remark
  remark_on_split_limits(const State<dim> &state, const Splitter<dim> &splitter)
  {
    const UnsplitPoints unsplit =
      splitter.count_unsplit(state.points, state.grid);
    if (unsplit.at_generation_limit + unsplit.at_mesh_limit <=
        told_share *
          Utilities::MPI::sum(state.points.size(), state.communicator()))
      return "";
    std::string why;
    if (unsplit.at_generation_limit > 0)
      why = counted(unsplit.at_generation_limit, "point") +
            " reached 'Splitting/Maximum generation' (raise the limit). ";
    if (unsplit.at_mesh_limit > 0)
      why += counted(unsplit.at_mesh_limit, "point") +
             " would get children more than half a cell outside the mesh (use "
             "a larger mesh or smaller cells). ";
    return text("At t = ",
                state.time,
                " s soil is stretched too far without a split, so that it may "
                "tear: ",
                why,
                "The columns 'points at ... limit' of statistics.csv continue "
                "the count.");
  }



  // The contact area is 0 before the first step of a run, and there is no
  // footprint without ground.
  Remark
  remark_on_contact_area(const double time, const Quantities &areas)
  {
    TalusAssert(areas.size() == 2, ExcInternalError());
    const Quantity &area = areas[0], &footprint = areas[1];
    const double    ratio = area.value / footprint.value;
    if (area.value == 0 || footprint.value == 0 ||
        (ratio >= 0.95 && ratio <= 1.05))
      return "";
    return text(std::setprecision(4),
                "At t = ",
                time,
                " s the soil touches ",
                area.value,
                ' ',
                area.unit,
                " of the ",
                footprint.value,
                ' ',
                footprint.unit,
                " of ground below, a ratio of ",
                ratio,
                "; expected 0.95 to 1.05. Either soil is in the air, or "
                "friction acts on a wrong area: look at the fields, and "
                "compare with smaller cells.");
  }



  template <int dim>
  Remark
  remark_on_speed(const State<dim> &state, const Materials<dim> &materials)
  {
    const Points<dim> &points = state.points;
    double speed = 0., wave_speed = std::numeric_limits<double>::infinity();
    for (const unsigned int node : state.nodes.active_nodes())
      if (state.nodes.mass(node) >
          mass_over_cutoff * state.constants.mass_cutoff)
        speed = std::max(speed, state.nodes.velocity(node).norm());
    for (unsigned int p = 0; p < points.size(); ++p)
      if (const auto &law = materials.of_body(points.data(points.body)[p]);
          law.has_strength())
        wave_speed = std::min(wave_speed, law.wave_speed(points, p));
    speed               = Utilities::MPI::max(speed, state.communicator());
    wave_speed          = Utilities::MPI::min(wave_speed, state.communicator());
    const double square = std::pow(speed / wave_speed, 2);
    if (square <= told_square)
      return "";
    return text(std::setprecision(3),
                "At t = ",
                state.time,
                " s the soil is too soft for its speed of ",
                speed,
                " m/s: with waves of ",
                wave_speed,
                " m/s, (v/c)^2 is ",
                square,
                ", where at most ",
                told_square,
                " was expected, and impacts compress the soil. Make `Young's "
                "modulus` ",
                square / told_square,
                " times larger.");
  }



  template class RunRemarks<2>;
  template class RunRemarks<3>;

  template decltype(remark_on_speed<2>) remark_on_speed<2>;
  template decltype(remark_on_speed<3>) remark_on_speed<3>;

  template decltype(remark_on_split_limits<2>) remark_on_split_limits<2>;
  template decltype(remark_on_split_limits<3>) remark_on_split_limits<3>;
} // namespace talus
