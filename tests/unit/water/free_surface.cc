// SPDX-License-Identifier: LGPL-2.1-or-later
#include "obstacles_setup.h"
#include "ranks_setup.h"
#include "suites.h"

#include <talus/water/free_surface.h>
#include <talus/water/water.h>

#include <functional>

namespace Utilities = dealii::Utilities;

namespace
{
  TALUS_ALSO_ON_RANKS(FreeSurfaceOfSoil, 2, 3);

  /// Soil wherever @p is_soil is, by points in distances of half a cell.
  template <int dim>
  struct Soil : Core<dim>
  {
    using Region = std::function<bool(const Point<dim> &)>;

    Soil(const std::string &parameters,
         const Region      &is_soil,
         const std::initializer_list<std::pair<std::string, std::string>>
           &sections = {})
      : Core<dim>(parameters)
      , with(sections)
      , contact(with.obstacles, this->boundaries)
      , is_soil_(is_soil)
    {
      contact.prepare(this->grid);
      surface.prepare(this->grid);
    }

    /// Find the surface of the soil, with the points shifted by @p shift, m.
    void
    find(const Tensor<1, dim> &shift = Tensor<1, dim>())
    {
      this->points.clear();
      const double         size   = 0.5 * this->grid.finest_size();
      const Box<dim>      &domain = this->grid.domain();
      Tensor<1, dim>       length;
      std::array<int, dim> n;
      int                  n_places = 1;
      for (unsigned int d = 0; d < dim; ++d)
        {
          length[d] = size;
          n[d]      = std::lround(domain.length(d) / size);
          n_places *= n[d];
        }
      for (int i = 0; i < n_places; ++i)
        {
          Point<dim> x = domain.lower;
          for (int d = 0, rest = i; d < dim; rest /= n[d], ++d)
            x[d] += (rest % n[d] + 0.5) * size;
          const Point<dim> now = x + shift;
          if (!is_soil_(x) || !domain.contains(now) ||
              !(this->grid.find_cell(now) < this->grid.n_owned_cells()))
            continue;
          const unsigned int p                    = this->add(now, length);
          this->points.data(this->points.mass)[p] = 1600. * std::pow(size, dim);
          this->set(this->points.velocity, p, velocity(now));
        }
      this->sort();
      this->scatter();
      this->nodes.update_momentum(0., 0.);
      contact.find_soil(*this);
      surface.find(*this, contact);
      surface.update_soil(*this);
    }

    double
    area() const
    {
      double result = 0;
      for (const SurfaceFacet<dim> &facet : surface.facets())
        result += facet.vector_area * facet.normal;
      return Utilities::MPI::sum(result, this->grid.communicator());
    }

    Tensor<1, dim>
    vector_area() const
    {
      Tensor<1, dim> result;
      for (unsigned int c = 0; c < this->grid.n_owned_cells(); ++c)
        result += surface.vector_area_of_cell(c);
      return Utilities::MPI::sum(result, this->grid.communicator());
    }

    /// Mean height of the surface over each column of cells in the section
    /// nearest to the origin, by the x of its centre, m. On one rank all, else
    /// those of this rank.
    std::map<double, double>
    mean_heights() const
    {
      std::map<double, double> area, moment;
      for (const Cell<dim> &cell : this->grid.cells())
        if (dim == 2 || cell.lower[dim - 1] == 0.)
          {
            const double x = cell.lower[0] + 0.5 * cell.size;
            const double a =
              surface.vector_area_of_cell(&cell - this->grid.cells().data())[1];
            area[x] += a;
            moment[x] += a * (cell.lower[1] + 0.5 * cell.size);
          }
      std::map<double, double> result;
      if (Utilities::MPI::n_mpi_processes(this->grid.communicator()) == 1)
        for (const auto &[x, a] : area)
          result[x] = moment[x] / a;
      return result;
    }

    WithObstacles<dim> with;
    Contact<dim>       contact;
    FreeSurface<dim>   surface;
    /// Velocity of the points, m/s.
    std::function<Tensor<1, dim>(const Point<dim> &)> velocity =
      [](const Point<dim> &) { return Tensor<1, dim>(); };

  private:
    Region is_soil_;
  };



  const std::string paper_mesh =
    "subsection Grid\nset Lower corner = -4, 0\nset Upper corner = 56, 8\n"
    "set Cell size = 0.2\nend\n";

  bool
  is_in_trapezoid(const Point<2> &x)
  {
    const double along = x[1] * 8.66 / 5.;
    return x[1] < 5. && x[0] > along && x[0] < 48.66 - along;
  }
} // namespace



