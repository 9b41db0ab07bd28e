// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_plan_columns_h
#define talus_maps_plan_columns_h

#include <talus/base/box.h>

#include <array>
#include <cmath>
#include <vector>

namespace talus
{
  /// Boxes of several items (points, facets) in plan view.
  template <int dim>
  struct Footprints
  {
    /// Along each axis of the plan, x and z: the centre and the half width of
    /// the box of each item, m.
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



  /// Return the axis of the mesh for axis @p a of the plan: x, z.
  template <int dim>
  constexpr unsigned int
  axis_of_plan(const unsigned int a)
  {
    return a == 0 ? 0 : dim - 1;
  }



  /// Fraction of the box of an item inside a column.
  struct ColumnShare
  {
    unsigned int item;
    unsigned int column;
    double       share; ///< fraction of the box volume [-]
  };



  /// Growing list of ColumnShare, written in place, member by member:
  /// std::vector::push_back copies each element right after writing its
  /// members, and the processor stalls longer on the copy than all other work
  /// takes.
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



  /// Columns of equal section in plan: x in 2-D, x and z in 3-D. A column
  /// extends to any height above and below the section.
  template <int dim>
  class PlanColumns
  {
  public:
    virtual ~PlanColumns() = default;

    virtual unsigned int
    size() const = 0;

    /// Area of the section of a column, m^(dim-1).
    virtual double
    area() const = 0;

    /// Centre of the section of a column, at y = 0, m.
    virtual dealii::Point<dim>
    centre(unsigned int column) const = 0;

    /// Return whether a box can overlap any column; true if in doubt.
    virtual bool
    may_reach(const Box<dim> &box) const = 0;

    /// Append the columns overlapped by each box, with the fraction of the box
    /// in each column. A box without width along an axis belongs to the column
    /// around the centre.
    virtual void
    find_shares(const Footprints<dim> &footprints,
                ColumnShares          &shares) const = 0;
  };



  /// Adjacent columns, numbered row by row: x fastest, then z. Soil outside of
  /// all columns is assigned to the outermost columns, so that nothing is lost.
  template <int dim>
  class LatticeColumns : public PlanColumns<dim>
  {
  public:
    /// Columns along an axis of the plan.
    struct Axis
    {
      double       lower  = 0; ///< outer face of the first column, m
      double       size   = 1; ///< width of a column, m
      unsigned int number = 1; ///< number of columns
    };

    /// @p axes are x, and in 3-D z.
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



  /// Columns with square sections (in 2-D intervals) at arbitrary positions,
  /// possibly overlapping.
  template <int dim>
  class SquareColumns : public PlanColumns<dim>
  {
  public:
    /// @p centres of the columns, m (y is ignored); @p width of the columns, m.
    SquareColumns(const std::vector<dealii::Point<dim>> &centres, double width);

    unsigned int
    size() const override
    {
      return centres_.size();
    }

    double
    area() const override
    {
      return std::pow(width_, dim - 1);
    }

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
    /// First column in by_x_ with centre coordinate not less than @p x, m.
    std::vector<unsigned int>::const_iterator
    first_behind(double x) const;

    std::vector<dealii::Point<dim>> centres_;
    double                          width_;
    std::vector<unsigned int>       by_x_; ///< columns sorted by x
  };
} // namespace talus

#endif
