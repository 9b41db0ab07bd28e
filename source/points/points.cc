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



  template <int dim>
  void
  Points<dim>::reserve(const unsigned int n)
  {
    if (n <= capacity_)
      return;
    capacity_ = std::max(n, capacity_ + capacity_ / 2);
    for (auto &array : arrays_)
      array.resize(capacity_ + n_lanes, 0.);
    reordered_.resize(capacity_ + n_lanes, 0.);
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



  template <int dim>
  void
  Points<dim>::reorder(const std::vector<Run>     &runs,
                       const std::vector<Segment> &segments)
  {
    unsigned int n = 0;
    for (const Run &run : runs)
      n += run.end - run.begin;
    for (auto &array : arrays_)
      {
        double *to = reordered_.begin();
        for (const Run &run : runs)
          to =
            std::copy(array.begin() + run.begin, array.begin() + run.end, to);
        array.swap(reordered_);
      }
    size_     = n;
    segments_ = segments;
    Assert(n_sorted() == size_, ExcInternalError());
  }



  template <int dim>
  std::size_t
  Points<dim>::memory_consumption() const
  {
    return ((arrays_.size() + 1) * (capacity_ + n_lanes) +
            workspace_.size() * workspace_[0].size()) *
           sizeof(double);
  }



  template class Points<2>;
  template class Points<3>;
} // namespace talus
