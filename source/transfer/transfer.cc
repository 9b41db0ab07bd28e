// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/points/points_kernel.h>
#include <talus/transfer/transfer.h>
#include <talus/transfer/transpose.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Transfer<dim>::Transfer()
    : ParameterAcceptor("/Transfer")
  {
    add_parameter("Box rule",
                  box_rule_,
                  "How the box of a point follows its deformation. "
                  "'axis-parallel': with the second moments, along the axes, "
                  "of the cell of the point's edges (with 'Splitting/Shear = "
                  "counted' the lengths are V_dd of F = V R times the initial "
                  "lengths). 'fixed': the box keeps its lengths (uniform GIMP; "
                  "the children of a split do not tile their parent). "
                  "'convected domain': the cell itself, a parallelogram that "
                  "turns, stretches and shears (CPDI), for bodies that bend or "
                  "turn far, at several times the cost.",
                  this->prm,
                  Patterns::Selection("axis-parallel|fixed|convected domain"));
    add_parameter(
      "Minimum half-size",
      box_shape_.min_half,
      "Lower limit of the half length of a box in the weights, in cell sizes "
      "[-]; thinner boxes would lower the stable time step. For a convected "
      "domain: lower limit of half the distance between opposite sides.",
      this->prm,
      Patterns::Double(1e-3, 0.5));
    add_parameter("Mass cut-off",
                  mass_cut_off_,
                  "Nodes with less mass than this fraction of the mass of a "
                  "full cell do not move [-]. A large value acts as a wall in "
                  "front of the slide.",
                  this->prm,
                  Patterns::Double(0., 1e-3));
    // Set at each parse, for this object alone.
    const auto choose = [this](const std::string &) { choose_boxes(); };
    this->enter_my_subsection(this->prm);
    this->prm.add_action("Box rule", choose);
    this->leave_my_subsection(this->prm);
    shear_.enter_my_subsection(this->prm);
    this->prm.add_action("Shear", choose);
    shear_.leave_my_subsection(this->prm);
  }



  template <int dim>
  Transfer<dim>::Shear::Shear()
    : ParameterAcceptor("/Splitting")
  {
    add_parameter("Shear",
                  name,
                  "'ignored': long edges that simple shear has made are "
                  "replaced by shorter edges of the same lattice of points, so "
                  "that only stretch splits points. Not for laws whose stress "
                  "is a function of the deformation gradient (Hencky, "
                  "neo-Hookean): there shear is counted. 'counted': shear "
                  "counts as stretch, and boxes are halved along the axes, as "
                  "in the paper; a shear band then splits points without end.",
                  this->prm,
                  Patterns::Selection("ignored|counted"));
  }



  template <int dim>
  void
  Transfer<dim>::choose_boxes()
  {
    box_shape_.counts_shear = shear_.name == "counted";
    BoxRule parallel        = BoxRule::second_moments;
    if (box_shape_.counts_shear)
      parallel = BoxRule::left_stretch;
    box_shape_.rule = box_rule_ == "fixed" ? BoxRule::fixed
                      : box_rule_ == "convected domain"
                        ? BoxRule::convected_domain
                        : parallel;
  }



  // As a fraction of a full cell the cut-off is the same on every mesh.
  template <int dim>
  double
  Transfer<dim>::mass_cutoff(const double density, const double cell_size) const
  {
    return mass_cut_off_ * density * std::pow(cell_size, dim);
  }



  // Batches without B-bar skip the averaging.
  template <int dim>
  bool
  Transfer<dim>::uses_bbar(const Points<dim> &points, const Batch &batch) const
  {
    const auto segments = points.segments(batch);
    return std::any_of(segments.begin(),
                       segments.end(),
                       [this](const Segment &segment) {
                         return uses_bbar(segment.body);
                       });
  }



  /// Compute the mean of a quantity over each cell, weighted by volume, for the
  /// points of all bodies that use B-bar; for other points copy the quantity.
  /// @param quantity value at each point of the batch
  /// @param weighted pairs of volume times quantity and volume, m^3, per point
  /// @param mean result per point of the batch
  template <int dim>
  void
  Transfer<dim>::set_cell_means(const Points<dim> &points,
                                const Batch       &batch,
                                const double      *quantity,
                                const double      *weighted,
                                double            *mean) const
  {
    // A cell has few points, so the number of instructions around them decides.
    // Sums run point by point, so that they do not depend on the width of the
    // registers; a register holds product and volume. Values that a register
    // writes behind a segment are overwritten by the next segment.
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



  /// Call add(p, difference) with the cell mean of quantity(p) minus
  /// quantity(p). Three passes, each in its best order: several points at a
  /// time for the quantity and its product with the volume, cell by cell for
  /// the means, several points at a time for the differences. The data of a
  /// batch stay in the cache.
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



  namespace
  {
    /// Excess pore pressure of points without the column.
    struct NoPorePressure
    {
      template <typename Number>
      TALUS_ALWAYS_INLINE Number
      operator()(const unsigned int /*p*/, Number /*number*/) const
      {
        return Number(0.);
      }
    };



    struct PorePressure
    {
      template <typename Number>
      TALUS_ALWAYS_INLINE Number
      operator()(const unsigned int p, Number /*number*/) const
      {
        return load<Number>(u + p);
      }

      const double *u; ///< by point, Pa
    };
  } // namespace



  // Both means are weighted with the volume at the start of the step and run
  // over the same points: only then the pair is adjoint, sum V sigma : D' =
  // sum V sigma' : D, and creates no energy. Bodies in one cell share the mean:
  // separate means would leave the pressures in the cell uncoupled.

  // Nearly incompressible soil locks on bilinear cells: each of the four points
  // of a cell constrains its own volume, but there is only one node per cell,
  // with two components. The mean is one constraint per cell (doc/method.md,
  // section 3). With q = tr_dim(sigma)/dim and the means <.> over the cell
  //   sigma' = sigma + (<q> - q) I,  D' = D + (<tr D> - tr D)/dim I.
  // In 2-D q is the mean stress in the plane and not the pressure: D' has only
  // the components in the plane, and with the pressure the pair would not be
  // adjoint. The shift is stored separately: only the forces need it, and the
  // stress of the point stays unchanged. The excess pore pressure u is a part
  // of the total stress that is the same in all directions: the shift
  // <q - u> - q takes it along.
  template <int dim>
  void
  Transfer<dim>::apply_bbar_to_stress(const Points<dim>  &points,
                                      StepWorkspace<dim> &workspace,
                                      const Batch        &batch) const
  {
    double *const       shift = workspace.mean_stress_shift() - batch.begin;
    const double *const u     = points.have_pore_pressure()
                                  ? points.data(points.pore_pressure())
                                  : nullptr;
    if (!uses_bbar(points, batch))
      for (unsigned int p = batch.begin; p < batch.end; ++p)
        shift[p] = u ? -u[p] : 0.;
    else if (u)
      set_shift(points, workspace, batch, shift, PorePressure{u});
    else
      set_shift(points, workspace, batch, shift, NoPorePressure());
  }



  template <int dim>
  template <typename Pressure>
  void
  Transfer<dim>::set_shift(const Points<dim>  &points,
                           StepWorkspace<dim> &workspace,
                           const Batch        &batch,
                           double             *shift,
                           const Pressure     &pressure) const
  {
    const auto columns = points.view();
    shift_to_cell_means(
      points,
      workspace,
      batch,
      [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
        using Number = decltype(number);
        Number q(0.);
        for (unsigned int d = 0; d < dim; ++d)
          q += load<Number>(columns.data(columns.stress, d) + p);
        return q * (1. / dim) - pressure(p, number);
      },
      [&](const unsigned int p, const auto &difference) TALUS_INLINE_LAMBDA {
        using Number = std::decay_t<decltype(difference)>;
        store(shift + p, difference - pressure(p, Number()));
      });
  }



  // The velocity gradient itself is changed, so deformation gradient, volume
  // and stress all follow the same D'.
  template <int dim>
  void
  Transfer<dim>::apply_bbar_to_dilatation(const Points<dim>  &points,
                                          StepWorkspace<dim> &workspace,
                                          const Batch        &batch) const
  {
    if (!uses_bbar(points, batch))
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
