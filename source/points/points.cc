#include <talus/base/errors.h>
#include <talus/points/points.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Points<dim>::Points()
    : position(add_column("position", "m", dim, Inheritance::copied))
    , velocity(add_column("velocity", "m/s", dim, Inheritance::copied))
    , deformation_gradient(
        add_column("deformation gradient", "-", dim * dim, Inheritance::copied))
    , stress(add_column(
        "stress", "Pa", n_stress_components<dim>, Inheritance::copied))
    , mass(add_column("mass", "kg", 1, Inheritance::divided))
    , reference_volume(
        add_column("reference volume", "m^dim", 1, Inheritance::divided))
    , reference_length(
        add_column("reference length", "m", dim, Inheritance::copied))
    , stretch(add_column("stretch", "-", dim, Inheritance::copied))
    , elastic_energy(add_column("elastic energy", "J", 1, Inheritance::divided))
    , plastic_work(add_column("plastic work", "J", 1, Inheritance::divided))
    , creation_stretch(
        add_column("creation stretch", "-", dim, Inheritance::copied))
    , generation(add_column("generation", "-", 1, Inheritance::copied))
    , initial_position(
        add_column("initial position", "m", dim, Inheritance::copied))
    , id(add_column("id", "-", 1, Inheritance::copied))
    , body(add_column("body", "-", 1, Inheritance::copied))
  {}



  template <int dim>
  unsigned int
  Points<dim>::add_column(const std::string &name,
                          const std::string &unit,
                          const unsigned int n_components,
                          const Inheritance  inheritance)
  {
    for (const Column &column : columns_)
      if (column.name == name)
        {
          AssertThrow(column.n_components == n_components &&
                        column.inheritance == inheritance,
                      ExcInternalError("Column '" + name +
                                       "' exists with another shape."));
          return column.first;
        }
    const unsigned int first = arrays_.size();
    columns_.push_back({name, unit, n_components, inheritance, first});
    arrays_.reshape(first + n_components, capacity_ + n_lanes);
    return first;
  }



  template <int dim>
  unsigned int
  Points<dim>::find(const std::string &name) const
  {
    for (const Column &column : columns_)
      if (column.name == name)
        return column.first;
    AssertThrow(false, ExcMessage("Points have no column '" + name + "'."));
    return numbers::invalid_unsigned_int;
  }



  template <int dim>
  void
  Points<dim>::reserve(const unsigned int n)
  {
    if (n <= capacity_)
      return;
    // Little by little, as most of the memory of a run is here. A step over
    // all points costs about as much as making all arrays larger.
    capacity_ = std::max(n, capacity_ + capacity_ / 8);
    arrays_.reshape(arrays_.size(), capacity_ + n_lanes);
  }



  template <int dim>
  void
  Points<dim>::lend_workspace(const unsigned int begin, const unsigned int end)
  {
    workspace_begin_    = begin;
    const std::size_t n = end - begin + n_lanes;
    if (workspace_[0].size() < n)
      for (auto &row : workspace_)
        row.resize(n, 0.);
  }



  template <int dim>
  unsigned int
  Points<dim>::append(const unsigned int n)
  {
    const unsigned int first = size_;
    reserve(size_ + n);
    size_ += n;
    for (unsigned int a = 0; a < arrays_.size(); ++a)
      std::fill(arrays_[a] + first, arrays_[a] + size_, 0.);
    return first;
  }



  template <int dim>
  void
  Points<dim>::copy(const unsigned int from, const unsigned int to)
  {
    for (unsigned int a = 0; a < arrays_.size(); ++a)
      arrays_[a][to] = arrays_[a][from];
  }



  template <int dim>
  void
  Points<dim>::reorder(const std::vector<Shift> &shifts,
                       const std::vector<Jump>  &jumps,
                       std::vector<Segment>     &segments)
  {
    arrays_.move(shifts, jumps);
    segments_.swap(segments);
    Assert(n_sorted() <= size_, ExcInternalError());
    size_ = n_sorted();
  }



  template <int dim>
  std::size_t
  Points<dim>::memory_consumption() const
  {
    return arrays_.memory_consumption() +
           workspace_.size() * workspace_[0].size() * sizeof(double) +
           segments_.capacity() * sizeof(Segment);
  }



  template class Points<2>;
  template class Points<3>;
} // namespace talus
