// SPDX-License-Identifier: LGPL-2.1-or-later
// Points per initial point in homogeneous simple shear, with the real rules for
// reduction, splits and merging. All points of such a flow are equal, so one
// point stands for all; a merge is tried with the two neighbours along each
// edge.

#include <talus/adaptivity/merger.h>
#include <talus/transfer/edge_reduction.h>

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;

  template <int dim>
  class HomogeneousShear : public Core<dim>
  {
  public:
    HomogeneousShear()
      : Core<dim>(cube<dim>())
    {
      dealii::ParameterAcceptor::prm.parse_input_from_string(
        in_section("Splitting", "set Merge = all"));
      dealii::ParameterAcceptor::parse_all_parameters();
      merger.prepare(this->splitter, this->transfer.box_shape());
      Tensor<1, dim> length;
      for (unsigned int d = 0; d < dim; ++d)
        middle[d] = 1.5, length[d] = 0.5;
      this->add(middle, length);
      this->points.data(this->points.reference_volume)[0] =
        dealii::Utilities::fixed_power<dim>(0.5);
      this->sort();
    }

    /// Shear by @p gamma in steps of 0.01. Merges are tried every tenth
    /// of a unit of shear.
    void
    shear(const Tensor<1, dim> &along,
          const Tensor<1, dim> &normal,
          const double          gamma)
    {
      Tensor<2, dim> step = 0.01 * outer_product(along, normal);
      for (unsigned int d = 0; d < dim; ++d)
        step[d][d] += 1.;
      for (unsigned int i = 1; i <= std::lround(100. * gamma); ++i)
        {
          this->set_deformation(0, step * this->deformation(0));
          reduce_edges(this->points, 0, 1, false);
          update_box_lengths(this->points, 0, 1, BoxRule::second_moments);
          if (this->split())
            {
              n_points *= this->points.size();
              keep_first();
            }
          for (unsigned int k = 0; i % 10 == 0 && k < dim; ++k)
            merge_along_edge(k);
        }
    }

    double n_points = 1; ///< per initial point

  private:
    /// Remove all points but the first, and put it back to the middle.
    void
    keep_first()
    {
      auto               &points = this->points;
      std::vector<double> state(points.n_arrays());
      for (unsigned int a = 0; a < state.size(); ++a)
        state[a] = points.data(a)[0];
      points.clear();
      points.append(1);
      for (unsigned int a = 0; a < state.size(); ++a)
        points.data(a)[0] = state[a];
      points.data(points.generation)[0] = 0.;
      this->set(points.position, 0, middle);
      this->sort();
    }

    /// Try to merge two points side by side along edge @p k.
    void
    merge_along_edge(const unsigned int k)
    {
      auto                &points = this->points;
      const Tensor<1, dim> half   = 0.5 * edge_of_cell(points, k, 0);
      if (half.norm() > 0.4)
        return;
      points.copy(0, points.append(1));
      points.data(points.id)[1] = 1.;
      this->set(points.position, 0, middle - half);
      this->set(points.position, 1, middle + half);
      this->sort();
      merger.merge(
        points, this->grid, BoxRule::second_moments, {}, this->splitter);
      if (points.size() == 1)
        n_points /= 2.;
      keep_first();
    }

    Merger<dim> merger;
    Point<dim>  middle;
  };



  template <int dim>
  Tensor<1, dim>
  random_direction(std::mt19937 &random)
  {
    std::normal_distribution<double> number;
    Tensor<1, dim>                   v;
    for (unsigned int d = 0; d < dim; ++d)
      v[d] = number(random);
    return v / v.norm();
  }



  /// Points per initial point at the end of shear by 50, as a mean over random
  /// planes.
  template <int dim>
  double
  mean_in_random_directions(const unsigned int n)
  {
    std::mt19937 random(1);
    double       mean = 0;
    for (unsigned int i = 0; i < n; ++i)
      {
        const Tensor<1, dim> along  = random_direction<dim>(random);
        Tensor<1, dim>       normal = random_direction<dim>(random);
        normal -= (normal * along) * along;
        normal /= normal.norm();
        HomogeneousShear<dim> flow;
        flow.shear(along, normal, 50.);
        mean += flow.n_points / n;
      }
    return mean;
  }
} // namespace



// Shear along the rows never splits.
TEST(HomogeneousShear, AlongTheRows)
{
  HomogeneousShear<2> flow;
  flow.shear(Tensor<1, 2>({1., 0.}), Tensor<1, 2>({0., 1.}), 50.);
  EXPECT_EQ(flow.n_points, 1.);
}



TEST(HomogeneousShear, AtAnAngleOf45Degrees)
{
  const double        c = std::sqrt(0.5);
  HomogeneousShear<2> flow;
  flow.shear(Tensor<1, 2>({c, c}), Tensor<1, 2>({-c, c}), 50.);
  EXPECT_LE(flow.n_points, 3.);
}



// A general shear stretches the lattice for good reason, and only merging gives
// the points back. Single cells are long for a while, with 16 points; many
// planes separate the mean from such chances.
TEST(HomogeneousShear, PointsStayFewInAnyDirection)
{
  EXPECT_LE(mean_in_random_directions<2>(64), 3.);
  const double n = mean_in_random_directions<3>(64);
  RecordProperty("points", std::to_string(n));
  EXPECT_LE(n, 3.);
}
