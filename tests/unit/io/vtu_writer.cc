// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/io/vtu_writer.h>
#include <talus/observers/grid_output.h>
#include <talus/observers/output.h>
#include <talus/observers/points_output.h>

#include <deal.II/base/utilities.h>

#include <boost/property_tree/xml_parser.hpp>

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>
#include <limits>
#include <map>

#include "observers_setup.h"
#include "suites.h"

TALUS_ALSO_ON_RANKS(VtuRanksTest, 3);

namespace
{
  using namespace talus;
  namespace fs = std::filesystem;

  /// What a VTU file holds.
  struct Vtu
  {
    std::size_t                               n_points, n_cells;
    bool                                      at_cells;
    std::vector<float>                        vertices;
    std::vector<std::int32_t>                 corners;
    std::vector<std::uint8_t>                 types;
    std::map<std::string, unsigned int>       n_components;
    std::map<std::string, std::vector<float>> values;
  };



  /// VTK's inline binary: base64 of 4 numbers (blocks, sizes), then of the
  /// block, compressed.
  template <typename Number>
  std::vector<Number>
  decode(std::string text)
  {
    text.erase(std::remove_if(text.begin(), text.end(), isspace), text.end());
    const auto    head = dealii::Utilities::decode_base64(text.substr(0, 24));
    std::uint32_t numbers[4];
    std::memcpy(numbers, head.data(), sizeof(numbers));
    const auto packed = dealii::Utilities::decode_base64(text.substr(24));
    std::vector<Number> values(numbers[1] / sizeof(Number));
    uLongf              size = numbers[1];
    EXPECT_EQ(numbers[0], 1u);
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef *>(values.data()),
                         &size,
                         packed.data(),
                         numbers[3]),
              Z_OK);
    EXPECT_EQ(size, numbers[1]);
    return values;
  }



  Vtu
  read_vtu(const fs::path &path)
  {
    boost::property_tree::ptree tree;
    boost::property_tree::read_xml(path.string(), tree);
    const auto &piece = tree.get_child("VTKFile.UnstructuredGrid.Piece");
    Vtu         vtu;
    vtu.n_points = piece.get<std::size_t>("<xmlattr>.NumberOfPoints");
    vtu.n_cells  = piece.get<std::size_t>("<xmlattr>.NumberOfCells");
    vtu.at_cells = piece.count("CellData") == 1;
    EXPECT_EQ(piece.count("PointData"), vtu.at_cells ? 0u : 1u);
    for (const auto &[tag, array] :
         piece.get_child(vtu.at_cells ? "CellData" : "PointData"))
      if (tag == "DataArray")
        {
          const auto name = array.get<std::string>("<xmlattr>.Name");
          vtu.n_components[name] =
            array.get<unsigned int>("<xmlattr>.NumberOfComponents", 1);
          EXPECT_EQ(array.get<std::string>("<xmlattr>.type"), "Float32");
          vtu.values[name] = decode<float>(array.data());
        }

    vtu.vertices = decode<float>(piece.get<std::string>("Points.DataArray"));
    // Every cell has its own vertices, one after the other.
    for (const auto &[tag, array] : piece.get_child("Cells"))
      if (const auto name = array.get<std::string>("<xmlattr>.Name");
          name == "connectivity")
        vtu.corners = decode<std::int32_t>(array.data());
      else if (name == "types")
        vtu.types = decode<std::uint8_t>(array.data());
      else
        {
          EXPECT_EQ(name, "offsets");
          const auto offsets = decode<std::int32_t>(array.data());
          EXPECT_EQ(offsets.size(), vtu.n_cells);
          for (std::size_t c = 0; c < offsets.size(); ++c)
            EXPECT_EQ(offsets[c], (c + 1) * vtu.n_points / vtu.n_cells);
        }
    return vtu;
  }



  // -------------------------------------------------------------------- VTU

  class VtuTest : public ObserversTest
  {
  protected:
    template <int dim>
    void
    add_points(Scene<dim> &s)
    {
      dealii::Point<dim> a, b;
      for (unsigned int d = 0; d < dim; ++d)
        {
          a[d] = 0.5;
          b[d] = 1.5;
        }
      s.add(a, 2., 2. * a);
      s.add(b, 3., -2. * b);
      s.points.add_column("yield stress", "Pa", 1, Inheritance::copied);
      s.points.add_column("two things", "m", 5, Inheritance::copied);
      for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
        s.points.data(s.points.stress, c)[1] = 1. + c;
    }
  };



  TEST_F(VtuTest, EveryPointAndColumn)
  {
    Scene<2> s("0, 0", "8, 4");
    add_points(s);
    s.points.data(s.points.initial_position, 0)[1] = 1.;
    s.stretch(1, 1, 3.);
    write_points(s, folder / "p.vtu");
    Vtu vtu = read_vtu(folder / "p.vtu");
    EXPECT_EQ(vtu.n_points, 2u);
    EXPECT_EQ(vtu.n_cells, 2u);
    EXPECT_FALSE(vtu.at_cells);
    EXPECT_EQ(vtu.vertices, std::vector<float>({0.5, 0.5, 0, 1.5, 1.5, 0}));
    EXPECT_EQ(vtu.corners, std::vector<std::int32_t>({0, 1}));
    EXPECT_EQ(vtu.types, std::vector<std::uint8_t>(2, 1)); // VTK_VERTEX

    const std::map<std::string, unsigned int> expected = {
      {"position [m]", 3},
      {"velocity [m/s]", 3},
      {"edges [m]", 9},
      {"stress [Pa]", 9},
      {"mass [kg]", 1},
      {"reference volume [m^2]", 1},
      {"length at creation [m]", 3},
      {"initial position [m]", 3},
      {"elastic energy [J]", 1},
      {"plastic work [J]", 1},
      {"id", 1},
      {"generation", 1},
      {"body", 1},
      {"yield stress [Pa]", 1},
      {"two things 0 [m]", 1},
      {"two things 1 [m]", 1},
      {"two things 2 [m]", 1},
      {"two things 3 [m]", 1},
      {"two things 4 [m]", 1},
      {"displacement [m]", 3},
      {"box length [m]", 3},
      {"speed [m/s]", 1},
      {"mean stress [Pa]", 1},
      {"von Mises stress [Pa]", 1},
      {"J", 1}};
    EXPECT_EQ(vtu.n_components, expected);

    using V = std::vector<float>;
    EXPECT_EQ(vtu.values["position [m]"], V({0.5, 0.5, 0, 1.5, 1.5, 0}));
    EXPECT_EQ(vtu.values["velocity [m/s]"], V({1, 1, 0, -3, -3, 0}));
    EXPECT_EQ(vtu.values["displacement [m]"], V({0, 0, 0, 0.5, 0, 0}));
    EXPECT_EQ(vtu.values["box length [m]"], V({0.5, 0.5, 0, 0.5, 1.5, 0}));
    // xx, yy, zz, xy = 1, 2, 3, 4.
    const V stress = {0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 4, 0, 4, 2, 0, 0, 0, 3};
    EXPECT_EQ(vtu.values["stress [Pa]"], stress);
    const V A = {0.5, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 1.5, 0, 0, 0, 0};
    EXPECT_EQ(vtu.values["edges [m]"], A);
    EXPECT_EQ(vtu.values["length at creation [m]"],
              V({0.5, 0.5, 0, 0.5, 0.5, 0}));
    EXPECT_EQ(vtu.values["mean stress [Pa]"], V({0, 2}));
    // sqrt(3/2 s:s) with s = diag(-1, 0, 1) and 4 off the diagonal.
    EXPECT_FLOAT_EQ(vtu.values["von Mises stress [Pa]"][1], std::sqrt(51.));
    EXPECT_EQ(vtu.values["J"], V({1, 3}));
  }



  // In 2-D a symmetric tensor has as many components as a full one.
  TEST_F(VtuTest, ColumnsAreShownByTheirKind)
  {
    Scene<2> s("0, 0", "8, 4");
    s.add({0.5, 0.5});
    std::map<std::string, ColumnKind> kinds = {
      {"symmetric", ColumnKind::symmetric_tensor},
      {"full", ColumnKind::tensor},
      {"mapping", ColumnKind::deformation}};
    for (const auto &[name, kind] : kinds)
      {
        const unsigned int column =
          s.points.add_column(name, "-", kind, Inheritance::copied);
        for (unsigned int c = 0; c < 4; ++c)
          s.points.data(column, c)[0] = 5. + c;
      }
    s.points.add_column("numbers", "-", 4, Inheritance::copied);
    write_points(s, folder / "p.vtu");
    Vtu vtu = read_vtu(folder / "p.vtu");
    using V = std::vector<float>;
    EXPECT_EQ(vtu.values["symmetric"], V({5, 8, 0, 8, 6, 0, 0, 0, 7}));
    EXPECT_EQ(vtu.values["full"], V({5, 6, 0, 7, 8, 0, 0, 0, 0}));
    EXPECT_EQ(vtu.values["mapping"], V({5, 6, 0, 7, 8, 0, 0, 0, 1}));
    EXPECT_EQ(vtu.values["numbers 3"], V({0}));
  }



  // Without weight there is no ratio.
  TEST_F(VtuTest, PorePressureRatio)
  {
    Scene<2> s("0, 0", "8, 4");
    s.points.add_pore_pressure();
    add_points(s);
    s.points.data(s.points.pore_pressure())[0] = 3.;
    s.points.data(s.points.overburden())[0]    = 5.;
    s.sort();
    write_points(s, folder / "p.vtu");
    EXPECT_EQ(read_vtu(folder / "p.vtu").values.at("pore pressure ratio"),
              std::vector<float>({0.6f, 0.f}));
  }



  TEST_F(VtuTest, BoxesHoldTheirValuesOnce)
  {
    Scene<2> s("0, 0", "8, 4");
    add_points(s);
    s.stretch(1, 1, 3.);
    PointsOutput<2> output;
    output.begin({folder, /*boxes_as_cells=*/true}, s);
    output.write(s);
    const Vtu vtu = read_vtu(folder / "points-0000.vtu");
    EXPECT_EQ(vtu.n_points, 8u);
    EXPECT_EQ(vtu.n_cells, 2u);
    EXPECT_TRUE(vtu.at_cells);
    EXPECT_EQ(vtu.values.at("mass [kg]"), std::vector<float>({2, 3}));
    EXPECT_EQ(vtu.types, std::vector<std::uint8_t>(2, 9)); // VTK_QUAD
    // Around the second box, 0.5 m x 1.5 m about (1.5, 1.5).
    std::vector<float> around;
    for (unsigned int i = 4; i < 8; ++i)
      for (unsigned int d = 0; d < 3; ++d)
        around.push_back(vtu.vertices.at(3 * vtu.corners.at(i) + d));
    EXPECT_EQ(around,
              std::vector<float>(
                {1.25, 0.75, 0, 1.75, 0.75, 0, 1.75, 2.25, 0, 1.25, 2.25, 0}));
  }



  // At 5 000 km single precision has steps of half a metre, the width of a box.
  TEST_F(VtuTest, FarFromTheOriginPlacesAreInDoublePrecision)
  {
    Scene<2> s("5000000, 0", "5000008, 4");
    s.add({5000000.6, 0.5});
    s.points.data(s.points.initial_position, 0)[0] = 5000000.6;
    PointsOutput<2> output;
    output.begin({folder, /*boxes_as_cells=*/true}, s);
    output.write(s);
    boost::property_tree::ptree tree;
    boost::property_tree::read_xml((folder / "points-0000.vtu").string(), tree);
    const auto &piece = tree.get_child("VTKFile.UnstructuredGrid.Piece");
    const auto &array = piece.get_child("Points.DataArray");
    EXPECT_EQ(array.get<std::string>("<xmlattr>.type"), "Float64");
    const auto vertices = decode<double>(array.data());
    EXPECT_NEAR(vertices.at(0), 5000000.35, 1e-8);
    EXPECT_NEAR(vertices.at(3), 5000000.85, 1e-8);
    for (const auto &[tag, field] : piece.get_child("CellData"))
      if (const auto name = field.get<std::string>("<xmlattr>.Name");
          name == "position [m]" || name == "initial position [m]")
        {
          EXPECT_EQ(field.get<std::string>("<xmlattr>.type"), "Float64");
          EXPECT_EQ(decode<double>(field.data()).at(0), 5000000.6) << name;
        }
      else
        EXPECT_EQ(field.get<std::string>("<xmlattr>.type"), "Float32") << name;
  }



  /// The test vectors of RFC 4648.
  TEST(VtuArrays, Base64)
  {
    const auto encode = [](const std::string &text) {
      std::ostringstream out;
      write_base64(out,
                   reinterpret_cast<const unsigned char *>(text.data()),
                   text.size());
      return out.str();
    };
    EXPECT_EQ(encode(""), "");
    EXPECT_EQ(encode("f"), "Zg==");
    EXPECT_EQ(encode("fo"), "Zm8=");
    EXPECT_EQ(encode("foo"), "Zm9v");
    EXPECT_EQ(encode("foob"), "Zm9vYg==");
    EXPECT_EQ(encode("fooba"), "Zm9vYmE=");
    EXPECT_EQ(encode("foobar"), "Zm9vYmFy");
    EXPECT_EQ(encode("\xff\xfe\xfb"), "//77");
  }



  /// Short arrays, noise, which is only wrapped, and what can be compressed.
  TEST(VtuArrays, DecodeToWhatTheyWere)
  {
    for (const unsigned int n : {0, 1, 2, 3, 1000, 2048, 100000})
      for (const bool is_noise : {false, true})
        {
          std::vector<float> values(n);
          for (unsigned int i = 0; i < n; ++i)
            values[i] = (is_noise ? std::sin(i) : 1.f);
          std::ostringstream out;
          write_vtu_array(out, values);
          EXPECT_EQ(decode<float>(out.str()), values);
          if (n == 100000)
            {
              const double ratio = out.str().size() / (4. * n);
              EXPECT_TRUE(is_noise ? ratio < 1.34 : ratio < 0.01) << ratio;
            }
        }
  }



  TEST_F(VtuTest, ThreeDimensions)
  {
    Scene<3> s("0, 0, 0", "4, 4, 4");
    add_points(s);
    PointsOutput<3> output;
    output.begin({folder, /*boxes_as_cells=*/true}, s);
    output.write(s);
    Vtu vtu = read_vtu(folder / "points-0000.vtu");
    EXPECT_EQ(vtu.n_points, 16u);
    EXPECT_EQ(vtu.n_cells, 2u);
    EXPECT_EQ(vtu.n_components["stress [Pa]"], 9u);
    const std::vector<float> &all = vtu.values["stress [Pa]"];
    EXPECT_EQ(vtu.types, std::vector<std::uint8_t>(2, 12)); // VTK_HEXAHEDRON
    // xx, yy, zz, xy, xz, yz = 1, ..., 6 in the last box.
    EXPECT_EQ(std::vector<float>(all.end() - 9, all.end()),
              std::vector<float>({1, 4, 5, 4, 2, 6, 5, 6, 3}));
    EXPECT_EQ(vtu.n_components["reference volume [m^3]"], 1u);
  }



  TEST_F(VtuTest, GridOfCellsThatCarrySoil)
  {
    Scene<2> s("0, 0", "8, 4");
    add_points(s);
    s.sort();
    GridOutput<2> output;
    output.begin({folder}, s);
    // Before the first step no node is active.
    output.observe(s);
    Vtu vtu = read_vtu(folder / "grid-0000.vtu");
    EXPECT_EQ(vtu.n_cells, 2u);
    EXPECT_EQ(vtu.n_points, 8u);
    EXPECT_EQ(vtu.values["mass [kg]"], std::vector<float>(8, 0));

    const unsigned int cell = s.grid.find_cell({1.5, 1.5});
    const unsigned int node = s.grid.cells()[cell].patch[4 * 2 + 1];
    s.nodes.activate(s.grid, {cell});
    s.nodes.clear();
    s.nodes.set_sums(
      node, 2., 0., dealii::Point<2>(6., 0.), dealii::Point<2>(0., 4.));
    s.nodes.update_momentum(0.5, 1e-9);
    s.time = 0.5;
    output.observe(s);
    vtu = read_vtu(folder / "grid-0001.vtu");
    // deal.II's third vertex of the second cell.
    EXPECT_EQ(vtu.n_components["velocity [m/s]"], 3u);
    EXPECT_EQ(vtu.values["mass [kg]"][4 + 2], 2.);
    EXPECT_EQ(vtu.values["velocity [m/s]"][3 * (4 + 2)], 3.);
    EXPECT_EQ(vtu.values["velocity [m/s]"][3 * (4 + 2) + 1], 1.);
    EXPECT_EQ(vtu.values["force [N]"][3 * (4 + 2) + 1], 4.);

    const std::vector<std::string> pvd = {
      R"(<?xml version="1.0"?>)",
      R"(<VTKFile type="Collection" version="0.1">)",
      R"(  <Collection>)",
      R"(    <DataSet timestep="0" group="" part="0" file="grid-0000.vtu"/>)",
      R"(    <DataSet timestep="0.5" group="" part="0" file="grid-0001.vtu"/>)",
      R"(  </Collection>)",
      R"(</VTKFile>)"};
    EXPECT_EQ(lines("grid.pvd"), pvd);
  }



  /// What the user moved away meanwhile is no error.
  TEST_F(VtuTest, FilesReachTheDisk)
  {
    Scene<2> s("0, 0", "8, 4");
    add_points(s);
    PointsOutput<2> output;
    output.begin({folder, /*boxes_as_cells=*/true}, s);
    output.write(s);
    output.write(s);
    fs::remove(folder / "points-0000.vtu");
    EXPECT_NO_THROW(output.sync());
    EXPECT_EQ(read_vtu(folder / "points-0001.vtu").n_cells, 2u);
  }



  TEST_F(VtuTest, FilesThatWereRemovedOrCutAreMissed)
  {
    StateList       state;
    PointsOutput<2> output;
    output.list_state(state);
    state.texts().at(0).set("0 points-0000.vtu\n0.1 points-0001.vtu\n");
    EXPECT_EQ(state.texts().at(0).get(),
              "0 points-0000.vtu\n0.10000000000000001 points-0001.vtu\n");
    const std::string whole = "there\n</UnstructuredGrid>\n</VTKFile>\n";
    std::ofstream(folder / "points.pvd") << "there";
    std::ofstream(folder / "points-0000.vtu") << whole;
    EXPECT_EQ(output.missing_files({folder}),
              std::vector<std::string>({"points-0001.vtu"}));
    // Cut short, by a byte and to nothing.
    for (const std::size_t rest : {whole.size() - 1, std::size_t(0)})
      {
        std::ofstream(folder / "points-0000.vtu") << whole.substr(0, rest);
        EXPECT_EQ(output.missing_files({folder}).front(), "points-0000.vtu");
      }
    fs::remove(folder / "points.pvd");
    EXPECT_EQ(output.missing_files({folder}).front(), "points.pvd");
  }



  /// Points of a rank, as vertices.
  OutputCells
  cells_of(const unsigned int n, const unsigned int rank)
  {
    OutputCells cells({{"index",
                        "-",
                        FieldKind::scalar,
                        [](const unsigned int i, double *value) {
                          *value = i;
                        }}},
                      ItemsAt::vertices,
                      CellShape::vertex,
                      0.5,
                      7);
    for (unsigned int i = 0; i < n; ++i)
      {
        cells.add_vertex(dealii::Point<2>(i, rank));
        cells.items.push_back(i);
      }
    return cells;
  }



  std::vector<float>
  places_of(const unsigned int n, const unsigned int rank)
  {
    const std::vector<double> places = cells_of(n, rank).vertices;
    return {places.begin(), places.end()};
  }



  /// The second of three ranks has no cells, and no piece.
  class VtuRanksTest : public ObserversTest
  {};

  TEST_F(VtuRanksTest, OnePieceForEachRankWithCells)
  {
    namespace MPI              = dealii::Utilities::MPI;
    const unsigned int rank    = MPI::this_mpi_process(MPI_COMM_WORLD);
    const unsigned int n_ranks = MPI::n_mpi_processes(MPI_COMM_WORLD);
    const fs::path     path =
      MPI::broadcast(MPI_COMM_WORLD, (folder / "cells.vtu").string());
    OutputCells cells = cells_of(rank == 1 ? 0 : 2 + rank, rank);
    write_vtu(path, MPI_COMM_WORLD, cells);
    MPI_Barrier(MPI_COMM_WORLD);
    boost::property_tree::ptree tree;
    boost::property_tree::read_xml(path.string(), tree);
    unsigned int r = 0;
    for (const auto &[tag, piece] : tree.get_child("VTKFile.UnstructuredGrid"))
      if (tag == "Piece")
        {
          EXPECT_EQ(piece.get<unsigned int>("<xmlattr>.NumberOfCells"), 2 + r);
          EXPECT_EQ(decode<float>(piece.get<std::string>("Points.DataArray")),
                    places_of(2 + r, r));
          r += (r == 0 ? 2 : 1);
        }
    EXPECT_EQ(r, n_ranks == 1 ? 2 : n_ranks);

    // If no rank has cells, there is an empty piece.
    write_vtu(path, MPI_COMM_WORLD, cells_of(0, rank));
    MPI_Barrier(MPI_COMM_WORLD);
    EXPECT_EQ(read_vtu(path).n_cells, 0u);
    EXPECT_TRUE(is_complete_vtu(path));
    MPI_Barrier(MPI_COMM_WORLD);
  }



  TEST_F(VtuTest, LastState)
  {
    PhaseTimer timer;
    Log        log{MPI_COMM_WORLD};
    Output<2>  output(timer, log);
    Scene<2>   s("0, 0", "8, 4");
    s.add({0.5, 0.5});
    s.points.data(s.points.velocity)[0] =
      std::numeric_limits<double>::quiet_NaN();
    output.set_folder(folder);
    EXPECT_EQ(output.write_last_state(s), (folder / "last-state.vtu").string());
    const Vtu vtu = read_vtu(folder / "last-state.vtu");
    EXPECT_EQ(vtu.n_points, 1u);
    EXPECT_TRUE(std::isnan(vtu.values.at("velocity [m/s]")[0]));
  }
} // namespace
