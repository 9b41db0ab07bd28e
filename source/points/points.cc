#include <talus/base/errors.h>
#include <talus/points/points.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Points<dim>::Points()
  {
    const auto add = [this](const unsigned int expected,
                            const std::string &name,
                            const std::string &unit,
                            const unsigned int n_components,
                            const Inheritance  inheritance) {
      const unsigned int first =
        add_column(name, unit, n_components, inheritance);
      AssertDimension(first, expected);
      (void)first;
      (void)expected;
    };
    constexpr auto copied = Inheritance::copied, divided = Inheritance::divided;
    using C = PointColumns<dim>;
    add(C::position, "position", "m", dim, copied);
    add(C::velocity, "velocity", "m/s", dim, copied);
    add(
      C::deformation_gradient, "deformation gradient", "-", dim * dim, copied);
    add(C::stress, "stress", "Pa", n_stress_components<dim>, copied);
    add(C::mass, "mass", "kg", 1, divided);
    add(C::reference_volume, "reference volume", "m^dim", 1, divided);
    add(C::reference_length, "reference length", "m", dim, copied);
    add(C::stretch, "stretch", "-", dim, copied);
    add(C::elastic_energy, "elastic energy", "J", 1, divided);
    add(C::plastic_work, "plastic work", "J", 1, divided);
    add(C::creation_stretch, "creation stretch", "-", dim, copied);
    add(C::generation, "generation", "-", 1, copied);
    add(C::initial_position, "initial position", "m", dim, copied);
    add(C::id, "id", "-", 1, copied);
    add(C::body, "body", "-", 1, copied);
  }



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
    arrays_.reshape(first + n_components, capacity_ + n_spare);
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
    arrays_.reshape(arrays_.size(), capacity_ + n_spare);
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
           segments_.capacity() * sizeof(Segment);
  }



  template class Points<2>;
  template class Points<3>;
} // namespace talus
