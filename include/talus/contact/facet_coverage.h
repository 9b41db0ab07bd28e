// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_facet_coverage_h
#define talus_contact_facet_coverage_h

#include <talus/contact/facets.h>
#include <talus/grid/neighbor_exchange.h>
#include <talus/state/state.h>

#include <vector>

namespace talus
{
  /// Share of each facet covered by soil: the share of the sample points of the
  /// facet which lie under the box of a material point, or between two boxes
  /// close together. Unlike the volume fraction, the covered share does not
  /// shrink with the thickness of a layer thinner than a cell. The shares do
  /// not depend on which box covers a sample point: they are the same on any
  /// number of ranks, and boxes parallel to the axes need not tile a layer
  /// inclined to the axes.
  template <int dim>
  class FacetCoverage
  {
  public:
    FacetCoverage(const Obstacles<dim> &obstacles, const Facets<dim> &facets)
      : obstacles_(obstacles)
      , facets_(facets)
    {}

    /// Set up the messages and delete the sample points. Call after each change
    /// of the mesh or its partition. Collective.
    void
    prepare(const Grid<dim> &grid)
    {
      messages_.connect(grid.communicator());
      samples_.clear();
    }

    /// Compute the covered share of each facet of Facets::owned(). Only facets
    /// with a volume fraction below 0.95 are sampled; other facets get the
    /// share 1. Collective.
    /// @param fractions volume fractions of soil at Facets::owned() [-]
    /// @param fractions_of_ghosts the same at Facets::ghosts()
    void
    find(const State<dim>          &state,
         const std::vector<double> &fractions,
         const std::vector<double> &fractions_of_ghosts);

    /// Covered share of facet @p facet of Facets::owned() [-].
    double
    operator[](const unsigned int facet) const
    {
      return shares_[facet];
    }

  private:
    // Sample points on columns of a quarter of a cell.
    static constexpr unsigned int n_columns = 4;
    static constexpr unsigned int n_places  = power(n_columns, dim - 1);

    /// Set of places: bit i is place i, the digits of i in base n_columns are
    /// the columns along the dim-1 axes across the facet.
    using Mask = unsigned int;

    /// Sample points of a facet. In the plane of the facet they form a lattice,
    /// so one comparison per column tests all sample points of the column.
    struct Samples
    {
      unsigned int axis   = 0; ///< an axis nearest to the normal
      Mask         places = 0; ///< sample points; none: not yet computed
      /// Coordinate of each column, m, by axis across the facet.
      std::array<std::array<double, n_columns>, dim - 1> column{};

      unsigned int
      size() const
      {
        return __builtin_popcount(places);
      }
    };

    /// Sample points reached by boxes from below (2 d) and from above (2 d + 1)
    /// along axis d of the dim-1 axes along the facet. A sample point is
    /// covered if boxes reach it from both sides along at least one axis.
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
    is_open(const Cell<dim>          &cell,
            const ContactFacet<dim>  &facet,
            const dealii::Point<dim> &x) const;
    bool
    shares_cell(const ContactFacet<dim> &facet) const;
    void
    index_segments(const State<dim> &state);
    Reached
    reached_samples(const State<dim>        &state,
                    const ContactFacet<dim> &facet,
                    const Samples           &samples) const;
    void
    add_points_of(const State<dim>             &state,
                  unsigned int                  c,
                  const dealii::Tensor<1, dim> &shift,
                  const ContactFacet<dim>      &facet,
                  const Samples                &samples,
                  Reached                      &reached) const;
    Reached
    reached_in_plan(const Samples                &samples,
                    const dealii::Point<dim>     &x,
                    const dealii::Tensor<1, dim> &half,
                    double                        beyond) const;
    void
    pack_ghosts(const State<dim> &state, const std::vector<double> &fractions);
    void
    receive(const Grid<dim> &grid, const NeighborExchange::Message &message);

    const Obstacles<dim> &obstacles_;
    const Facets<dim>    &facets_;
    // By owned facet and axis: the share of a facet is the mean over the axes
    // nearest to its normal.
    std::vector<Samples>                   samples_;
    std::vector<Reached>                   reached_;
    std::vector<unsigned int>              n_samples_;     ///< 0: not sampled
    std::vector<unsigned int>              first_segment_; ///< by owned cell
    std::vector<double>                    shares_;        ///< by owned facet
    NeighborExchange                       messages_;
    std::vector<NeighborExchange::Message> outgoing_; ///< by neighbour
  };
} // namespace talus

#endif
