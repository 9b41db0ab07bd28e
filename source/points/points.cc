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
    , creation_stretch(
        add_column("creation stretch", "-", dim, Inheritance::copied))
    , initial_position(
        add_column("initial position", "m", dim, Inheritance::copied))
    , elastic_energy(add_column("elastic energy", "J", 1, Inheritance::divided))
    , plastic_work(add_column("plastic work", "J", 1, Inheritance::divided))
    , id(add_column("id", "-", 1, Inheritance::copied))
    , generation(add_column("generation", "-", 1, Inheritance::copied))
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
    for (unsigned int c = 0; c < n_components; ++c)
      arrays_.emplace_back(capacity_ + n_lanes, 0.);
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



  namespace
  {
    /// AlignedVector::resize() would take twice the memory when it grows.
    void
    enlarge(AlignedVector<double> &array, const unsigned int size)
    {
      AlignedVector<double> larger(size, 0.);
      std::copy(array.begin(), array.end(), larger.begin());
      array.swap(larger);
    }
  } // namespace



  template <int dim>
  void
  Points<dim>::reserve(const unsigned int n)
  {
    if (n <= capacity_)
      return;
    // Little by little, as most of the memory of a run is here. A step over
    // all points costs about as much as making all arrays larger.
    capacity_ = std::max(n, capacity_ + capacity_ / 8);
    for (auto &array : arrays_)
      enlarge(array, capacity_ + n_lanes);
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
    for (auto &array : arrays_)
      std::fill(array.begin() + first, array.begin() + size_, 0.);
    return first;
  }



  template <int dim>
  void
  Points<dim>::copy(const unsigned int from, const unsigned int to)
  {
    for (auto &array : arrays_)
      array[to] = array[from];
  }



  namespace
  {
    /// Since the runs keep their order, each lands between its neighbours: those
    /// that go down, first to last, and then those that go up, last to first,
    /// never overwrite one that is still to move.
    void
    move_runs(double *array, const std::vector<Shift> &shifts)
    {
      for (const Shift &s : shifts)
        if (s.to < s.begin)
          std::copy(array + s.begin, array + s.end, array + s.to);
      for (auto s = shifts.rbegin(); s != shifts.rend(); ++s)
        if (s->to > s->begin)
          std::copy_backward(array + s->begin,
                             array + s->end,
                             array + s->to + (s->end - s->begin));
    }
  } // namespace



  template <int dim>
  void
  Points<dim>::reorder(const std::vector<Shift> &shifts,
                       const std::vector<Jump>  &jumps,
                       std::vector<Segment>     &segments)
  {
    jumping_.resize(jumps.size());
    for (auto &array : arrays_)
      {
        for (std::size_t i = 0; i < jumps.size(); ++i)
          jumping_[i] = array[jumps[i].from];
        move_runs(array.data(), shifts);
        for (std::size_t i = 0; i < jumps.size(); ++i)
          array[jumps[i].to] = jumping_[i];
      }
    segments_.swap(segments);
    Assert(n_sorted() <= size_, ExcInternalError());
    size_ = n_sorted();
  }



  template <int dim>
  std::size_t
  Points<dim>::memory_consumption() const
  {
    return (arrays_.size() * (capacity_ + n_lanes) +
            workspace_.size() * workspace_[0].size()) *
             sizeof(double) +
           segments_.capacity() * sizeof(Segment);
  }



  template class Points<2>;
  template class Points<3>;
} // namespace talus
