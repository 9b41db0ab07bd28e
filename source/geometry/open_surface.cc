// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/open_surface.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Maximum distance between a surface and a place on it, in cells.
    constexpr double on_surface = 1e-7;

    // Area of a piece below which round-off dominates the normal, in cells.
    constexpr double min_piece = 1e-9;

    // Maximum number of halvings of a piece, a quarter of a cell long, around
    // edges of a cover: in 3-D two halvings make all edges half as long.
    template <int dim>
    constexpr unsigned int max_halvings = (dim == 2 ? 4 : 6);

    // Cosine of the maximum angle to the first piece for a common direction.
    constexpr double same_direction = 0.5;

    // Two directions around a convex edge are joined if the vector area of both
    // is more than this fraction of the area: 0.71 for 90 degrees, 0.58 for the
    // corner of a box, 0 for the two sides of a wall.
    constexpr double min_joint_vector_area = 0.55;



    /// Clips the pieces of one surface by one solid.
    template <int dim>
    class Clipper
    {
    public:
      Clipper(const Cover<dim> &cover, const double size)
        : cover_(cover)
        , tolerance_(on_surface * size)
        , min_area_(min_piece * std::pow(size, dim - 1.))
      {}

      /// Append the open parts of @p piece to @p result.
      void
      clip(const Facet<dim> &piece, std::vector<Facet<dim>> &result) const
      {
        const Point<dim> middle = centroid<dim>(piece);
        double           radius = 0;
        for (const Point<dim> &corner : piece)
          radius = std::max(radius, corner.distance(middle));
        const double distance = cover_.distance(middle);
        // The distance may grow by 1.5 m per m.
        if (std::abs(distance) > 1.5 * radius + tolerance_)
          {
            if (distance > 0)
              result.push_back(piece);
          }
        else if (piece.size() <= dim)
          clip_simple(piece, distance, 0, result);
        else
          for (unsigned int e = 1; e + 1 < piece.size(); ++e)
            clip({piece[0], piece[e], piece[e + 1]}, result);
      }

    private:
      /// Clip a segment or triangle, halved until the distance is linear:
      /// otherwise the middle may be covered while all corners are open.
      void
      clip_simple(const Facet<dim>        &piece,
                  const double             at_centroid,
                  const unsigned int       n_halvings,
                  std::vector<Facet<dim>> &result) const
      {
        double mean = 0;
        for (const Point<dim> &corner : piece)
          mean += cover_.distance(corner) / dim;
        if (std::abs(mean - at_centroid) <= tolerance_ ||
            n_halvings == max_halvings<dim>)
          {
            cut(piece, result);
            return;
          }
        for (const Facet<dim> &half : halves(piece))
          clip_simple(half,
                      cover_.distance(centroid<dim>(half)),
                      n_halvings + 1,
                      result);
      }

      /// Split a segment or triangle at the middle of its longest edge.
      static std::array<Facet<dim>, 2>
      halves(const Facet<dim> &piece)
      {
        unsigned int longest = 0;
        const auto   length  = [&](const unsigned int e) {
          return piece[e].distance(piece[(e + 1) % dim]);
        };
        for (unsigned int e = 1; e < dim; ++e)
          if (length(e) > (1. + 1e-10) * length(longest))
            longest = e;
        const unsigned int end = (longest + 1) % dim;
        const Point<dim>   middle =
          piece[longest] + 0.5 * (piece[end] - piece[longest]);
        std::array<Facet<dim>, 2> result{{piece, piece}};
        result[0][end]     = middle;
        result[1][longest] = middle;
        return result;
      }

      /// Cut a segment or triangle where it changes from open to covered, by
      /// the rule of Sutherland and Hodgman.
      void
      cut(const Facet<dim> &piece, std::vector<Facet<dim>> &result) const
      {
        const Tensor<1, dim>  area   = vector_area<dim>(piece);
        const Tensor<1, dim>  normal = area / area.norm();
        std::array<bool, dim> open;
        for (unsigned int i = 0; i < dim; ++i)
          open[i] = is_open(piece[i], normal);
        Facet<dim> polygon;
        for (unsigned int i = 0; i < dim; ++i)
          {
            const unsigned int j = (i + 1) % dim;
            if (open[i])
              polygon.push_back(piece[i]);
            // A segment has a single edge.
            if (open[i] != open[j] && (dim == 3 || i == 0))
              polygon.push_back(crossing(open[i] ? piece[i] : piece[j],
                                         open[i] ? piece[j] : piece[i],
                                         normal));
          }
        if (polygon.size() >= dim &&
            vector_area<dim>(polygon).norm() > min_area_)
          result.push_back(polygon);
      }

      bool
      is_open(const Point<dim> &x, const Tensor<1, dim> &normal) const
      {
        const double distance = cover_.distance(x);
        if (std::abs(distance) > tolerance_)
          return distance > 0;
        const double cosine = normal * cover_.normal(x);
        if (std::abs(cosine) <= same_direction)
          return distance > 0;
        return cosine > 0 && !cover_.covers_common_surface;
      }

      /// Return the last open place on the way from @p open to @p covered, by
      /// bisection, since the distance may be nonlinear.
      Point<dim>
      crossing(Point<dim>            open,
               Point<dim>            covered,
               const Tensor<1, dim> &normal) const
      {
        for (unsigned int i = 0; i < 40; ++i)
          {
            const Point<dim> middle = open + 0.5 * (covered - open);
            (is_open(middle, normal) ? open : covered) = middle;
          }
        return open;
      }

      const Cover<dim> &cover_;
      const double      tolerance_; ///< m
      const double      min_area_;  ///< m^(dim-1)
    };
  } // namespace



  template <int dim>
  std::vector<Facet<dim>>
  uncovered_pieces(const std::vector<Facet<dim>> &pieces,
                   const std::vector<Cover<dim>> &covers,
                   const double                   size)
  {
    std::vector<Facet<dim>> open = pieces;
    for (const Cover<dim> &cover : covers)
      {
        const Clipper<dim>      clipper(cover, size);
        std::vector<Facet<dim>> rest;
        for (const Facet<dim> &piece : open)
          clipper.clip(piece, rest);
        open.swap(rest);
      }
    return open;
  }



  namespace
  {
    /// Pieces with a common direction, by index.
    template <int dim>
    struct Direction
    {
      Tensor<1, dim>            first_normal;
      std::vector<unsigned int> members;
      CutSurface<dim>           surface;

      /// Sum up the members in the order of @p pieces.
      void
      sum_up(const std::vector<Facet<dim>> &pieces)
      {
        std::sort(members.begin(), members.end());
        std::vector<Facet<dim>> own;
        for (const unsigned int i : members)
          own.push_back(pieces[i]);
        surface = sum_of_pieces<dim>(own);
      }
    };



    /// Return whether @p a and @p b are the sides of a convex edge, which soil
    /// flows around.
    template <int dim>
    bool
    share_convex_edge(const CutSurface<dim> &a, const CutSurface<dim> &b)
    {
      const Tensor<1, dim> from_a_to_b = b.centroid - a.centroid;
      return from_a_to_b * a.vector_area < 0 &&
             from_a_to_b * b.vector_area > 0 &&
             (a.vector_area + b.vector_area).norm() >
               min_joint_vector_area * (a.area + b.area);
    }



    template <int dim>
    void
    join_around_edges(const std::vector<Facet<dim>> &pieces,
                      std::vector<Direction<dim>>   &directions)
    {
      for (unsigned int i = 0; i < directions.size(); ++i)
        for (unsigned int j = i + 1; j < directions.size();)
          if (Direction<dim> &a = directions[i], &b = directions[j];
              share_convex_edge(a.surface, b.surface))
            {
              a.members.insert(a.members.end(),
                               b.members.begin(),
                               b.members.end());
              a.sum_up(pieces);
              directions.erase(directions.begin() + j);
              j = i + 1;
            }
          else
            ++j;
    }
  } // namespace



  template <int dim>
  std::vector<CutSurface<dim>>
  surfaces_by_direction(const std::vector<Facet<dim>> &pieces)
  {
    std::vector<Direction<dim>> directions;
    for (unsigned int i = 0; i < pieces.size(); ++i)
      {
        const Tensor<1, dim> area   = vector_area<dim>(pieces[i]);
        const Tensor<1, dim> normal = area / area.norm();
        unsigned int         k      = 0;
        while (k < directions.size() &&
               directions[k].first_normal * normal < same_direction)
          ++k;
        if (k == directions.size())
          directions.push_back({normal, {}, {}});
        directions[k].members.push_back(i);
      }
    for (Direction<dim> &direction : directions)
      direction.sum_up(pieces);
    join_around_edges(pieces, directions);
    std::vector<CutSurface<dim>> result;
    for (const Direction<dim> &direction : directions)
      result.push_back(direction.surface);
    return result;
  }



  template decltype(uncovered_pieces<2>)      uncovered_pieces<2>;
  template decltype(uncovered_pieces<3>)      uncovered_pieces<3>;
  template decltype(surfaces_by_direction<2>) surfaces_by_direction<2>;
  template decltype(surfaces_by_direction<3>) surfaces_by_direction<3>;
} // namespace talus
