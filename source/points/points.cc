// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/base/errors.h>
#include <talus/points/points.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  /// Add the columns of every point in the order of PointColumns: kernels know
  /// the indices at compile time, and columns used first in a step come first,
  /// for fetch_ahead().
  template <int dim>
  Points<dim>::Points()
  {
    const auto add = [this](const unsigned int expected,
                            const std::string &name,
                            const std::string &unit,
                            const ColumnKind   kind,
                            const Inheritance  inheritance) {
      const unsigned int first = add_column(name, unit, kind, inheritance);
      TalusAssert(first == expected,
                  dealii::ExcDimensionMismatch(first, expected));
      (void)first;
      (void)expected;
    };
    constexpr auto copied = Inheritance::copied, divided = Inheritance::divided;
    constexpr auto scalar = ColumnKind::scalars, vector = ColumnKind::vector,
                   symmetric = ColumnKind::symmetric_tensor,
                   tensor    = ColumnKind::tensor;
    const std::string volume = (dim == 2 ? "m^2" : "m^3");
    using C                  = PointColumns<dim>;
    add(C::position, "position", "m", vector, copied);
    add(C::velocity, "velocity", "m/s", vector, copied);
    add(C::edges, "edges", "m", tensor, copied);
    add(C::stress, "stress", "Pa", symmetric, copied);
    add(C::mass, "mass", "kg", scalar, divided);
    add(C::reference_volume, "reference volume", volume, scalar, divided);
    add(C::box_length, "box length", "m", vector, copied);
    add(C::elastic_energy, "elastic energy", "J", scalar, divided);
    add(C::plastic_work, "plastic work", "J", scalar, divided);
    add(C::length_at_creation, "length at creation", "m", vector, copied);
    add(C::generation, "generation", "-", scalar, copied);
    add(C::initial_position, "initial position", "m", vector, copied);
    add(C::id, "id", "-", scalar, copied);
    add(C::body, "body", "-", scalar, copied);
  }



  template <int dim>
  unsigned int
  Points<dim>::add_column(const std::string &name,
                          const std::string &unit,
                          const ColumnKind   kind,
                          const Inheritance  inheritance)
  {
    const unsigned int n_components =
      (kind == ColumnKind::scalars            ? 1
       : kind == ColumnKind::vector           ? dim
       : kind == ColumnKind::symmetric_tensor ? n_stress_components<dim>
                                              : dim * dim);
    return add({name, unit, kind, n_components, inheritance, 0});
  }



  template <int dim>
  unsigned int
  Points<dim>::add_column(const std::string &name,
                          const std::string &unit,
                          const unsigned int n_scalars,
                          const Inheritance  inheritance)
  {
    return add({name, unit, ColumnKind::scalars, n_scalars, inheritance, 0});
  }



  /// Add a column or share an existing one. Bodies of one material, and
  /// materials of one law, add the same column: shape and inheritance must
  /// agree.
  template <int dim>
  unsigned int
  Points<dim>::add(const Column &column)
  {
    for (const Column &old : columns_)
      if (old.name == column.name)
        {
          AssertThrow(old.kind == column.kind &&
                        old.n_components == column.n_components &&
                        old.inheritance == column.inheritance,
                      ExcInternalError("Column '" + column.name +
                                       "' exists with another shape."));
          return old.first;
        }
    // All arrays move: views of the points become invalid.
    columns_.push_back(column);
    columns_.back().first = arrays_.size();
    arrays_.reshape(arrays_.size() + column.n_components, capacity_ + n_spare);
    return columns_.back().first;
  }



  template <int dim>
  void
  Points<dim>::add_pore_pressure()
  {
    pore_pressure_ =
      add_column("excess pore pressure", "Pa", 1, Inheritance::copied);
    overburden_ =
      add_column("overburden at rest", "Pa", 1, Inheritance::copied);
  }



  /// A search by name, for code that did not add the column: call before a loop
  /// over points, not within.
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
    // Growth in small increments, since most of the memory of a run is here.
    // Reallocation costs about as much as a step over all points.
    capacity_ = std::max(n, capacity_ + capacity_ / 8);
    arrays_.reshape(arrays_.size(), capacity_ + n_spare);
  }



  // Appended behind the sorted points, so that segments remain valid;
  // Relocation sorts the new points in.
  template <int dim>
  unsigned int
  Points<dim>::append(const unsigned int n)
  {
    // Always zeroed: the memory may contain old data of points sent to another
    // rank.
    const unsigned int first = size_;
    reserve(size_ + n);
    size_ += n;
    for (unsigned int a = 0; a < arrays_.size(); ++a)
      std::fill(arrays_[a] + first, arrays_[a] + size_, 0.);
    return first;
  }



  /// Copy all columns, so that splitting works for columns added by laws.
  template <int dim>
  void
  Points<dim>::copy(const unsigned int from, const unsigned int to)
  {
    for (unsigned int a = 0; a < arrays_.size(); ++a)
      arrays_[a][to] = arrays_[a][from];
  }



  /// Reorders in place, without a second set of arrays: few points change their
  /// cell in a step, and a second set would double the memory of the run.
  /// Entries behind the last point are undefined.
  template <int dim>
  void
  Points<dim>::reorder(const std::vector<BlockMove>   &block_moves,
                       const std::vector<ElementMove> &element_moves,
                       std::vector<Segment>           &segments)
  {
    arrays_.move(block_moves, element_moves);
    segments_.swap(segments);
    TalusAssert(n_sorted() <= size_, ExcInternalError());
    size_ = n_sorted();
  }



  /// Includes spare entries behind the points and between the rows.
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
