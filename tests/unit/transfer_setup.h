// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef transfer_setup_h
#define transfer_setup_h

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  /// Many points in random states: more than fill a block (64) in some cells,
  /// few in others, boxes clipped and not, across the faces of the mesh.
  template <int dim>
  void
  fill_with_points(Core<dim> &core, const bool hanging_nodes)
  {
    if (hanging_nodes)
      refine_corner(core);
    core.transfer.use_bbar({true, false, true});
    core.add_cloud(dim == 2 ? 500 : 700, 3);
    for (unsigned int i = 0; i < 300; ++i)
      {
        // Two crowds in cells that follow each other, and at two faces.
        Point<dim> x = Point<dim>() + core.vector(0.01, 0.99);
        x[0] += 2. + (i % 3 == 0);
        core.randomize(core.add(x, core.vector(0.05, 1.1), i % 2));
      }
    core.sort();
    for (auto &acceleration : core.loads.acceleration_of_body)
      acceleration = core.vector(-10., 10.);
    core.loads.varies = true;
    for (auto &row : core.loads.acceleration_of_point)
      row.resize(core.points.size() + Points<dim>::n_spare);
    for (unsigned int p = 0; p < core.points.size(); ++p)
      for (unsigned int d = 0; d < dim; ++d)
        core.loads.acceleration_of_point[d][p] = core.number(-5., 5.);
  }



  /// Boxes parallel to the axes, which go in blocks, and domains that are not.
  inline const std::array<std::string, 2> box_rules = {
    {"set Box rule = axis-parallel", "set Box rule = convected domain"}};



  /// Run the test on a uniform mesh and on one with hanging nodes.
  template <int dim, typename Action>
  void
  on_both_meshes(const std::string &parameters, const Action &action)
  {
    for (const bool hanging_nodes : {false, true})
      {
        SCOPED_TRACE(text(dim, "-D, hanging nodes: ", hanging_nodes));
        Core<dim> core(cube<dim>() + parameters);
        fill_with_points(core, hanging_nodes);
        action(core);
      }
  }



  template <int dim>
  Tensor<1, dim>
  acceleration(Core<dim> &core, const unsigned int p)
  {
    Tensor<1, dim> b =
      core.loads.acceleration_of_body[static_cast<unsigned int>(
        core.points.data(core.points.body)[p])];
    for (unsigned int d = 0; d < dim; ++d)
      b[d] += core.loads.acceleration_of_point[d][p];
    return b;
  }
} // namespace

#endif
