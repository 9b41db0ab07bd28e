// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/key_halves.h>
#include <talus/boundaries/normal_force_memory.h>
#include <talus/grid/node_places.h>

#include <deal.II/base/mpi.h>

#include <map>

namespace talus
{
  using namespace dealii;

  // Each rank gets the means of all ranks and keeps the means of its own nodes:
  // nodes with soil on a seabed are few, and the mesh changes seldom.
  template <int dim>
  void
  NormalForceMemory<dim>::prepare(const Grid<dim>    &grid,
                                  const unsigned char faces)
  {
    if (faces == 0)
      return;
    std::vector<double> all;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(grid.communicator(), rows()))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    means_.clear();
    const std::vector<unsigned long> keys = keys_of_owned_nodes(grid);
    for (unsigned int face = 0; face < 2 * dim; ++face)
      {
        index_[face].clear();
        if (!(faces & (1u << face)))
          continue;
        for (unsigned int node = 0; node < keys.size(); ++node)
          if (grid.faces_of_node(node) & (1u << face))
            {
              index_[face][node] = means_.size();
              means_.push_back({keys[node], face, node});
            }
      }
    take(all);
  }



  template <int dim>
  void
  NormalForceMemory<dim>::begin_step()
  {
    if (!restored_.empty())
      {
        take(restored_);
        restored_.clear();
      }
    ++step_;
  }



  template <int dim>
  double
  NormalForceMemory<dim>::update(const unsigned int number,
                                 const double       force,
                                 const double       weight)
  {
    Mean &mean = means_[number];
    mean.force =
      (mean.step + 1 == step_ ? mean.force + weight * (force - mean.force)
                              : force);
    mean.step = step_;
    return mean.force;
  }



  /// Return the means for the next step, a row each: key of the place of the
  /// node (halves_of_key()), face, force.
  template <int dim>
  std::vector<double>
  NormalForceMemory<dim>::rows() const
  {
    if (!restored_.empty())
      return restored_;
    std::vector<double> rows;
    for (const Mean &mean : means_)
      if (mean.step == step_)
        {
          const auto [upper, lower] = halves_of_key(mean.key);
          rows.insert(rows.end(),
                      {upper, lower, double(mean.face), mean.force});
        }
    return rows;
  }



  template <int dim>
  void
  NormalForceMemory<dim>::take(const std::vector<double> &rows)
  {
    std::map<std::array<double, 3>, double> force_of;
    for (std::size_t r = 0; r < rows.size(); r += n_columns)
      force_of[{{rows[r], rows[r + 1], rows[r + 2]}}] = rows[r + 3];
    for (Mean &mean : means_)
      {
        const auto [upper, lower] = halves_of_key(mean.key);
        if (const auto found =
              force_of.find({{upper, lower, double(mean.face)}});
            found != force_of.end())
          {
            mean.force = found->second;
            mean.step  = step_;
          }
      }
  }



  template <int dim>
  void
  NormalForceMemory<dim>::list_state(StateList &list)
  {
    list.add_table(
      {"mean normal forces on the seabed",
       "key of the place of the node: upper and lower 32 bits; face; mean "
       "normal force [N]",
       n_columns,
       [this]() { return rows(); },
       [this](const std::vector<double> &rows) { restored_ = rows; }});
  }



  template class NormalForceMemory<2>;
  template class NormalForceMemory<3>;
} // namespace talus
