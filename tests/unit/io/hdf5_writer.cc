// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/observers/grid_output.h>
#include <talus/observers/output.h>
#include <talus/observers/points_output.h>
#include <talus/points/points_kernel.h>

#include <boost/property_tree/xml_parser.hpp>

#include <set>

#include "hdf5_reading.h"
#include "observers_setup.h"

namespace
{
  using namespace talus;
  namespace fs = std::filesystem;
  using boost::property_tree::ptree;

  class Hdf5Test : public ObserversTest
  {
  protected:
    /// Two points with different values in all columns.
    template <int dim>
    void
    add_points(Scene<dim> &s)
    {
      s.points.add_column("yield stress", "Pa", 1, Inheritance::copied);
      s.points.add_column("two things", "m", 5, Inheritance::copied);
      s.points.add_column("deformation gradient",
                          "-",
                          ColumnKind::deformation,
                          Inheritance::copied);
      for (unsigned int p = 0; p < 2; ++p)
        {
          dealii::Point<dim> x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = 0.5 + p + 0.1 * d;
          s.add(x);
        }
      for (const Column &column : s.points.columns())
        if (column.first != s.points.position && column.first != s.points.id &&
            column.first != s.points.edges)
          for (unsigned int c = 0; c < column.n_components; ++c)
            for (unsigned int p = 0; p < 2; ++p)
              s.points.data(column.first, c)[p] =
                0.7 + column.first + 0.1 * c + 0.3 * p;
      // Boxes are drawn by their edges.
      for (unsigned int p = 0; p < 2; ++p)
        for (unsigned int d = 0; d < dim; ++d)
          s.points.data(s.points.edges, d * (dim + 1))[p] =
            s.points.data(s.points.box_length, d)[p];
    }

    template <int dim>
    fs::path
    write(const Scene<dim> &s, const bool boxes_as_cells)
    {
      PointsOutput<dim> output;
      output.begin({folder, "hdf5", boxes_as_cells}, s);
      output.write(s);
      return folder / "points-0000.h5";
    }

    /// The columns of the points are in the file, by name.
    template <int dim>
    void
    expect_columns(const Points<dim> &points, const fs::path &file)
    {
      for (const Column &column : points.columns())
        {
          const unsigned int n         = column.n_components;
          const bool         is_vector = (column.kind == ColumnKind::vector);
          if (!is_vector && column.kind != ColumnKind::scalars)
            continue;
          for (unsigned int c = 0; c < n; ++c)
            {
              const bool        is_list = (n > 1 && !is_vector);
              const std::string name =
                "fields/" + column.name +
                (is_list ? " " + std::to_string(c) : std::string());
              const auto read = read_dataset<float>(file, name);
              EXPECT_EQ(read.extent,
                        is_vector ? std::vector<hsize_t>({2, 3})
                                  : std::vector<hsize_t>({2}))
                << name;
              const auto *data = points.data(column.first, c);
              for (unsigned int p = 0; p < 2; ++p)
                EXPECT_EQ(read.values.at(is_vector ? 3 * p + c : p),
                          float(data[p]))
                  << name;
            }
        }
    }

    /// Component ij of the tensors, row by row.
    template <int dim>
    void
    expect_tensors(const Points<dim> &points, const fs::path &file)
    {
      const auto stress = read_dataset<float>(file, "fields/stress");
      const auto A      = read_dataset<float>(file, "fields/edges");
      const auto F = read_dataset<float>(file, "fields/deformation gradient");
      EXPECT_EQ(stress.extent, std::vector<hsize_t>({2, 9}));
      EXPECT_EQ(A.extent, std::vector<hsize_t>({2, 9}));
      EXPECT_EQ(F.extent, std::vector<hsize_t>({2, 9}));
      const unsigned int deformation = points.find("deformation gradient");
      // xx, yy, zz, xy, xz, yz
      const unsigned int component[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
      for (unsigned int p = 0; p < 2; ++p)
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            {
              const unsigned int c        = component[i][j];
              const bool         in_space = (i < dim && j < dim);
              EXPECT_EQ(stress.values[9 * p + 3 * i + j],
                        c < n_stress_components<dim>
                          ? float(points.data(points.stress, c)[p])
                          : 0.f);
              EXPECT_EQ(A.values[9 * p + 3 * i + j],
                        in_space
                          ? float(points.data(points.edges, dim * i + j)[p])
                          : 0.f);
              EXPECT_EQ(F.values[9 * p + 3 * i + j],
                        in_space
                          ? float(points.data(deformation, dim * i + j)[p])
                          : float(i == j));
            }
    }

    ptree
    read_index(const std::string &name)
    {
      ptree tree;
      boost::property_tree::read_xml((folder / name).string(), tree);
      return tree.get_child("Xdmf.Domain.Grid");
    }

    /// Every reference leads to a dataset of that size.
    void
    expect_item(const ptree &parent)
    {
      const ptree      &item = parent.get_child("DataItem");
      const std::string text = item.data();
      const auto        at   = text.find(":/");
      ASSERT_NE(at, std::string::npos);
      const fs::path     file = folder / text.substr(0, at);
      std::istringstream extent(item.get<std::string>("<xmlattr>.Dimensions"));
      std::vector<hsize_t> expected;
      for (hsize_t n; extent >> n;)
        expected.push_back(n);
      const auto type = item.get<std::string>("<xmlattr>.NumberType");
      EXPECT_EQ(
        type == "Float"
          ? read_dataset<float>(file, text.substr(at + 1)).extent
          : read_dataset<std::int64_t>(file, text.substr(at + 1)).extent,
        expected)
        << text;
    }
  };



