// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/surface_tables.h>

namespace talus
{
  using namespace dealii;

  template <int dim>
  const SurfaceTable<dim> *
  SurfaceTables<dim>::table(const Cell<dim>         &cell,
                            const ContactFacet<dim> &facet)
  {
    const Obstacle<dim> &obstacle = obstacles_[facet.obstacle];
    if (obstacle.moves() || !obstacle.shape().is_costly())
      return nullptr;
    const auto key  = std::make_pair(facet.key, facet.obstacle);
    auto       made = tables_.find(key);
    if (made == tables_.end())
      made =
        tables_.emplace(key, SurfaceTable<dim>(obstacle.shape(), cell.box()))
          .first;
    return made->second.is_accurate() ? &made->second : nullptr;
  }



  template class SurfaceTables<2>;
  template class SurfaceTables<3>;
} // namespace talus
