// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/analytic_shapes.h>
#include <talus/geometry/side_of_surface.h>
#include <talus/problem/body.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>

namespace talus
{
  using namespace dealii;

  /// Each body has a section named after it, shared by shape and initial state.
  template <int dim>
  Body<dim>::Body(const std::string &name)
    : ParameterAcceptor("/Bodies/" + name)
    , name_(name)
    , shape_("/Bodies/" + name)
    , initial_state_("/Bodies/" + name)
  {
    add_parameter("Material",
                  material_,
                  "One of the names in Materials/Names.");
    add_parameter("Points per cell and axis",
                  points_per_cell_,
                  "Number of material points along each axis of a cell: one "
                  "number for all axes, or one number per axis, separated by "
                  "commas.",
                  this->prm,
                  Patterns::List(Patterns::Integer(1, 16), 1, dim));
    add_parameter("Filling",
                  filling_,
                  "'clipped': boxes of points are cut by the surface of the "
                  "body; points lie at the centroids of the parts inside, "
                  "and the mass equals the mass of the shape. 'centres': "
                  "whole boxes with centres in the body; the surface is a "
                  "staircase, and the volume accurate to the size of a point.",
                  this->prm,
                  Patterns::Selection("clipped|centres"));
    add_parameter("Cut by obstacles",
                  cut_by_obstacles_,
                  "true: parts of the body inside obstacles are removed, and "
                  "the body is filled down to the obstacles. false: a body "
                  "inside an obstacle is an error.");
    add_parameter("Cut by mesh",
                  cut_by_mesh_,
                  "Whether parts of the body outside of the mesh are left out, "
                  "as of a cylinder in a quarter model between planes of "
                  "symmetry; otherwise they are an error.");
    std::string faces = "none";
    for (unsigned int face = 0; face < 2 * dim; ++face)
      faces += "|" + face_names[face];
    add_parameter("Inflow face",
                  inflow_face_,
                  "Face of the mesh, with the condition 'velocity', through "
                  "which more soil of the body enters. The opening is the part "
                  "of the face that the body touches at the start, with "
                  "a row of points at least; the discharge is the normal "
                  "velocity of the face, linear between the nodes, integrated "
                  "over the opening.",
                  this->prm,
                  Patterns::Selection(faces));
  }



  /// @p domain is the domain of the parameters: faces moved outwards to make
  /// room for large cells do not extend the room for soil. Endless shapes end
  /// at the domain.
  template <int dim>
  Box<dim>
  Body<dim>::bounding_box(const Box<dim> &domain) const
  {
    Box<dim> box = shape_.make(domain)->bounding_box();
    for (unsigned int d = 0; d < dim; ++d)
      {
        if (std::isinf(box.lower[d]) || cut_by_mesh_)
          box.lower[d] = std::max(box.lower[d], domain.lower[d]);
        if (std::isinf(box.upper[d]) || cut_by_mesh_)
          box.upper[d] = std::min(box.upper[d], domain.upper[d]);
      }
    check_inside(box, domain);
    return box;
  }



