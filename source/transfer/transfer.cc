// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/points/points_kernel.h>
#include <talus/transfer/transfer.h>
#include <talus/transfer/transpose.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Transfer<dim>::Transfer()
    : ParameterAcceptor("/Transfer")
  {
    add_parameter("FLIP fraction",
                  flip_fraction_,
                  "Share of the old velocity plus the increment of the grid "
                  "(FLIP) in the new velocity of a point; the rest is the "
                  "velocity of the grid (PIC), which damps [-].",
                  this->prm,
                  Patterns::Double(0., 1.));
    add_parameter("Box rule",
                  box_rule_,
                  "How the box of a point follows its deformation: 'fixed' "
                  "(uniform GIMP; the children of a split then do not tile "
                  "their parent), 'deformation gradient' (F_dd), 'right "
                  "stretch' (U_dd of F = R U, blind to where the material has "
                  "turned) or 'left stretch' (V_dd of F = V R), all of them "
                  "parallel to the axes; or 'convected domain' (CPDI), a "
                  "parallelogram that turns, stretches and shears with F: for "
                  "bodies that bend or turn far, at several times the cost.",
                  this->prm,
                  Patterns::Selection(
                    "fixed|deformation gradient|right stretch|left stretch|"
                    "convected domain"));
    add_parameter(
      "Minimum half-size",
      box_shape_.least_half,
      "Half of the length of a box is clipped to at least this many "
      "cell sizes for the weights; thinner boxes would lower the "
      "stable time step. Of a convected domain: half of the distance between "
      "opposite sides [-].",
      this->prm,
      Patterns::Double(1e-3, 0.5));
    add_parameter("Maximum half-size",
                  box_shape_.most_half,
                  "Half of the length of a box is clipped to at most this many "
                  "cell sizes for the weights; a longer box would reach beyond "
                  "the cells around its own. A convected domain may reach "
                  "twice as far from its centre along each axis, in sizes of "
                  "the smallest cell around [-].",
                  this->prm,
                  Patterns::Double(1e-3, 0.5));
    add_parameter("Mass cut-off",
                  mass_cut_off_,
                  "Nodes with less mass than this fraction of a full cell's "
                  "carry nothing [-]. A large value acts as a wall in front of "
                  "the slide.",
                  this->prm,
                  Patterns::Double(0., 1e-3));
    parse_parameters_call_back.connect([this]() {
      box_shape_.rule =
        box_rule_ == "fixed"                  ? BoxRule::fixed
        : box_rule_ == "deformation gradient" ? BoxRule::deformation_gradient
        : box_rule_ == "right stretch"        ? BoxRule::right_stretch
        : box_rule_ == "convected domain"     ? BoxRule::convected_domain
                                              : BoxRule::left_stretch;
    });
  }



  template <int dim>
  void
  Transfer<dim>::check() const
  {
    AssertThrow(box_shape_.least_half <= box_shape_.most_half,
                ExcUser(text("Transfer/Minimum half-size = ",
                             box_shape_.least_half,
                             " must not exceed Transfer/Maximum half-size = ",
                             box_shape_.most_half,
                             ".")));
  }



  // In shares of a full cell, so that it means the same on every mesh.
  template <int dim>
  double
  Transfer<dim>::mass_cutoff(const double density, const double cell_size) const
  {
    return mass_cut_off_ * density * std::pow(cell_size, dim);
  }



  // Bodies without it should not pay for it.
  template <int dim>
  bool
  Transfer<dim>::takes_bbar(const Points<dim> &points, const Batch &batch) const
  {
    for (unsigned int s = batch.first_segment; s < batch.last_segment; ++s)
      if (uses_bbar(points.segments()[s].body))
        return true;
    return false;
  }



  /// The mean of a quantity over each cell, at its points: over those of all
  /// bodies whose law asks for it. At the others the quantity itself.
  template <int dim>
  void
  Transfer<dim>::set_cell_means(const Points<dim> &points,
                                const Batch       &batch,
                                const double      *quantity,
                                const double      *weighted,
                                double            *mean) const
  {
    // A cell has few points, so that what counts is how few instructions go
    // around them. Sums go point by point, lest they depend on the registers,
    // product and volume in one. What a register writes behind a segment, the
    // next one overwrites.
    using Number              = Simd<simd_width>;
    const Segment *segment    = points.segments().data() + batch.first_segment;
    const Segment *const last = points.segments().data() + batch.last_segment;
    const unsigned char *const uses = bbar_of_body_.data();
    while (segment != last)
      {
        const Segment *const first = segment;
        Simd<2>              sums(0.);
        do
          if (uses[segment->body] != 0)
            {
              const double *at = weighted + 2 * (segment->begin - batch.begin);
              const double *const end =
                weighted + 2 * (segment->end - batch.begin);
              TALUS_SHORT_LOOP
              for (; at != end; at += 2)
                sums += load<Simd<2>>(at);
            }
        while (++segment != last && segment->cell == first->cell);
        const Number value(sums[0] / sums[1]);
        for (const Segment *of_body = first; of_body != segment; ++of_body)
          {
            unsigned int       k   = of_body->begin - batch.begin;
            const unsigned int end = of_body->end - batch.begin;
            if (uses[of_body->body] != 0)
              {
                TALUS_SHORT_LOOP
                for (; k < end; k += simd_width)
                  store(mean + k, value);
              }
            else
              {
                TALUS_SHORT_LOOP
                for (; k < end; k += simd_width)
                  store(mean + k, load<Number>(quantity + k));
              }
          }
      }
  }



  /// Call add(p, difference) with the difference between the mean over the cell
  /// of quantity(p) and itself.
  /// Both halves of B-bar are this, with another quantity. It takes three
  /// passes, each in the order that suits it: several points at a time for the
  /// quantity and its product with the volume, cell by cell for the means,
  /// several points at a time again. All of it stays in the cache, as it is a
  /// batch's.
  template <int dim>
  template <typename Quantity, typename Add>
  void
  Transfer<dim>::shift_to_cell_means(const Points<dim>  &points,
                                     StepWorkspace<dim> &workspace,
                                     const Batch        &batch,
                                     const Quantity     &quantity,
                                     const Add          &add) const
  {
    const auto    columns  = points.view();
    double *const values   = workspace.scratch(0);
    double *const mean     = workspace.scratch(1);
    double *const weighted = workspace.scratch(2); // and 3: pairs
    for_each_simd(batch.begin,
                  batch.end,
                  [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
                    using Number         = decltype(number);
                    const unsigned int k = p - batch.begin;
                    const Number       q = quantity(p, number);
                    const Number V = volume_of_points<dim, Number>(columns, p);
                    store(values + k, q);
                    store_pairs(weighted + 2 * k, V * q, V);
                  });
    set_cell_means(points, batch, values, weighted, mean);
    for_each_simd(batch.begin,
                  batch.end,
                  [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
                    using Number         = decltype(number);
                    const unsigned int k = p - batch.begin;
                    add(p, load<Number>(mean + k) - load<Number>(values + k));
                  });
  }



  // Both means are weighted with the volume at the start of the step and taken
  // over the same points: only then is the pair adjoint,
  // sum V sigma : D' = sum V sigma' : D, and no energy appears. Bodies that
  // share a cell share its mean: with one mean each, nothing would tie the
  // pressures in that cell to one another.

  // Soil that hardly changes its volume locks on bilinear cells: each of the
  // four points of a cell asks for its own volume to stay, but there is one
  // node per cell, with two components. The mean asks once (doc/method.md,
  // section 3). With q = tr_dim(sigma)/dim and the means <.> over the cell
  //   sigma' = sigma + (<q> - q) I,  D' = D + (<tr D> - tr D)/dim I.
  // In 2-D q is the mean in the plane and not the pressure: D' has only these
  // components, and with the pressure the pair would not be adjoint. The shift
  // is kept apart from the stress, which remains the point's own: it is needed
  // for the forces only.
  template <int dim>
  void
  Transfer<dim>::apply_bbar_to_stress(const Points<dim>  &points,
                                      StepWorkspace<dim> &workspace,
                                      const Batch        &batch) const
  {
    if (!takes_bbar(points, batch))
      {
        std::fill_n(workspace.mean_stress_shift(), batch.end - batch.begin, 0.);
        return;
      }
    const auto    columns = points.view();
    double *const shift   = workspace.mean_stress_shift() - batch.begin;
    shift_to_cell_means(
      points,
      workspace,
      batch,
      [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
        using Number = decltype(number);
        Number q(0.);
        for (unsigned int d = 0; d < dim; ++d)
          q += load<Number>(columns.data(columns.stress, d) + p);
        return q * (1. / dim);
      },
      [&](const unsigned int p, const auto &difference)
        TALUS_INLINE_LAMBDA { store(shift + p, difference); });
  }



  // The velocity gradient itself is changed, so that deformation gradient,
  // volume and stress all follow the same D'.
  template <int dim>
  void
  Transfer<dim>::apply_bbar_to_dilatation(const Points<dim>  &points,
                                          StepWorkspace<dim> &workspace,
                                          const Batch        &batch) const
  {
    if (!takes_bbar(points, batch))
      return;
    const auto work = workspace.view(batch.begin, batch.end);
    shift_to_cell_means(
      points,
      workspace,
      batch,
      [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
        return trace(load_velocity_gradient<dim, decltype(number)>(work, p));
      },
      [&](const unsigned int p, const auto &difference) TALUS_INLINE_LAMBDA {
        using Number = std::decay_t<decltype(difference)>;
        for (unsigned int d = 0; d < dim; ++d)
          {
            double *const L_dd = work.velocity_gradient(d, d) + p;
            store(L_dd, load<Number>(L_dd) + difference * (1. / dim));
          }
      });
  }



  template Transfer<2>::Transfer();
  template Transfer<3>::Transfer();
  template void
  Transfer<2>::check() const;
  template void
  Transfer<3>::check() const;
  template double
  Transfer<2>::mass_cutoff(double, double) const;
  template double
  Transfer<3>::mass_cutoff(double, double) const;
  template void
  Transfer<2>::apply_bbar_to_stress(const Points<2> &,
                                    StepWorkspace<2> &,
                                    const Batch &) const;
  template void
  Transfer<3>::apply_bbar_to_stress(const Points<3> &,
                                    StepWorkspace<3> &,
                                    const Batch &) const;
  template void
  Transfer<2>::apply_bbar_to_dilatation(const Points<2> &,
                                        StepWorkspace<2> &,
                                        const Batch &) const;
  template void
  Transfer<3>::apply_bbar_to_dilatation(const Points<3> &,
                                        StepWorkspace<3> &,
                                        const Batch &) const;
} // namespace talus