// The front and the rear of the paper's trapezoid are sqrt(8.66^2 + 5^2) m
// long, its crest is 31.34 m. Its outline is closed: what the free surface
// lacks is the base.
TEST(FreeSurfaceOfSoil, PapersTrapezoid)
{
  Soil<2> soil(paper_mesh, is_in_trapezoid);
  soil.find();
  const double exact = 31.34 + 2. * std::hypot(8.66, 5.);
  EXPECT_NEAR(soil.area(), exact, 0.02 * exact);

  double base = 0;
  for (unsigned int node = 0; node < soil.grid.n_owned_nodes(); ++node)
    if (soil.grid.faces_of_node(node) & (1u << 2))
      base +=
        soil.grid.face_share(2, node).area * soil.surface.covered_share(node);
  base = Utilities::MPI::sum(base, soil.grid.communicator());
  EXPECT_NEAR(soil.vector_area()[0], 0., 1e-12 * exact);
  EXPECT_NEAR(soil.vector_area()[1], base, 1e-12 * exact);
  EXPECT_NEAR(base, 48.66, 0.3);
}



// Level soil from wall to wall: the mean height of the free surface is that of
// the soil, wherever in a cell that is, and its vector area is the ground's.
template <int dim>
void
expect_level()
{
  for (const double height : {0., 0.13, 0.25, 0.5, 0.6})
    {
      Soil<dim>      soil(slab<dim>(),
                     [](const Point<dim> &x) { return x[1] < 2.5; });
      Tensor<1, dim> shift;
      shift[1] = -height;
      soil.find(shift);
      EXPECT_NEAR(soil.vector_area()[1], dim == 2 ? 6. : 12., 1e-12);
      EXPECT_NEAR(soil.area(), dim == 2 ? 6. : 12., 1e-12);
      for (const auto &column : soil.mean_heights())
        EXPECT_NEAR(column.second, 2.5 - height, 0.01);
    }
}



TEST(FreeSurfaceOfSoil, LevelSoil)
{
  expect_level<2>();
  expect_level<3>();
}



// A ball of soil in the water has a closed surface.
TEST(FreeSurfaceOfSoil, BallIsClosed)
{
  Soil<2> disc(slab<2>() + "subsection Grid\nset Cell size = 0.125\nend\n",
               [](const Point<2> &x) {
                 return x.distance(Point<2>(3., 2.)) < 1.5;
               });
  disc.find();
  EXPECT_LT(disc.vector_area().norm(), 1e-12);
  EXPECT_NEAR(disc.area(), 2. * M_PI * 1.5, 0.02 * 2. * M_PI * 1.5);
  Soil<3> ball(slab<3>() + "subsection Grid\nset Cell size = 0.125\nend\n",
               [](const Point<3> &x) {
                 return x.distance(Point<3>(3., 2., 1.)) < 0.8;
               });
  ball.find();
  EXPECT_LT(ball.vector_area().norm(), 1e-12);
  const double sphere = 4. * M_PI * 0.8 * 0.8;
  EXPECT_NEAR(ball.area(), sphere, 0.04 * sphere);
}



// Nor do hanging nodes tear it.
TEST(FreeSurfaceOfSoil, DiscOnHangingNodes)
{
  Soil<2> disc(mesh("0, 0", "6, 6"), [](const Point<2> &x) {
    return x.distance(Point<2>(3., 3.)) < 1.5;
  });
  for (unsigned int i = 0; i < 2; ++i)
    disc.refine([](const Point<2> &x) { return x[0] < 3.; });
  disc.contact.prepare(disc.grid);
  disc.surface.prepare(disc.grid);
  disc.find();
  EXPECT_LT(disc.vector_area().norm(), 1e-12);
  EXPECT_NEAR(disc.area(), 2. * M_PI * 1.5, 0.05 * 2. * M_PI * 1.5);
}



// Points that cross cells make no noise: while the trapezoid moves through the
// water by a cell, its outline changes by what the step can do and not more.
TEST(FreeSurfaceOfSoil, IsContinuous)
{
  Soil<2>          soil(paper_mesh, [](const Point<2> &x) {
    return is_in_trapezoid(Point<2>(x[0], x[1] - 2.)) && x[1] > 2.;
  });
  constexpr double n_steps = 80;
  double           before  = 0;
  for (unsigned int i = 0; i <= n_steps; ++i)
    {
      Tensor<1, 2> shift;
      shift[0] = 0.2 * i / n_steps;
      shift[1] = -0.1 * i / n_steps;
      soil.find(shift);
      if (i > 0)
        {
          EXPECT_NEAR(soil.area(), before, 0.03) << i;
        }
      before = soil.area();
    }
}



template <int dim>
struct InWater
{
  explicit InWater(Soil<dim> &soil)
    : materials({})
    , water(materials, soil.contact)
    , soil(soil)
  {
    auto &prm = dealii::ParameterAcceptor::prm;
    dealii::ParameterAcceptor::declare_all_parameters();
    prm.parse_input_from_string(
      "subsection Water\nset Added mass coefficient = 0.2\n"
      "set Skin friction coefficient = 0.01\n"
      "set Pressure drag coefficient = 0.5\nend\n");
    dealii::ParameterAcceptor::parse_all_parameters();
    water.open_accounts(soil.accounts);
    water.prepare(soil.grid);
  }