  TEST_F(Hdf5Test, Vertices)
  {
    Scene<2> s("0, 0", "8, 4");
    add_points(s);
    const fs::path file = write(s, /*boxes_as_cells=*/false);
    expect_columns(s.points, file);
    expect_tensors(s.points, file);
    const auto x = read_dataset<float>(file, "mesh/vertices");
    EXPECT_EQ(x.extent, std::vector<hsize_t>({2, 3}));
    EXPECT_EQ(x.values, std::vector<float>({0.5, 0.6, 0, 1.5, 1.6, 0}));
    const auto cells = read_dataset<std::int64_t>(file, "mesh/cells");
    EXPECT_EQ(cells.values, std::vector<std::int64_t>({0, 1}));
    EXPECT_EQ(read_attribute(file, "fields/velocity", "unit"), "m/s");
    EXPECT_EQ(read_attribute(file, "fields/velocity", "name"),
              "velocity [m/s]");
    EXPECT_EQ(read_attribute(file, "fields/velocity", "at"), "vertices");
    EXPECT_EQ(read_attribute(file, "fields/reference volume", "unit"), "m^2");
    EXPECT_EQ(read_attribute(file, "fields/id", "unit"), "-");
  }



  TEST_F(Hdf5Test, Vertices3d)
  {
    Scene<3> s("0, 0, 0", "4, 4, 4");
    add_points(s);
    const fs::path file = write(s, /*boxes_as_cells=*/false);
    expect_columns(s.points, file);
    expect_tensors(s.points, file);
    EXPECT_EQ(read_dataset<float>(file, "mesh/vertices").values,
              std::vector<float>({0.5, 0.6, 0.7, 1.5, 1.6, 1.7}));
  }



  // Corners in the order of VTK, in which the sides of a hex are counted
  // counterclockwise, first the lower one.
  template <int dim>
  void
  expect_boxes(const Scene<dim> &s, const fs::path &file)
  {
    constexpr unsigned int n          = 1 << dim;
    const int              sign[8][3] = {{-1, -1, -1},
                                         {1, -1, -1},
                                         {1, 1, -1},
                                         {-1, 1, -1},
                                         {-1, -1, 1},
                                         {1, -1, 1},
                                         {1, 1, 1},
                                         {-1, 1, 1}};
    const auto             x = read_dataset<float>(file, "mesh/vertices");
    const auto cells         = read_dataset<std::int64_t>(file, "mesh/cells");
    EXPECT_EQ(x.extent, std::vector<hsize_t>({2 * n, 3}));
    ASSERT_EQ(cells.extent, std::vector<hsize_t>({2, n}));
    for (unsigned int p = 0; p < 2; ++p)
      for (unsigned int v = 0; v < n; ++v)
        for (unsigned int d = 0; d < dim; ++d)
          EXPECT_EQ(x.values.at(3 * cells.values[p * n + v] + d),
                    float(s.points.data(s.points.position, d)[p] +
                          0.5 * sign[v][d] * box_lengths(s, p)[d]));
  }



  TEST_F(Hdf5Test, Boxes)
  {
    Scene<2> s("0, 0", "8, 4");
    add_points(s);
    const fs::path file = write(s, /*boxes_as_cells=*/true);
    expect_boxes(s, file);
    expect_columns(s.points, file);
    expect_tensors(s.points, file);
    EXPECT_EQ(read_attribute(file, "fields/velocity", "at"), "cells");
  }



