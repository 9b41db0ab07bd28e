// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef one_node_setup_h
#define one_node_setup_h

#include <talus/contact/contact.h>

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  constexpr double dt = 0.1;

  /// One node of a mesh of cells of 1 m with a mass and a trial velocity.
  template <int dim>
  struct OneNode : Core<dim>
  {
    /// @param conditions entries of section Boundaries
    /// @param seabed entries of section Boundaries/Seabed
    /// @param place of the node, m
    /// @param mass kg
    /// @param before velocity before the step, m/s
    /// @param trial velocity after the momentum update, m/s
    /// @param volume of soil at the node, m^dim
    /// @param boxes of points, by centre and length along x, and height of the
    ///   lower side above the bottom, m
    OneNode(const std::string                        &conditions,
            const std::string                        &seabed,
            const Point<dim>                         &place,
            const double                              mass,
            const Tensor<1, dim>                     &before,
            const Tensor<1, dim>                     &trial,
            const double                              volume = 1e3,
            const std::vector<std::array<double, 3>> &boxes  = {})
      : Core<dim>(
          cube<dim>() +
          in_section("Boundaries",
                     conditions + "\n" +
                       in_section("Seabed", "set Gap = false\n" + seabed)))
    {
      const auto places = places_of_nodes(this->grid);
      node              = 0;
      while (places[node].distance(place) > 1e-12)
        ++node;
      for (const auto &[x, length, above] : boxes)
        {
          Point<dim>     centre;
          Tensor<1, dim> lengths;
          for (unsigned int d = 0; d < dim; ++d)
            lengths[d] = 0.5;
          centre[0]  = x;
          centre[1]  = above + 0.25;
          lengths[0] = length;
          this->add(centre, lengths);
        }
      this->sort();
      this->constants.box_shape = this->transfer.box_shape();
      this->time_step           = dt;
      this->boundaries.parse(Constants());
      this->boundaries.prepare(this->grid);
      contact.prepare(this->grid);
      contact.open_accounts(this->accounts);
      set_node(mass, volume, before, mass * (trial - before) / dt);
      contact.begin_step(*this);
      this->boundaries.add_forces(*this);
      kinetic_energy_before = 0.5 * mass * before.norm_square();
      step();
      // Work is taken with the mean of the velocities before and after.
      force_work = mass * (trial - before) * this->nodes.mean_velocity(node);
    }

    /// Set the node for the next step(); all other nodes are empty.
    void
    set_node(const double          mass,
             const double          volume,
             const Tensor<1, dim> &velocity,
             const Tensor<1, dim> &force)
    {
      std::vector<unsigned int> all(this->grid.cells().size());
      for (unsigned int c = 0; c < all.size(); ++c)
        all[c] = c;
      this->nodes.activate(this->grid, all);
      this->nodes.clear();
      if (mass > 0)
        this->nodes.set_sums(node, mass, volume, mass * velocity, force);
    }

    /// Update the momentum and apply contact and walls.
    void
    step()
    {
      this->nodes.update_momentum(dt, 0.);
      contact.correct_velocities(*this);
      this->boundaries.correct_velocities(*this);
      contact.record(*this);
    }

    double
    friction_work() const
    {
      return this->accounts.energy("friction work");
    }

    double
    contact_work() const
    {
      return this->accounts.energy("contact work");
    }

    void
    expect_velocity(const Tensor<1, dim> &v) const
    {
      EXPECT_LT((this->nodes.velocity(node) - v).norm(), 1e-14)
        << this->nodes.velocity(node);
    }

    /// Expect the impulses on the soil since the first step, N s.
    void
    expect_impulses(const Tensor<1, dim> &seabed,
                    const Tensor<1, dim> &wall) const
    {
      const auto &of_seabed = this->accounts.impulse("seabed impulse");
      const auto &of_wall   = this->accounts.impulse("wall impulse");
      EXPECT_LT((of_seabed - seabed).norm(), 1e-13) << of_seabed;
      EXPECT_LT((of_wall - wall).norm(), 1e-13) << of_wall;
    }

    Obstacles<dim> obstacles{{}};
    Contact<dim>   contact{obstacles, this->boundaries};
    unsigned int   node;
    double         kinetic_energy_before, force_work;
  };

  const std::string bottom = "set Bottom = seabed";
  const Point<2>    on_bottom(2., 0.);



  /// Law with a friction coefficient and a cap, Pa.
  std::string
  law(const double mu, const double cap)
  {
    return text(
      "set Friction coefficient = ", mu, "\nset Maximum shear stress = ", cap);
  }



  // Mass 2 kg, before (1, -0.2), trial (3, -0.5) m/s: N = 2 0.5/0.1 = 10 N,
  // and 60 N would stop it.
  const Tensor<1, 2> before = Point<2>(1., -0.2), trial = Point<2>(3., -0.5);
} // namespace

#endif
