// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_layer_ends_h
#define talus_problem_layer_ends_h

#include <talus/problem/bodies.h>

#include <array>
#include <string>

namespace talus
{
  /// Surroundings of the layers at the start.
  template <int dim>
  struct LayerSite
  {
    Box<dim>                   domain;    ///< box of the parameters
    double                     cell_size; ///< m
    typename Body<dim>::Solids solids;
    /// Whether a face of the mesh carries no load, by face (see face_names).
    std::array<bool, 2 * dim> is_free;
  };



  /// Look for parts of a layer that the faces of the mesh cut off. Throws
  /// ExcUser at a free face, unless the layer has corners there: nothing would
  /// hold the soil. Returns a remark on a part below a bottom that carries
  /// load. Empty if there is no such part, if the layer has no end below the
  /// bottom, and for all further shapes.
  template <int dim>
  std::string
  check_cut_by_mesh(const Body<dim> &body, const LayerSite<dim> &site);

  /// Return a remark if the layer number @p b of @p bodies ends inside of the
  /// mesh in a free face, higher than a cell, without obstacle or body beyond;
  /// empty otherwise, and for other shapes.
  template <int dim>
  std::string
  note_on_free_end(const typename Bodies<dim>::List &bodies,
                   unsigned int                      b,
                   const LayerSite<dim>             &site);
} // namespace talus

#endif