  /// Convected domains are drawn as they are: counterclockwise from the corner
  /// where both edges begin.
  TEST_F(Hdf5Test, ConvectedDomains)
  {
    Scene<2> s("0, 0", "8, 4");
    add_points(s);
    s.constants.box_shape.rule = BoxRule::convected_domain;
    const Matrix<2, double> A{{{{{0.125, -0.75}}, {{0.5, 0.25}}}}};
    for (unsigned int p = 0; p < 2; ++p)
      store_matrix(s.points, s.points.edges, p, A);
    update_box_lengths(s.points, 0, 2, s.constants.box_shape.rule);
    const fs::path file = write(s, /*boxes_as_cells=*/true);
    expect_tensors(s.points, file);
    const auto x          = read_dataset<float>(file, "mesh/vertices");
    const auto cells      = read_dataset<std::int64_t>(file, "mesh/cells");
    const int  sign[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    for (unsigned int p = 0; p < 2; ++p)
      for (unsigned int v = 0; v < 4; ++v)
        for (unsigned int d = 0; d < 2; ++d)
          {
            double expected = s.points.data(s.points.position, d)[p];
            for (unsigned int e = 0; e < 2; ++e)
              expected += 0.5 * sign[v][e] * A[d][e];
            EXPECT_FLOAT_EQ(x.values.at(3 * cells.values[p * 4 + v] + d),
                            expected);
          }
  }



  TEST_F(Hdf5Test, Boxes3d)
  {
    Scene<3> s("0, 0, 0", "4, 4, 4");
    add_points(s);
    const fs::path file = write(s, /*boxes_as_cells=*/true);
    expect_boxes(s, file);
    expect_columns(s.points, file);
    expect_tensors(s.points, file);
  }



  TEST_F(Hdf5Test, Index)
  {
    Scene<2> s("0, 0", "8, 4");
    add_points(s);
    PointsOutput<2> output;
    output.begin({folder, "hdf5", true}, s);
    output.write(s);
    s.add({2.5, 2.5});
    s.time = 1. / 3.;
    output.write(s);
    EXPECT_EQ(files_in(folder),
              std::vector<std::string>(
                {"points-0000.h5", "points-0001.h5", "points.xdmf"}));

    std::set<std::string> expected;
    for (const Field &field : point_fields(s))
      expected.insert(name_with_unit(field));
    std::vector<double>      times;
    std::vector<std::size_t> n_cells;
    for (const auto &[tag, grid] : read_index("points.xdmf"))
      if (tag == "Grid")
        {
          times.push_back(grid.get<double>("Time.<xmlattr>.Value"));
          const ptree &topology = grid.get_child("Topology");
          n_cells.push_back(
            topology.get<std::size_t>("<xmlattr>.NumberOfElements"));
          EXPECT_EQ(topology.get<std::string>("<xmlattr>.TopologyType"),
                    "Quadrilateral");
          expect_item(topology);
          expect_item(grid.get_child("Geometry"));
          std::set<std::string> names;
          for (const auto &[attribute, field] : grid)
            if (attribute == "Attribute")
              {
                names.insert(field.get<std::string>("<xmlattr>.Name"));
                EXPECT_EQ(field.get<std::string>("<xmlattr>.Center"), "Cell");
                expect_item(field);
              }
          EXPECT_EQ(names, expected);
        }
    EXPECT_EQ(times, std::vector<double>({0., 0.3333333333333333}));
    EXPECT_EQ(n_cells, std::vector<std::size_t>({2, 3}));
  }



  TEST_F(Hdf5Test, FarFromTheOriginPlacesAreInDoublePrecision)
  {
    Scene<2> s("5000000, 0", "5000008, 4");
    s.add({5000000.6, 0.5});
    const fs::path file = write(s, /*boxes_as_cells=*/true);
    const auto     x    = read_dataset<double>(file, "mesh/vertices");
    EXPECT_NEAR(x.values.at(0), 5000000.35, 1e-8);
    EXPECT_NEAR(x.values.at(3), 5000000.85, 1e-8);
    EXPECT_EQ(read_dataset<double>(file, "fields/position").values.at(0),
              5000000.6);
  }



  // A slash would make a group, and XML has its own use for some characters.
  TEST_F(Hdf5Test, UnusualNames)
  {
    OutputCells cells({{"a/b <c> & \"d\"",
                        "m/s",
                        FieldKind::scalar,
                        [](unsigned int, double *value) { *value = 7; }}},
                      ItemsAt::vertices,
                      CellShape::vertex,
                      0.,
                      0);
    cells.add_vertex(dealii::Point<2>(1, 2));
    cells.items = {0};
    FieldSeries series;
    series.begin(folder, "x", MPI_COMM_WORLD, "hdf5");
    series.write(cells);
    EXPECT_EQ(read_dataset<float>(folder / "x-0000.h5",
                                  "fields/a_b <c> & \"d\"")
                .values,
              std::vector<float>({7}));
    const ptree field = read_index("x.xdmf").get_child("Grid.Attribute");
    EXPECT_EQ(field.get<std::string>("<xmlattr>.Name"),
              "a/b <c> & \"d\" [m/s]");
    expect_item(field);
  }



  TEST_F(Hdf5Test, GridAtItsNodes)
  {
    Scene<2> s("0, 0", "8, 4");
    add_points(s);
    s.sort();
    const unsigned int cell = s.grid.find_cell({1.5, 1.5});
    const unsigned int node = s.grid.cells()[cell].patch[4 * 2 + 1];
    s.nodes.activate(s.grid, {cell});
    s.nodes.clear();
    s.nodes.set_sums(node, 2., 0., dealii::Point<2>(), dealii::Point<2>());
    GridOutput<2> output;
    output.begin({folder, "hdf5"}, s);
    output.observe(s);

    const fs::path file = folder / "grid-0000.h5";
    const auto     mass = read_dataset<float>(file, "fields/mass");
    const auto     x    = read_dataset<float>(file, "mesh/vertices");
    ASSERT_EQ(mass.extent, std::vector<hsize_t>({8}));
    // The upper left corner of the second cell.
    EXPECT_EQ(mass.values, std::vector<float>({0, 0, 0, 0, 0, 0, 2, 0}));
    EXPECT_EQ(x.values[3 * 6], 1.);
    EXPECT_EQ(x.values[3 * 6 + 1], 2.);
    EXPECT_EQ(read_attribute(file, "fields/mass", "at"), "vertices");
    EXPECT_EQ(read_index("grid.xdmf")
                .get<std::string>("Grid.Attribute.<xmlattr>.Center"),
              "Node");
  }



  // The index of a resumed run is made from its state: the files may hold what
  // they like. One that is gone is left out.
  TEST_F(Hdf5Test, IndexOfAResumedRun)
  {
    Scene<2> s("0, 0", "8, 4");
    add_points(s);
    StateList       before, after;
    PointsOutput<2> output, resumed;
    output.list_state(before);
    resumed.list_state(after);
    output.begin({folder, "hdf5", false}, s);
    output.write(s);
    const std::string state = before.texts().at(0).get();
    EXPECT_EQ(state.find("0 points-0000.h5\n "), 0u) << state;
    s.time = 0.1;
    output.write(s);
    const auto expected = lines("points.xdmf");

    // As no run has written it.
    for (const std::string broken : {" <A/>\n", "0\n", "\n", "x p.h5\n"})
      EXPECT_NE(sentence_thrown_by([&]() {
                  after.texts().at(0).set(broken);
                }).find("'files of points'"),
                std::string::npos)
        << broken;
    after.texts().at(0).set(state);
    EXPECT_EQ(after.texts().at(0).get(), state);
    resumed.begin({folder, "hdf5", false}, s, Beginning::resumed);
    std::ofstream(folder / "points-0000.h5") << "no HDF5";
    resumed.write(s);
    EXPECT_EQ(lines("points.xdmf"), expected);
    EXPECT_EQ(files_in(folder),
              std::vector<std::string>(
                {"points-0000.h5", "points-0001.h5", "points.xdmf"}));

    fs::remove(folder / "points-0000.h5");
    resumed.write(s);
    std::vector<double> times;
    for (const auto &[tag, grid] : read_index("points.xdmf"))
      if (tag == "Grid")
        times.push_back(grid.get<double>("Time.<xmlattr>.Value"));
    EXPECT_EQ(times, std::vector<double>({0.1, 0.1}));
  }



  TEST_F(Hdf5Test, FolderIsGone)
  {
    Scene<2> s("0, 0", "8, 4");
    add_points(s);
    PointsOutput<2> output;
    output.begin({folder / "gone", "hdf5", false}, s);
    EXPECT_THROW(output.write(s), ExcUser);
    EXPECT_TRUE(files_in(folder).empty());
  }
} // namespace