  /// The tolerance admits a body that ends on a face of the mesh up to
  /// round-off.
  template <int dim>
  void
  Body<dim>::check_inside(const Box<dim> &box, const Box<dim> &domain) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double tolerance = 1e-9 * domain.length(d);
        AssertThrow(box.lower[d] >= domain.lower[d] - tolerance &&
                      box.upper[d] <= domain.upper[d] + tolerance,
                    // More digits than the tolerance has.
                    ExcUser(text(std::setprecision(12),
                                 "The body '",
                                 name_,
                                 "' reaches from ",
                                 box.lower[d],
                                 " m to ",
                                 box.upper[d],
                                 " m along axis ",
                                 d,
                                 ", but the mesh only from ",
                                 domain.lower[d],
                                 " m to ",
                                 domain.upper[d],
                                 " m. Make the mesh larger ('Grid/Lower "
                                 "corner', 'Grid/Upper corner') or move the "
                                 "body; or leave out the part beyond by ",
                                 path("Cut by mesh"),
                                 ".")));
      }
  }



  /// Append a point at rest, undeformed and without stress. @p density
  /// in kg/m^3.
  template <int dim>
  void
  Body<dim>::add_point(Points<dim>         &points,
                       const unsigned int   index,
                       const NewPoint<dim> &point,
                       const double         density) const
  {
    const unsigned int p      = points.append(1);
    double             volume = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        volume *= point.length[d];
        points.data(points.position, d)[p]           = point.x[d];
        points.data(points.initial_position, d)[p]   = point.x[d];
        points.data(points.edges, d * (dim + 1))[p]  = point.length[d];
        points.data(points.box_length, d)[p]         = point.length[d];
        points.data(points.length_at_creation, d)[p] = point.length[d];
      }
    points.data(points.reference_volume)[p] = volume;
    points.data(points.mass)[p]             = density * volume;
    points.data(points.body)[p]             = index;
  }



  /// Check for overlap with earlier bodies in the order of Bodies/Names: an
  /// overlap would double the mass, and no later check would notice. Each rank
  /// tests the existing points on the rank; all ranks know the shape.
  template <int dim>
  void
  Body<dim>::check_apart(const Region<dim> &region,
                         const Points<dim> &points) const
  {
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const auto x = load_place(points, points.initial_position, p);
        AssertThrow(!region.contains(x),
                    ExcUser(text("The body '",
                                 name_,
                                 "' contains the point at (",
                                 x,
                                 ") m, which belongs to a body listed before "
                                 "it in Bodies/Names. Bodies must not "
                                 "overlap: move or reshape one of them.")));
      }
  }



  /// Check for points deep inside of solids, where contact would throw the soil
  /// out. Half a diagonal of a box is tolerated, for filling by centres.
  template <int dim>
  void
  Body<dim>::check_clear_of(const Solids                     &solids,
                            const std::vector<NewPoint<dim>> &points) const
  {
    std::vector<Box<dim>> boxes;
    for (const Shape<dim> *solid : solids)
      boxes.push_back(solid->bounding_box());
    const BoxIndex<dim> index(boxes);
    for (const NewPoint<dim> &point : points)
      for (const unsigned int k : index.near(point.x, 0.))
        {
          const Shape<dim> *solid = solids[k];
          const double      depth = -solid->signed_distance(point.x);
          AssertThrow(depth <= 0.5 * point.length.norm(),
                      ExcUser(text("The point at (",
                                   point.x,
                                   ") m of the body '",
                                   name_,
                                   "' lies ",
                                   depth,
                                   " m inside of an obstacle. Set ",
                                   path("Cut by obstacles"),
                                   " = true, or move one of them.")));
        }
  }



  /// Return the number of points per axis, from one number or one per axis.
  template <int dim>
  std::array<unsigned int, dim>
  Body<dim>::points_per_axis() const
  {
    AssertThrow(points_per_cell_.size() == 1 || points_per_cell_.size() == dim,
                ExcUser(text(path("Points per cell and axis"),
                             " lists ",
                             points_per_cell_.size(),
                             " numbers; give one, or one for each of the ",
                             dim,
                             " axes.")));
    std::array<unsigned int, dim> n;
    for (unsigned int d = 0; d < dim; ++d)
      n[d] = points_per_cell_[points_per_cell_.size() == 1 ? 0 : d];
    return n;
  }



  namespace
  {
    /// Return the volume of the points of all ranks, m^dim. Collective.
    template <int dim>
    double
    volume_of(const std::vector<NewPoint<dim>> &points,
              const MPI_Comm                    communicator)
    {
      double sum = 0.;
      for (const NewPoint<dim> &point : points)
        {
          double volume = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            volume *= point.length[d];
          sum += volume;
        }
      return Utilities::MPI::sum(sum, communicator);
    }
  } // namespace



  namespace
  {
    /// Return the @p solids that may take a part of @p shape. A layer that ends
    /// at a surface has no part on the opposite side, the terrain below.
    template <int dim>
    std::vector<const Shape<dim> *>
    solids_that_may_cut(const Shape<dim>                      &shape,
                        const std::vector<const Shape<dim> *> &solids)
    {
      const auto parts      = shape.parts();
      const auto has_no_use = [&parts](const Shape<dim> *solid) {
        const auto *side = dynamic_cast<const SideOfSurface<dim> *>(solid);
        return side != nullptr && std::any_of(parts.begin(),
                                              parts.end(),
                                              [side](const auto *part) {
                                                return side->is_beyond(*part);
                                              });
      };
      std::vector<const Shape<dim> *> result;
      std::remove_copy_if(solids.begin(),
                          solids.end(),
                          std::back_inserter(result),
                          has_no_use);
      return result;
    }
  } // namespace



  /// Make the points. @p others are the points of earlier bodies. The volume
  /// removed by obstacles is the difference to a filling without obstacles: no
  /// volume is lost unnoticed, with any filling. Collective.
  template <int dim>
  typename Body<dim>::Places
  Body<dim>::places_of_points(const Grid<dim>   &grid,
                              const Solids      &solids,
                              const Points<dim> &others) const
  {
    const Box<dim>      &domain = grid.domain_before_growth();
    const auto           shape  = shape_.make(domain);
    const BoxRegion<dim> mesh(domain);
    const Box<dim> bounds = bounding_box(domain), box = shape->bounding_box();
    Region<dim>    region(*shape);
    // An endless shape must not reach into cells added far away.
    if (!(box.lower == bounds.lower && box.upper == bounds.upper))
      region.restrict_to(mesh);
    const auto fill = [&]() {
      return is_clipped()
               ? clipped_filling<dim>(grid, region, bounds, points_per_axis())
               : filling_by_centres<dim>(grid,
                                         region,
                                         bounds,
                                         points_per_axis());
    };
    const Solids cutting =
      cut_by_obstacles_ ? solids_that_may_cut(*shape, solids) : Solids();
    Places result;
    if (!cutting.empty())
      {
        result.uncut_volume = volume_of(fill(), grid.communicator());
        region.cut_away(cutting);
      }
    check_apart(region, others);
    result.points = fill();
    if (!cutting.empty())
      result.volume = volume_of(result.points, grid.communicator());
    else if (!cut_by_obstacles_)
      check_clear_of(solids, result.points);
    return result;
  }



  namespace
  {
    /// Return a note; empty below a millionth: where a body lies on an
    /// obstacle, the two surfaces differ by the error of the piecewise planes.
    /// Volumes in m^dim.
    template <int dim>
    Remark
    note_of_cut(const std::string &name, const double uncut, const double left)
    {
      const double lost = uncut - left;
      if (lost <= 1e-6 * uncut)
        return "";
      // A pipe or a pile in the soil takes less than a tenth.
      return {text(std::setprecision(6),
                   "The obstacles take ",
                   lost,
                   dim == 2 ? " m^2" : " m^3",
                   " of the body '",
                   name,
                   "', ",
                   100. * lost / uncut,
                   " % of the body: no soil is put into obstacles."),
              lost < 0.1 * uncut ? Severity::information : Severity::look};
    }
  } // namespace



  namespace
  {
    /// Report insufficient memory before it runs out. The estimate is a lower
    /// bound: splitting may add points, and the mesh is not counted.
    /// Collective.
    template <int dim>
    void
    check_memory(const Grid<dim>   &grid,
                 const std::size_t  n_points_of_rank,
                 const std::string &body)
    {
      const double n_points =
        Utilities::MPI::sum(1. * n_points_of_rank, grid.communicator());
      const double bytes = n_points * bytes_per_point<dim> /
                           Utilities::MPI::n_mpi_processes(grid.communicator());
      AssertThrow(bytes < grid.memory_per_rank(),
                  ExcUser(text("With the body '",
                               body,
                               "' there would be ",
                               n_points,
                               " points, which take some ",
                               bytes / 1e9,
                               " GB of memory on each rank, where ",
                               grid.memory_per_rank() / 1e9,
                               " GB are available. ",
                               fewer_points_advice)));
    }
  } // namespace



  template <int dim>
  Remark
  Body<dim>::create_points(const Grid<dim>   &grid,
                           const unsigned int index,
                           const double       density,
                           Points<dim>       &points,
                           const Solids      &solids) const
  {
    const Places places = places_of_points(grid, solids, points);
    check_memory(grid, points.size() + places.points.size(), name_);
    for (const NewPoint<dim> &place : places.points)
      add_point(points, index, place, density);
    // Single ranks may have no points.
    AssertThrow(Utilities::MPI::max(places.points.size(), grid.communicator()) >
                  0,
                ExcUser(text("The body '",
                             name_,
                             "' got no points: ",
                             is_clipped() ? "no part of its shape was found"
                                          : "no centre of a point lies in it",
                             cut_by_obstacles_ && !solids.empty()
                               ? " outside of the obstacles"
                               : "",
                             ". Make it larger than a cell (Grid/Cell size) "
                             "or raise ",
                             path("Points per cell and axis"),
                             ".")));
    return note_of_cut<dim>(name_, places.uncut_volume, places.volume);
  }



  template class Body<2>;
  template class Body<3>;
} // namespace talus
