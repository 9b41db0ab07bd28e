#ifndef talus_boundaries_boundaries_h
#define talus_boundaries_boundaries_h

#include <talus/boundaries/boundary_work.h>
#include <talus/boundaries/seabed.h>
#include <talus/grid/nodal_fields.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <string>

namespace talus
{
  enum class FaceCondition
  {
    free,    ///< nothing; a point that crosses the face has left
    roller,  ///< no motion along the normal, in either direction
    fixed,   ///< no motion
    seabed,  ///< one-sided contact with friction
    periodic ///< what leaves here enters through the opposite face
  };

  /// Conditions on the faces of the mesh.
  template <int dim>
  class Boundaries : public dealii::ParameterAcceptor
  {
  public:
    Boundaries();

    FaceCondition
    condition(const unsigned int face) const
    {
      return conditions_[face];
    }

    /// Axes whose two faces are periodic. Throws ExcUser if only one is.
    std::array<bool, dim>
    periodic_axes() const;

    /// Change the velocities of the active nodes on the faces as their
    /// conditions ask, after the momentum update of a step of @p dt. Nodes with
    /// less than @p least_mass carry nothing and are left alone.
    BoundaryWork<dim>
    apply(NodalFields<dim> &nodes,
          const Grid<dim>  &grid,
          double            dt,
          double            least_mass) const;

  private:
    void
    apply_to_node(NodalFields<dim>  &nodes,
                  const Grid<dim>   &grid,
                  unsigned int       node,
                  double             dt,
                  BoundaryWork<dim> &work) const;

    std::array<std::string, 2 * dim>   names_;
    std::array<FaceCondition, 2 * dim> conditions_;
    Seabed<dim>                        seabed_;
  };
} // namespace talus

#endif