  /// A step of @p dt, s, without forces but the drag.
  void
  step(const double dt)
  {
    soil.time_step = dt;
    soil.find();
    water.begin_step(soil);
    soil.nodes.update_momentum(dt, 0.);
    energy_before = kinetic_energy();
    water.correct_velocities(soil);
  }

  /// J, of soil and added mass at the nodes.
  double
  kinetic_energy() const
  {
    double energy = 0;
    for (const unsigned int node : soil.nodes.active_nodes())
      energy +=
        0.5 * soil.nodes.mass(node) * soil.nodes.velocity(node).norm_square();
    return Utilities::MPI::sum(energy, soil.grid.communicator());
  }

  double
  work() const
  {
    return Utilities::MPI::sum(soil.accounts.energy("drag work"),
                               soil.grid.communicator());
  }

  const Materials<dim> materials;
  Water<dim>           water;
  Soil<dim>           &soil;
  double               energy_before = 0; ///< before the drag, J
};



// Soil that moves into the water by 2 m/s and along its surface by 3 m/s: skin
// friction 1/2 rho C_F A u_t^2, pressure 1/2 rho C_P A u_n^2, and the momentum
// of the water that moves with it. In a step of a microsecond the drag slows
// the soil by less than a millionth, and is that of its velocity before.
template <int dim>
void
expect_drag()
{
  const double area = (dim == 2 ? 6. : 12.);
  Soil<dim>    soil(slab<dim>(), [](const Point<dim> &x) { return x[1] < 2.; });
  soil.velocity = [](const Point<dim> &) {
    Tensor<1, dim> u;
    u[0] = 3.;
    u[1] = 2.;
    return u;
  };
  InWater<dim> in_water(soil);
  in_water.step(1e-6);
  Tensor<1, dim> impulse;
  double         mass = 0;
  for (const unsigned int node : soil.nodes.active_nodes())
    {
      impulse += soil.nodes.mass(node) * soil.nodes.increment(node);
      mass += soil.nodes.mass(node);
    }
  const MPI_Comm comm = soil.grid.communicator();
  impulse             = Utilities::MPI::sum(impulse, comm);
  EXPECT_NEAR(Utilities::MPI::sum(mass, comm),
              (1600. + 200.) * 2. * area,
              1e-8);
  Tensor<1, dim> exact, velocity;
  exact[0]    = -0.5 * 1000. * 0.01 * area * 9. * soil.time_step;
  exact[1]    = -0.5 * 1000. * 0.5 * area * 4. * soil.time_step;
  velocity[0] = 3.;
  velocity[1] = 2.;
  EXPECT_LT((impulse - exact).norm(), 1e-6 * exact.norm());
  const Tensor<1, dim> recorded =
    Utilities::MPI::sum(soil.accounts.impulse("drag impulse"), comm);
  EXPECT_LT((recorded - impulse).norm(), 1e-9 * exact.norm());
  EXPECT_NEAR(in_water.work(), -(exact * velocity), -1e-6 * (exact * velocity));
}



TEST(FreeSurfaceOfSoil, DragAndAddedMass)
{
  expect_drag<2>();
  expect_drag<3>();
}



// Waves in the soil, and cells of two sizes: the work of the drag is what the
// nodes lose, and positive, also in steps that would stop the soil many times.
template <int dim>
void
expect_braked_only(const std::string &mesh, const double waves)
{
  for (const double dt : {1e-3, 1., 1e6})
    {
      Soil<dim> soil(mesh, [](const Point<dim> &x) { return x[1] < 2.2; });
      soil.velocity = [&](const Point<dim> &x) {
        Tensor<1, dim> u;
        u[1] = 2.;
        for (unsigned int d = 0; d < dim; ++d)
          u[d] += waves * std::sin(7. * x[0] + 3. * x[1] + 2. * d);
        return u;
      };
      InWater<dim> in_water(soil);
      in_water.step(dt);
      const double lost = in_water.energy_before - in_water.kinetic_energy();
      EXPECT_GT(in_water.work(), 0.);
      EXPECT_NEAR(in_water.work(), lost, 1e-12 * in_water.energy_before);
    }
}



TEST(FreeSurfaceOfSoil, DragOnlyBrakes)
{
  const std::string graded = "subsection Grid\nset Lower corner = 0, 0\n"
                             "set Upper corner = 8, 4\nset Cell size = 0.5\n"
                             "set Coarsest level = 2\n"
                             "set Refinement boxes = 0, 0; 4, 4; 1\nend\n";
  expect_braked_only<2>(slab<2>(), 0.);
  expect_braked_only<3>(slab<3>(), 0.);
  expect_braked_only<2>(slab<2>(), 5.);
  expect_braked_only<3>(slab<3>(), 5.);
  expect_braked_only<2>(graded, 5.);
}
