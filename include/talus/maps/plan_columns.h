// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_plan_columns_h
#define talus_maps_plan_columns_h

#include <talus/base/box.h>

#include <array>
#include <vector>

namespace talus
{
  /// Boxes as they are seen from above, of several items (points, facets).
  template <int dim>
  struct Footprints
  {
    /// Along each axis of the plan, x and z: the middle of each item's box, and
    /// half of its width; m.
    std::array<std::vector<double>, dim - 1> centre, half;

    void
    resize(const unsigned int n)
    {
      for (unsigned int a = 0; a < dim - 1; ++a)
        {
          centre[a].resize(n);
          half[a].resize(n);
        }
    }

    unsigned int
    size() const
    {
      return centre[0].size();
    }
  };



  /// Axis of the mesh that is axis @p a of the plan: x, z.
  template <int dim>
  constexpr unsigned int
  axis_of_plan(const unsigned int a)
  {
    return a == 0 ? 0 : dim - 1;
  }



  /// What a column has of an item's box.
  struct ColumnShare
  {
    unsigned int item;
    unsigned int column;
    double       share; ///< of the box's volume [-]
  };



  /// A list of them that grows in place, number by number: std::vector copies
  /// each one as a whole right after its parts were written, for which the
  /// processor waits longer than for all the rest.
  class ColumnShares
  {
  public:
    void
    clear()
    {
      n_ = 0;
    }

    void
    add(const unsigned int item, const unsigned int column, const double share)
    {
      if (n_ == shares_.size())
        shares_.resize(2 * n_ + 64);
      ColumnShare &next = shares_[n_++];
      next.item         = item;
      next.column       = column;
      next.share        = share;
    }

    const ColumnShare *
    begin() const
    {
      return shares_.data();
    }

    const ColumnShare *
    end() const
    {
      return shares_.data() + n_;
    }

  private:
    std::vector<ColumnShare> shares_;
    std::size_t              n_ = 0;
  };



  /// Columns, all of the same section, that stand on the plan: x in 2-D, x and z
  /// in 3-D. What they hold is what lies above or below their section, whatever
  /// its height.
  template <int dim>
  class PlanColumns
  {
  public:
    virtual ~PlanColumns() = default;

    virtual unsigned int
    size() const = 0;

    /// Of the section of a column, m^(dim-1).
    virtual double
    area() const = 0;

    /// The middle of a column's section, at y = 0, m.
    virtual dealii::Point<dim>
    centre(unsigned int column) const = 0;

    /// Whether a box can reach any of them; true if in doubt.
    virtual bool
    may_reach(const Box<dim> &box) const = 0;

    /// Append the columns that boxes reach, with their shares of these. A box
    /// without width along an axis belongs to the column it lies in.
    virtual void
    find_shares(const Footprints<dim> &footprints,
                ColumnShares          &shares) const = 0;
  };



  /// Columns side by side, row by row: x fastest, then z. What lies outside of
  /// them all counts to the outermost ones, so that nothing is lost.
  template <int dim>
  class LatticeColumns : public PlanColumns<dim>
  {
  public:
    /// Along one axis of the plan.
    struct Axis
    {
      double       lower  = 0; ///< outer face of the first column, m
      double       size   = 1; ///< of a column, m
      unsigned int number = 1; ///< of columns
    };

    /// x, and in 3-D z.
    explicit LatticeColumns(const std::array<Axis, dim - 1> &axes)
      : axes_(axes)
    {}

    unsigned int
    size() const override;
    double
    area() const override;
    dealii::Point<dim>
    centre(unsigned int column) const override;

    bool
    may_reach(const Box<dim> & /*box*/) const override
    {
      return true;
    }

    void
    find_shares(const Footprints<dim> &footprints,
                ColumnShares          &shares) const override;

  private:
    std::array<Axis, dim - 1> axes_;
  };



  /// Columns whose sections are squares (in 2-D intervals) anywhere, which may
  /// overlap.
  template <int dim>
  class SquareColumns : public PlanColumns<dim>
  {
  public:
    /// @p centres, whose y does not count; @p width in m.
    SquareColumns(const std::vector<dealii::Point<dim>> &centres, double width);

    unsigned int
    size() const override
    {
      return centres_.size();
    }

    double
    area() const override;

    dealii::Point<dim>
    centre(const unsigned int column) const override
    {
      return centres_[column];
    }

    bool
    may_reach(const Box<dim> &box) const override;

    void
    find_shares(const Footprints<dim> &footprints,
                ColumnShares          &shares) const override;

  private:
    /// In by_x_, the first one whose centre is not in front of @p x, m.
    std::vector<unsigned int>::const_iterator
    first_behind(double x) const;

    std::vector<dealii::Point<dim>> centres_;
    double                          width_;
    std::vector<unsigned int>       by_x_; ///< columns by growing x
  };
} // namespace talus

#endif
