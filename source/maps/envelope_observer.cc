// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/contact/ground.h>
#include <talus/maps/envelope_observer.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Add the forces of the last step along the bed, N, acting on the soil:
    /// from the facets of obstacles belonging to the ground, and from the
    /// bottom face of the mesh if it is a seabed. The force of a facet is
    /// distributed over
    /// the plan area of the cell, and the force of a node over half a cell to
    /// each side: on a steep bed, the force lost where a facet ends comes back
    /// from the cell below or above.
    template <int dim>
    void
    add_bed_shear(const State<dim>   &state,
                  const Contact<dim> &contact,
                  ColumnSums<dim>    &sums)
    {
      const double dt = contact.previous_time_step();
      if (dt == 0)
        return;
      const auto &facets   = contact.facets().owned();
      const auto &impulses = contact.impulses();
      if (!contact.obstacles().empty())
        {
          const Ground<dim> ground(state.grid.domain(), &contact.obstacles());
          for (unsigned int c = 0; c < facets.size(); ++c)
            if (const auto &impulse = impulses[c].tangential;
                impulse.norm_square() > 0 &&
                ground.contains(facets[c].obstacle))
              sums.add_bed_force(impulse / dt,
                                 state.grid.cells()[facets[c].cell].box());
        }
      const double   h      = state.grid.finest_size();
      const Box<dim> domain = state.grid.domain();
      for (unsigned int i = 0; i < contact.face_nodes().size(); ++i)
        {
          const FaceNode<dim> &at      = contact.face_nodes()[i];
          const auto          &impulse = impulses[facets.size() + i].tangential;
          if (at.face != bottom_face || impulse.norm_square() == 0)
            continue;
          const Point<dim> &x = at.x;
          Box<dim>          box{x, x};
          for (unsigned int d = 0; d < dim; ++d)
            {
              box.lower[d] = std::max(x[d] - 0.5 * h, domain.lower[d]);
              box.upper[d] = std::min(x[d] + 0.5 * h, domain.upper[d]);
            }
          sums.add_bed_force(impulse / dt, box);
        }
    }
  } // namespace



  /// Make columns and envelope. A checkpoint is read before the mesh exists, so
  /// restored rows wait until columns are known.
  template <int dim>
  void
  EnvelopeObserver<dim>::begin(const OutputSettings &settings,
                               const State<dim>     &state,
                               const Beginning /*beginning*/)
  {
    const double h = state.grid.cell_size();
    folder_        = settings.folder;
    sums_          = std::make_unique<ColumnSums<dim>>(make_columns(state));
    envelope_      = std::make_unique<Envelope<dim>>(
      sums_->columns().size(),
      typename Envelope<dim>::Settings{settings_->smallest_thickness(h),
                                       settings_->arrival_thresholds(h),
                                       impact()});
    if (is_first_rank(state.communicator()))
      envelope_->restore(restored_);
    restored_.clear();
  }



  /// Add the soil of @p state to the envelope. Collective.
  template <int dim>
  void
  EnvelopeObserver<dim>::sample(const State<dim> &state)
  {
    last_sample_    = state.step;
    path_at_sample_ = state.max_path;
    sums_->sum_soil(state, impact().is_used() ? &problem_.materials : nullptr);
    add_bed_shear(state, problem_.contact, *sums_);
    sums_->sum_over_ranks(state.communicator());
    if (is_first_rank(state.communicator()))
      envelope_->add(*sums_, state.time);
  }



  template <int dim>
  void
  EnvelopeObserver<dim>::list_state(StateList &list)
  {
    if (!this->is_enabled(OutputSettings()))
      return;
    const unsigned int n_columns =
      Envelope<dim>::n_numbers(settings_->n_arrival_thresholds());
    list.add("maximum path at the sample of " + name_,
             "m",
             path_at_sample_,
             Reduction::equal);
    list.add_table(
      {name_,
       "column, thickness [m], mass [kg/m^2], thickness at start [m]; value "
       "and time of the "
       "maxima of thickness, speed, momentum flux, bed shear stress, impact "
       "pressure; times of arrival; SI units",
       n_columns,
       [this]() {
         return envelope_ ? envelope_->save() : std::vector<double>();
       },
       [this](const std::vector<double> &rows) { restored_ = rows; }});
  }



  template class EnvelopeObserver<2>;
  template class EnvelopeObserver<3>;
} // namespace talus
