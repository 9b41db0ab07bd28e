// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_surface_tables_h
#define talus_contact_surface_tables_h

#include <talus/contact/facets.h>
#include <talus/contact/surface_table.h>

#include <map>
#include <utility>

namespace talus
{
  /// Tables of costly obstacles at rest, by cell. A table is made when it is
  /// asked for first: the cost follows the soil, not the mesh.
  template <int dim>
  class SurfaceTables
  {
  public:
    explicit SurfaceTables(const Obstacles<dim> &obstacles)
      : obstacles_(obstacles)
    {}

    /// Return the table of the obstacle of @p facet in @p cell; nullptr if the
    /// distance needs no table or no table is accurate. Valid until limit().
    const SurfaceTable<dim> *
    table(const Cell<dim> &cell, const ContactFacet<dim> &facet);

    /// Forget all tables if there are more than @p n and many: memory stays in
    /// proportion to @p n. Tables are made again with the same values.
    void
    limit(const std::size_t n)
    {
      if (tables_.size() > std::max<std::size_t>(20000, n))
        tables_.clear();
    }

  private:
    const Obstacles<dim> &obstacles_;
    /// By key of the cell and obstacle.
    std::map<std::pair<unsigned long, unsigned int>, SurfaceTable<dim>> tables_;
  };
} // namespace talus

#endif
