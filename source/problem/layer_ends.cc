// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/region.h>
#include <talus/grid/mesh_layout.h>
#include <talus/problem/layer.h>
#include <talus/problem/layer_ends.h>
#include <talus/problem/plan_places.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Samples of a part of a vertical.
    constexpr unsigned int n_samples = 20;

    // Limit of the search below the mesh, in heights of the mesh: layers that
    // reach deeper fill the mesh on purpose.
    constexpr double search_depth = 10.;



    /// Return the distance of places in the plan of @p box, m: 50 along the
    /// longer axis, in 2-D 500.
    template <int dim>
    double
    distance_in(const Box<dim> &box)
    {
      return std::max(box.length(0), dim == 3 ? box.length(dim - 1) : 0.) /
             (dim == 2 ? 500. : 50.);
    }



    /// Return the length, m, of the part of the vertical through @p x between
    /// the heights @p from and @p to where @p is_taken is false.
    template <int dim, typename IsTaken>
    double
    open_length(Point<dim>     x,
                const double   from,
                const double   to,
                const IsTaken &is_taken)
    {
      unsigned int n_open = 0;
      for (unsigned int i = 0; i < n_samples; ++i)
        {
          x[1] = from + (i + 0.5) / n_samples * (to - from);
          n_open += !is_taken(x);
        }
      return (to - from) * n_open / n_samples;
    }



    /// Space outside of the obstacles.
    template <int dim>
    class OpenSpace
    {
    public:
      explicit OpenSpace(const typename Body<dim>::Solids &solids)
      {
        region_.cut_away(solids);
        for (const Shape<dim> *solid : solids)
          obstacles_.emplace_back(*solid);
      }

      /// Return whether @p x is outside of all obstacles; false where the
      /// surface of an obstacle is undefined.
      bool
      contains(const Point<dim> &x) const
      {
        return std::all_of(obstacles_.begin(),
                           obstacles_.end(),
                           [&x](const auto &obstacle) {
                             return obstacle.is_known_at(x);
                           }) &&
               region_.contains(x);
      }

    private:
      Region<dim>             region_;
      std::vector<Layer<dim>> obstacles_;
    };



    /// Part of a layer beyond a face of the mesh.
    struct Beyond
    {
      double volume  = 0.;    ///< per area of a column in plan
      double reach   = 0.;    ///< largest distance from the face, m
      bool   touches = false; ///< whether the face cuts the layer
    };



    /// Parts of a layer inside of the mesh and beyond the faces, outside of the
    /// obstacles. A column of soil beside the mesh belongs to the side.
    template <int dim>
    struct Parts
    {
      Parts(const Layer<dim> &layer, const LayerSite<dim> &site, Box<dim> plan);

      void
      add(const Layer<dim> &layer, const LayerSite<dim> &site, Point<dim> x);

      double                      inside   = 0.;
      double                      distance = 0.; ///< between columns, m
      OpenSpace<dim>              open_space;
      std::array<Beyond, 2 * dim> beyond;
    };



    /// The search goes on beside the mesh for the length of the mesh.
    template <int dim>
    Parts<dim>::Parts(const Layer<dim>     &layer,
                      const LayerSite<dim> &site,
                      Box<dim>              plan)
      : distance(distance_in(plan))
      , open_space(site.solids)
    {
      for (unsigned int d = 0; d < dim; d += 2)
        {
          if (site.is_free[2 * d] && plan.lower[d] == site.domain.lower[d])
            plan.lower[d] -= site.domain.length(d);
          if (site.is_free[2 * d + 1] && plan.upper[d] == site.domain.upper[d])
            plan.upper[d] += site.domain.length(d);
        }
      for (const Point<dim> &x : plan_places(plan, distance))
        if (layer.is_in_plan(x))
          add(layer, site, x);
    }



    template <int dim>
    void
    Parts<dim>::add(const Layer<dim>     &layer,
                    const LayerSite<dim> &site,
                    Point<dim>            x)
    {
      const auto is_taken = [this](const Point<dim> &place) {
        return !open_space.contains(place);
      };
      const double bottom = site.domain.lower[1];
      auto [lower, upper] = layer.ends(x);
      lower = std::max(lower, bottom - search_depth * site.domain.length(1));
      if (upper - lower <= thickness_of_round_off * site.cell_size)
        return;
      for (unsigned int d = 0; d < dim; d += 2)
        for (const bool is_upper : {false, true})
          {
            const double reach = is_upper ? x[d] - site.domain.upper[d]
                                          : site.domain.lower[d] - x[d];
            if (reach <= 0.)
              continue;
            Beyond      &part   = beyond[2 * d + is_upper];
            const double length = open_length(x, lower, upper, is_taken);
            part.volume += length;
            part.reach = std::max(part.reach, reach + 0.5 * distance);
            part.touches |= length > 0. && reach <= distance;
            return;
          }
      const double middle = std::clamp(bottom, lower, upper);
      inside += open_length(x, middle, upper, is_taken);
      if (middle - lower <= thickness_of_round_off * site.cell_size)
        return;
      Beyond &part = beyond[2];
      part.volume += open_length(x, lower, middle, is_taken);
      part.reach = std::max(part.reach, bottom - lower);
      x[1]       = bottom;
      part.touches |= !is_taken(x);
    }



    /// Return a sentence on the part beyond the face; empty if the layer goes
    /// on to the end of the search.
    template <int dim>
    std::string
    sentence_on_share(const Parts<dim>  &parts,
                      const unsigned int face,
                      const Box<dim>    &domain)
    {
      const Beyond &part = parts.beyond[face];
      const double  end =
        domain.length(face / 2) * (face == 2 ? search_depth : 1.);
      if (part.reach >= end - parts.distance)
        return "";
      return text(std::setprecision(3),
                  100. * part.volume / (parts.inside + part.volume),
                  " % of the layer lie beyond this face, up to ",
                  part.reach,
                  " m from it, and would be left out. ");
    }
  } // namespace



  template <int dim>
  std::string
  check_cut_by_mesh(const Body<dim> &body, const LayerSite<dim> &site)
  {
    const auto       shape = body.shape(site.domain);
    const Layer<dim> layer(*shape);
    if (!layer.is_layer())
      return "";
    const Parts<dim> parts(layer, site, body.bounding_box(site.domain));
    std::string      remark;
    for (unsigned int face = 0; face < 2 * dim; ++face)
      if (parts.beyond[face].touches)
        {
          const std::string share = sentence_on_share(parts, face, site.domain);
          const std::string corner =
            face % 2 == 0 ? "Lower corner" : "Upper corner";
          const std::string found =
            text("The face '",
                 face_names[face],
                 "' of the mesh, at ",
                 "xyz"[face / 2],
                 " = ",
                 (face % 2 == 0 ? site.domain.lower
                                : site.domain.upper)[face / 2],
                 " m, cuts the layer '",
                 body.name(),
                 "'. ",
                 share,
                 "Make the mesh larger ('Grid/",
                 corner,
                 "'), or end the layer inside of the mesh ('Bodies/",
                 body.name(),
                 face == 2 ? "/Lower surface" : "/" + corner,
                 "')");
          AssertThrow(!site.is_free[face],
                      ExcUser(text(found,
                                   ", or hold the soil ('Boundaries/",
                                   face_names[face],
                                   "'): the face is free and carries no "
                                   "load.")));
          if (!share.empty())
            remark = found + ".";
        }
    return remark;
  }



  namespace
  {
    /// Return the place between @p inside and @p outside where the layer ends
    /// in plan; inside of the layer up to round-off.
    template <int dim>
    Point<dim>
    end_of_plan(const Layer<dim> &layer, Point<dim> inside, Point<dim> outside)
    {
      for (unsigned int i = 0; i < 50; ++i)
        {
          const Point<dim> middle = inside + 0.5 * (outside - inside);
          (layer.is_in_plan(middle) ? inside : outside) = middle;
        }
      return inside;
    }



    /// Return the place on the end of the layer in plan with the highest free
    /// face, and the height of the face, m. A face is free outside of @p shapes
    /// other than shape @p b, and of obstacles.
    template <int dim>
    std::pair<Point<dim>, double>
    highest_free_end(const Layer<dim>                               &layer,
                     const Box<dim>                                 &box,
                     const std::vector<std::unique_ptr<Shape<dim>>> &shapes,
                     const unsigned int                              b,
                     const LayerSite<dim>                           &site)
    {
      const OpenSpace<dim> open_space(site.solids);
      const auto           is_taken = [&](const Point<dim> &x) {
        return !open_space.contains(x) ||
               std::any_of(shapes.begin(),
                           shapes.end(),
                           [&](const auto &shape) {
                             return shape != shapes[b] && shape->contains(x);
                           });
      };
      std::pair<Point<dim>, double> result;
      const double                  distance = distance_in(box);
      for (const Point<dim> &x : plan_places(box, distance))
        for (unsigned int d = 0; d < dim && layer.is_in_plan(x); d += 2)
          for (const double step : {-distance, distance})
            {
              Point<dim> beyond = x;
              beyond[d] += step;
              if (layer.is_in_plan(beyond))
                continue;
              const Point<dim> end      = end_of_plan(layer, x, beyond);
              const auto [lower, upper] = layer.ends(end);
              beyond                    = end;
              beyond[d] += 1e-3 * step;
              const double bottom = std::max(lower, site.domain.lower[1]);
              if (beyond[d] <= site.domain.lower[d] ||
                  beyond[d] >= site.domain.upper[d] || upper <= bottom)
                continue;
              const double height =
                open_length(beyond, bottom, upper, is_taken);
              if (height > result.second)
                result = {end, height};
            }
      return result;
    }
  } // namespace



  template <int dim>
  std::string
  note_on_free_end(const typename Bodies<dim>::List &bodies,
                   const unsigned int                b,
                   const LayerSite<dim>             &site)
  {
    std::vector<std::unique_ptr<Shape<dim>>> shapes;
    for (const auto &body : bodies)
      shapes.push_back(body->shape(site.domain));
    const Layer<dim> layer(*shapes[b]);
    if (!layer.is_layer())
      return "";
    const auto [place, height] = highest_free_end(
      layer, bodies[b]->bounding_box(site.domain), shapes, b, site);
    if (height < site.cell_size)
      return "";
    return text("The layer '",
                bodies[b]->name(),
                "' ends in a free face of ",
                height,
                " m at x = ",
                place[0],
                dim == 3 ? text(" m, z = ", place[dim - 1]) : "",
                " m, inside of the mesh: neither a body nor an obstacle is "
                "beyond, and soil may fail there at the start. If no such face "
                "is meant, correct the corners of the layer in 'Bodies/",
                bodies[b]->name(),
                "'.");
  }



  template decltype(check_cut_by_mesh<2>) check_cut_by_mesh<2>;
  template decltype(check_cut_by_mesh<3>) check_cut_by_mesh<3>;
  template decltype(note_on_free_end<2>)  note_on_free_end<2>;
  template decltype(note_on_free_end<3>)  note_on_free_end<3>;
} // namespace talus
