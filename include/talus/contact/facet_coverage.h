// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_facet_coverage_h
#define talus_contact_facet_coverage_h

#include <talus/contact/facets.h>
#include <talus/grid/neighbor_exchange.h>
#include <talus/state/state.h>

#include <boost/container/static_vector.hpp>

#include <functional>
#include <vector>

namespace talus
{
  /// Share of each facet that soil covers: the share of its sample points that
  /// lie under the box of a point, or between two boxes close to one another.
  /// Unlike the volume fraction of soil in the cell
  /// it does not shrink with the thickness of a layer thinner than a cell. A
  /// sample point is covered or not, whichever box covers it, so the shares are
  /// the same on any number of ranks, and boxes parallel to the axes need not
  /// tile a layer that is inclined to the axes.
  template <int dim>
  class FacetCoverage
  {
  public:
    /// Volume fraction of soil at a facet [-].
    using VolumeFraction = std::function<double(const ContactFacet<dim> &)>;

    FacetCoverage(const Obstacles<dim> &obstacles, const Facets<dim> &facets)
      : obstacles_(obstacles)
      , facets_(facets)
    {}

    /// To be called after each change of the mesh or its partition. Collective.
    void
    prepare(const Grid<dim> &grid)
    {
      messages_.connect(grid.communicator());
    }

    /// Compute the covered share of each facet of Facets::owned(). Only facets in
    /// partly filled cells are sampled; all others get the share one. Collective.
    void
    find(const State<dim> &state, const VolumeFraction &volume_fraction);

    /// Covered share of facet @p facet of Facets::owned() [-].
    double
    operator[](const unsigned int facet) const
    {
      return shares_[facet];
    }

  private:
    // Sample points on columns of a quarter of a cell.
    static constexpr unsigned int n_columns = 4;

    using Samples = boost::container::static_vector<dealii::Point<dim>,
                                                    power(n_columns, dim - 1)>;
    /// Bit i is sample point i.
    using Mask = unsigned int;

    /// Sample points that boxes reach from below (2 d) and from above (2 d + 1)
    /// along axis d of the dim-1 axes across the facet.
    struct Reached
    {
      std::array<Mask, 2 * (dim - 1)> from{};

      Mask
      covered() const
      {
        Mask result = 0;
        for (unsigned int d = 0; d < dim - 1; ++d)
          result |= from[2 * d] & from[2 * d + 1];
        return result;
      }
    };

    Samples
    samples_of(const Grid<dim>         &grid,
               const ContactFacet<dim> &facet,
               unsigned int             axis) const;
    bool
    shares_cell(const ContactFacet<dim> &facet) const;
    Reached
    reached_samples(const State<dim>        &state,
                    const ContactFacet<dim> &facet,
                    unsigned int             axis,
                    const Samples           &samples) const;
    void
    add_points_of(const State<dim>             &state,
                  unsigned int                  c,
                  const dealii::Tensor<1, dim> &shift,
                  const ContactFacet<dim>      &facet,
                  unsigned int                  axis,
                  const Samples                &samples,
                  Reached                      &reached) const;
    void
    add_sample(unsigned int                  i,
               const dealii::Tensor<1, dim> &from,
               const dealii::Tensor<1, dim> &half,
               unsigned int                  axis,
               double                        beyond,
               Reached                      &reached) const;
    void
    pack_ghosts(const State<dim> &state, const VolumeFraction &volume_fraction);
    void
    receive(const Grid<dim> &grid, const NeighborExchange::Message &message);

    const Obstacles<dim>                  &obstacles_;
    const Facets<dim>                     &facets_;
    std::vector<Reached>                   reached_;   ///< by owned facet
    std::vector<unsigned int>              n_samples_; ///< 0: not looked at
    std::vector<double>                    shares_;    ///< of owned facets
    NeighborExchange                       messages_;
    std::vector<NeighborExchange::Message> outgoing_; ///< by neighbour
  };
} // namespace talus

#endif
