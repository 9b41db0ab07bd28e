// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/points/points_kernel.h>
#include <talus/problem/geostatic.h>
#include <talus/transfer/box_rule.h>

#include <boost/serialization/array.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Undeformed box of a point, by centre and lengths, m, and the density for
    /// the weight, kg/m^3.
    template <int dim>
    struct Brick
    {
      std::array<double, dim> centre, length;
      double                  density;

      /// Order independent of the distribution to ranks.
      bool
      operator<(const Brick &other) const
      {
        return centre < other.centre;
      }

      /// Serialization for messages between ranks.
      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &centre &length &density;
      }
    };



    /// Return the brick at the initial place with the reference lengths: soil
    /// without displacement.
    template <int dim>
    Brick<dim>
    brick_of(const Points<dim>         &points,
             const unsigned int         p,
             const std::vector<double> &weight_density)
    {
      Brick<dim> brick;
      const auto length = reference_lengths(points, p);
      for (unsigned int d = 0; d < dim; ++d)
        {
          brick.centre[d] = points.data(points.initial_position, d)[p];
          brick.length[d] = length[d];
        }
      brick.density = weight_density[points.data(points.body)[p]];
      return brick;
    }



    /// Bricks sorted into columns as wide as the widest brick: everything above
    /// a brick is in the same or an adjacent column.
    template <int dim>
    class SoilColumns
    {
    public:
      // A sum visits three (nine) columns, not all bricks. Bricks are sorted
      // within a column, to make sums independent of the ranks.
      explicit SoilColumns(const std::vector<Brick<dim>> &bricks)
      {
        for (const auto &brick : bricks)
          for (unsigned int d = 0; d < dim; ++d)
            if (d != 1)
              width_ = std::max(width_, brick.length[d]);
        for (const auto &brick : bricks)
          columns_[place(brick)].push_back(brick);
        for (auto &column : columns_)
          std::sort(column.second.begin(), column.second.end());
      }

      /// Return the mass per area, kg/m^2, above the centre of @p brick,
      /// including the upper half of the brick: the mean over the width.
      double
      mass_above(const Brick<dim> &brick) const
      {
        double     mass = 0;
        const auto at   = place(brick);
        for (long i = -1; i <= 1; ++i)
          for (long k = (dim == 3 ? -1 : 0); k <= (dim == 3 ? 1 : 0); ++k)
            {
              const auto column = columns_.find({{at[0] + i, at[1] + k}});
              if (column != columns_.end())
                for (const auto &other : column->second)
                  mass += mass_above(brick, other);
            }
        return mass;
      }

    private:
      using Place = std::array<long, 2>;

      /// Return the column at the centre of the brick.
      Place
      place(const Brick<dim> &brick) const
      {
        const auto index = [&](const unsigned int d) {
          return std::lround(std::floor(brick.centre[d] / width_));
        };
        return {{index(0), dim == 3 ? index(dim - 1) : 0}};
      }

      /// Return the mass of @p other above the centre of @p brick, per area of
      /// @p brick, kg/m^2.
      static double
      mass_above(const Brick<dim> &brick, const Brick<dim> &other)
      {
        // Vertical part: nothing of bricks below, all of bricks above, a part
        // of bricks at the same height.
        const double top  = other.centre[1] + 0.5 * other.length[1];
        double       mass = other.density *
                      std::clamp(top - brick.centre[1], 0., other.length[1]);
        for (unsigned int d = 0; d < dim; ++d)
          if (d != 1)
            {
              const double distance =
                std::abs(brick.centre[d] - other.centre[d]);
              // Horizontal part: fraction of the width of @p brick covered by
              // @p other.
              const double common =
                0.5 * (brick.length[d] + other.length[d]) - distance;
              mass *= std::clamp(common,
                                 0.,
                                 std::min(brick.length[d], other.length[d])) /
                      brick.length[d];
            }
        return mass;
      }

      double                                   width_ = 0;
      std::map<Place, std::vector<Brick<dim>>> columns_;
    };
  } // namespace



  /// The ends of the boxes count, not the ends of the shape of the body: boxes
  /// of one size then have nodal forces that vanish to round-off
  /// (doc/method.md, section 11). Soil above a point may be on any rank, and
  /// all ranks get all bricks: 2 dim + 1 doubles per point of the run, once at
  /// the start. Collective.
  template <int dim>
  std::vector<double>
  overburden(const Points<dim>         &points,
             const std::vector<double> &weight_density,
             const MPI_Comm             communicator)
  {
    std::vector<Brick<dim>> own, bricks;
    for (unsigned int p = 0; p < points.size(); ++p)
      own.push_back(brick_of(points, p, weight_density));
    for (const auto &part : Utilities::MPI::all_gather(communicator, own))
      bricks.insert(bricks.end(), part.begin(), part.end());
    const SoilColumns<dim> columns(bricks);
    std::vector<double>    result(points.size());
    for (unsigned int p = 0; p < points.size(); ++p)
      result[p] = columns.mass_above(own[p]);
    return result;
  }



  namespace
  {
    template <int dim>
    Tensor<1, dim>
    normal_of_layers(const Points<dim> &points,
                     const unsigned int p,
                     const Ground<dim> &ground)
    {
      if (!ground.is_bottom_face())
        return ground.layer_normal(
          load_place(points, points.initial_position, p));
      Tensor<1, dim> normal;
      normal[1] = 1.;
      return normal;
    }
  } // namespace



  template <int dim>
  std::vector<double>
  normal_stress_at_rest(const Points<dim>         &points,
                        const std::vector<double> &weight_density,
                        const Tensor<1, dim>      &gravity,
                        const Ground<dim>         &ground,
                        const MPI_Comm             communicator)
  {
    auto result = overburden(points, weight_density, communicator);
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const Tensor<1, dim> normal = normal_of_layers(points, p, ground);
        result[p] *= -normal[1] * (gravity * normal);
      }
    return result;
  }



  namespace
  {
    /// Check the prerequisites of K0 stress: undeformed ground, and gravity.
    template <int dim>
    void
    check(const std::vector<std::unique_ptr<Body<dim>>> &bodies,
          const std::string                             &name,
          const Tensor<1, dim>                          &gravity)
    {
      for (const auto &body : bodies)
        AssertThrow(!body->initial_state().is_displaced(),
                    ExcUser("'Bodies/" + name + "/K0' is given, but 'Bodies/" +
                            body->name() +
                            "/Initial displacement', too, and the weight above "
                            "a point is taken without displacement. Remove one "
                            "of the two."));
      AssertThrow(
        gravity.norm() > 0.,
        ExcUser("'Bodies/" + name +
                "/K0' is given, but there is no gravity at t = 0, and the "
                "soil has no weight. Set 'Gravity/Ramp time' to 0 and "
                "'Gravity/Magnitude' to more than 0, or remove the entry."));
    }



    /// Effective stress of an infinite slope with y across the layer
    /// (doc/method.md, section 11): sigma_yy = g_y M + u, sigma_xx = sigma_zz =
    /// K0 sigma_yy, sigma_xy = g_x M, with the excess pore pressure u, Pa.
    template <int dim>
    Stress<dim, double>
    stress_at_rest(const double          mass_above,
                   const double          K0,
                   const double          u,
                   const Tensor<1, dim> &gravity)
    {
      Stress<dim, double> sigma{};
      sigma[1] = gravity[1] * mass_above + u;
      sigma[0] = sigma[2]            = K0 * sigma[1];
      sigma[stress_index<dim>(0, 1)] = gravity[0] * mass_above;
      return sigma;
    }



    /// Effective stress in layers with the unit @p normal, from the mass per
    /// horizontal area, kg/m^2, and the excess pore pressure @p u, Pa.
    template <int dim>
    Stress<dim, double>
    stress_at_rest(const double          mass_above,
                   const double          K0,
                   const double          u,
                   const Tensor<1, dim> &gravity,
                   const Tensor<1, dim> &normal)
    {
      // Per area of the layer, 1/n_y times the horizontal area.
      const double         mass   = mass_above * normal[1];
      const double         total  = mass * (gravity * normal);
      const double         across = total + u;
      const Tensor<1, dim> along  = mass * gravity - total * normal;
      Stress<dim, double>  sigma{};
      sigma[2] = K0 * across; // out of the plane in 2-D
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          sigma[stress_index<dim>(i, j)] =
            (i == j ? K0 * across : 0.) +
            (1. - K0) * across * normal[i] * normal[j] + along[i] * normal[j] +
            normal[i] * along[j];
      return sigma;
    }



    /// Return a note, not an error: the first step returns the stress to the
    /// yield surface, but the soil starts out of balance.
    Remark
    note_of_yielding(const std::string &name,
                     const double       n_points,
                     const double       ratio)
    {
      return {text("the K0 stress is more than the soil bears at ",
                   counted(n_points, "point"),
                   ": the shear stress is up to ",
                   std::setprecision(6),
                   ratio,
                   " times the strength. The first steps return the stress to "
                   "the strength, and the body starts to move. A slope at "
                   "rest needs more strength or a 'Bodies/",
                   name,
                   "/K0' closer to 1."),
              Severity::look,
              "body '" + name + "'"};
    }
  } // namespace



  /// The mass above the points, of all bodies, is computed once for all bodies
  /// with K0. Collective, also for ranks without points.
  template <int dim>
  void
  set_geostatic_stress(Points<dim>                                   &points,
                       const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                       const Materials<dim>                          &materials,
                       const Tensor<1, dim>                          &gravity,
                       const Ground<dim>                             &ground,
                       const MPI_Comm communicator)
  {
    std::vector<double> density, mass_above;
    bool                is_first = true;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      density.push_back(materials.of_body(b).submerged_density());
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const InitialState<dim> &initial = bodies[b]->initial_state();
        if (!initial.has_stress_at_rest())
          continue;
        check(bodies, bodies[b]->name(), gravity);
        if (is_first)
          mass_above = overburden(points, density, communicator);
        is_first = false;
        for (unsigned int p = 0; p < points.size(); ++p)
          if (points.data(points.body)[p] == b)
            {
              const double u = points.have_pore_pressure()
                                 ? points.data(points.pore_pressure())[p]
                                 : 0.;
              const auto   sigma =
                ground.is_bottom_face()
                    ? stress_at_rest(mass_above[p], initial.K0(), u, gravity)
                    : stress_at_rest(mass_above[p],
                                   initial.K0(),
                                   u,
                                   gravity,
                                   normal_of_layers(points, p, ground));
              store_stress<dim, double>(points, p, sigma);
            }
      }
  }



  template <int dim>
  std::vector<Remark>
  notes_on_stress_at_rest(const Points<dim>                             &points,
                          const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                          const Materials<dim> &materials,
                          const MPI_Comm        communicator)
  {
    std::vector<Remark> notes;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        if (!bodies[b]->initial_state().has_stress_at_rest())
          continue;
        double n_yielding = 0, largest = 0;
        for (unsigned int p = 0; p < points.size(); ++p)
          if (points.data(points.body)[p] == b)
            {
              const double ratio =
                shear_stress(load_stress<dim, double>(points, p)) /
                materials.of_body(b).shear_strength(points, p);
              n_yielding += (ratio > 1. + 1e-9);
              largest = std::max(largest, ratio);
            }
        n_yielding = Utilities::MPI::sum(n_yielding, communicator);
        largest    = Utilities::MPI::max(largest, communicator);
        if (n_yielding > 0)
          notes.push_back(
            note_of_yielding(bodies[b]->name(), n_yielding, largest));
      }
    return notes;
  }



  template <int dim>
  std::vector<Remark>
  notes_on_undrained_soil(const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                          const Materials<dim> &materials,
                          const bool            changes)
  {
    std::vector<Remark> notes;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        const WaterResponse<dim> water = materials.of_body(b).pore_water();
        if (water.stiffness == 0.)
          continue;
        const std::string body = "body '" + bodies[b]->name() + "'";
        if (changes)
          notes.emplace_back(
            text(std::setprecision(2),
                 "'Excess pore pressure/Final' is a pressure at constant "
                 "volume. Undrained soil swells and keeps about ",
                 100. * water.soil_bulk / (water.soil_bulk + water.stiffness),
                 " % of it. Let 'Pore water/Drainage' be drained while a "
                 "pressure from elsewhere rises."),
            Severity::look,
            body);
        if (bodies[b]->initial_state().has_stress())
          continue;
        notes.emplace_back("the soil is undrained and has no stress at the "
                           "start: water carries its weight, so that friction "
                           "in the soil, on seabed and obstacles has nearly "
                           "no effective stress. Soil at rest has 'Bodies/" +
                             bodies[b]->name() + "/K0'.",
                           Severity::look,
                           body);
      }
    return notes;
  }



  template decltype(overburden<2>)              overburden<2>;
  template decltype(overburden<3>)              overburden<3>;
  template decltype(normal_stress_at_rest<2>)   normal_stress_at_rest<2>;
  template decltype(normal_stress_at_rest<3>)   normal_stress_at_rest<3>;
  template decltype(set_geostatic_stress<2>)    set_geostatic_stress<2>;
  template decltype(set_geostatic_stress<3>)    set_geostatic_stress<3>;
  template decltype(notes_on_stress_at_rest<2>) notes_on_stress_at_rest<2>;
  template decltype(notes_on_stress_at_rest<3>) notes_on_stress_at_rest<3>;
  template decltype(notes_on_undrained_soil<2>) notes_on_undrained_soil<2>;
  template decltype(notes_on_undrained_soil<3>) notes_on_undrained_soil<3>;
} // namespace talus
