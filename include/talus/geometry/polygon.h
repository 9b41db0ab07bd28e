// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_polygon_h
#define talus_geometry_polygon_h

#include <talus/geometry/shape.h>

#include <string>
#include <vector>

namespace talus
{
  /// Line of straight edges: the only computation of distances to edges. Boxes
  /// around runs of edges make the cost of a query grow with the logarithm of
  /// the number of edges.
  class EdgeLine
  {
  public:
    /// Distance and direction from the nearest place on the line.
    struct Nearest
    {
      /// Distance, m, never negative.
      double distance;
      /// Unit vector from the line to the place; for a place on the line, the
      /// normal to the left.
      dealii::Tensor<1, 2> direction;
      /// Whether the place lies on the left of the line, seen along the line.
      bool on_left;
    };

    /// @p vertices in order; a closed line repeats the first vertex at the end.
    /// The first and last edges of an open line are endless.
    EdgeLine(const std::vector<dealii::Point<2>> &vertices, bool is_closed);

    Nearest
    nearest(const dealii::Point<2> &x) const;

    /// Return whether the closed line encloses @p x or passes through it.
    bool
    encloses(const dealii::Point<2> &x) const;

    /// Box around all edges; infinite if the ends are endless.
    const Box<2> &
    bounding_box() const
    {
      return boxes_[1];
    }

  private:
    /// Place of edge @p e nearest to @p x.
    struct Foot
    {
      double               t; ///< 0 at the first end of the edge, 1 at the last
      dealii::Tensor<1, 2> away; ///< from the place on the edge to x, m
    };

    std::size_t
    n_edges() const
    {
      return vertices_.size() - 1;
    }

    Foot
    foot(std::size_t e, const dealii::Point<2> &x) const;

    /// Run of edges in the box number k of boxes_; boxes 2k and 2k + 1 have the
    /// halves of the run.
    struct Run
    {
      std::size_t k, begin, end;
    };

    void
    enclose(const Run &run);
    template <typename Bound, typename Use>
    void
    visit(const Run    &run,
          const Bound  &bound,
          const double &limit,
          const Use    &use) const;

    /// Unit vector to the left of edge @p e.
    dealii::Tensor<1, 2>
    left_of(std::size_t e) const;
    /// Vector to the left at vertex @p v: the sum of the vectors of both edges.
    dealii::Tensor<1, 2>
    left_at(std::size_t v) const;

    std::vector<dealii::Point<2>> vertices_;
    bool                          is_closed_;
    std::vector<Box<2>>           boxes_;
    double                        round_off_; ///< upper bound for places, m
  };



  /// Polygon in the x-y plane.
  class Polygon : public Shape<2>
  {
  public:
    /// @p vertices in either sense, the first vertex optionally repeated at the
    /// end. Throws ExcUser, starting with @p name, if the polygon intersects
    /// itself or has no area.
    Polygon(const std::string                   &name,
            const std::vector<dealii::Point<2>> &vertices);

    double
    signed_distance(const dealii::Point<2> &x) const override;

    dealii::Tensor<1, 2>
    normal(const dealii::Point<2> &x) const override;

    std::pair<double, dealii::Tensor<1, 2>>
    distance_and_normal(const dealii::Point<2> &x) const override;

    bool
    contains(const dealii::Point<2> &x) const override;

    Box<2>
    bounding_box() const override;

  private:
    EdgeLine edges_;
  };



  /// Everything on the right of a line of straight edges with endless first and
  /// last edges: below a seabed with vertices from left to right.
  class OpenPolygon : public Shape<2>
  {
  public:
    /// Throws ExcUser, starting with @p name, if there are less than two
    /// vertices, two successive vertices coincide, or the line crosses itself.
    OpenPolygon(const std::string                   &name,
                const std::vector<dealii::Point<2>> &vertices);

    double
    signed_distance(const dealii::Point<2> &x) const override;

    dealii::Tensor<1, 2>
    normal(const dealii::Point<2> &x) const override;

    Box<2>
    bounding_box() const override;

  private:
    EdgeLine edges_;
  };
} // namespace talus

#endif
