// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/checkpoint/checkpoint_content.h>
#include <talus/io/checksum.h>
#include <talus/io/hdf5_input_file.h>
#include <talus/io/hdf5_output_file.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "observers_setup.h"
#include "suites.h"

TALUS_ALSO_ON_RANKS(Hdf5FileTest, 3);

namespace
{
  using namespace talus;
  namespace fs = std::filesystem;
  using dealii::Utilities::MPI::this_mpi_process;

  // Passes on any number of ranks; the second one has no rows.
  class Hdf5FileTest : public ObserversTest
  {
  protected:
    Hdf5FileTest()
    {
      // One folder for all ranks.
      path = dealii::Utilities::MPI::broadcast(communicator,
                                               (folder / "x.h5").string());
    }

    std::vector<double>
    own_rows() const
    {
      if (rank == 1)
        return {};
      const double nan = std::numeric_limits<double>::quiet_NaN();
      return {rank + 0.1, -0., 1e-310, nan, rank + 0.2, 5.};
    }

    /// Write an array of three columns, and more.
    void
    write_file()
    {
      Hdf5OutputFile file(path, communicator);
      file.create_group("a group");
      file.write("a group/some rows", own_rows(), 3);
      file.write("nothing", std::vector<double>(), 2);
      file.set_attribute("a group/some rows", "unit", std::string("m/s"));
      file.set_attribute("/", "number", 0.3);
      file.set_attribute("a group", "integer", std::uint64_t(1) << 63);
      file.write_text("text", rank == 0 ? "two\nlines" : "not this");
      file.write_text("empty text", "");
      file.close();
      EXPECT_EQ(file.error(), "");
    }

    std::string
    damage_of(const std::string &name)
    {
      Hdf5InputFile file(path, communicator);
      file.verify(name);
      return file.error();
    }

    const MPI_Comm communicator = MPI_COMM_WORLD;
    const unsigned rank         = this_mpi_process(MPI_COMM_WORLD);
    fs::path       path;
  };



  TEST_F(Hdf5FileTest, GivesBackWhatItGotBitByBit)
  {
    write_file();
    Hdf5InputFile file(path, communicator);
    EXPECT_EQ(
      file.names("/"),
      (std::vector<std::string>{"a group", "empty text", "nothing", "text"}));
    const auto [n_rows, n_columns] = file.shape("a group/some rows");
    const auto expected            = own_rows();
    EXPECT_EQ(n_columns, 3u);
    const std::uint64_t first = file.first_and_total(expected.size() / 3).first;
    EXPECT_EQ(n_rows, file.first_and_total(expected.size() / 3).second);
    const auto found =
      file.read("a group/some rows", first, expected.size() / 3);
    ASSERT_EQ(found.size(), expected.size());
    EXPECT_TRUE(found.empty() ||
                std::memcmp(found.data(),
                            expected.data(),
                            found.size() * sizeof(double)) == 0);
    // Everybody may read everything.
    EXPECT_EQ(file.read("a group/some rows", 1, n_rows - 1)[1], 0.2 + 0.);
    EXPECT_EQ(file.shape("nothing"),
              (std::pair<std::uint64_t, unsigned>{0, 2}));
    EXPECT_EQ(file.text_attribute("a group/some rows", "unit"), "m/s");
    EXPECT_EQ(file.number_attribute("/", "number"), 0.3);
    EXPECT_EQ(file.integer_attribute("a group", "integer"),
              std::uint64_t(1) << 63);
    EXPECT_EQ(file.read_text("text"), "two\nlines");
    EXPECT_EQ(file.read_text("empty text"), "");
    for (const std::string name :
         {"a group/some rows", "nothing", "text", "empty text"})
      file.verify(name);
    EXPECT_EQ(file.error(), "");
  }



  TEST_F(Hdf5FileTest, RemembersItsFirstFailure)
  {
    write_file();
    Hdf5InputFile file(path, communicator);
    EXPECT_TRUE(file.read("missing", 0, 1).empty());
    const std::string error = file.error();
    EXPECT_NE(error.find("it has no array 'missing'"), std::string::npos);
    EXPECT_EQ(file.integer_attribute("a group", "integer"), 0u);
    EXPECT_EQ(file.read_text("text"), "");
    EXPECT_EQ(file.error(), error);

    Hdf5InputFile other(path.parent_path() / "none.h5", communicator);
    EXPECT_NE(other.error().find("could not be opened"), std::string::npos);
    Hdf5OutputFile unwritable(path / "below", communicator);
    unwritable.write("x", std::vector<double>{1.}, 1);
    unwritable.close();
    EXPECT_EQ(unwritable.error(), "Not a directory");
  }



  // -------------------------------------------------------- points and cells

  /// Cells and points of a rank: cell g has g mod 4 points, half of them of the
  /// second body, and the points are numbered through.
  struct Share
  {
    Share(const unsigned int first_cell, const unsigned int end_cell)
    {
      std::vector<Segment> segments;
      unsigned int         number = 0;
      for (unsigned int g = 0; g < end_cell; ++g)
        for (unsigned int i = 0; i < g % 4; ++i, ++number)
          {
            if (g < first_cell)
              continue;
            const unsigned int p               = points.append(1);
            const unsigned int body            = (i >= g % 4 / 2);
            points.data(points.body)[p]        = body;
            points.data(points.position, 0)[p] = number;
            points.data(points.position, 1)[p] = -0.1 * number;
            if (segments.empty() || segments.back().cell != g - first_cell ||
                segments.back().body != body)
              segments.push_back({g - first_cell, body, p, p});
            segments.back().end = p + 1;
          }
      points.reorder({}, {}, segments);
      for (unsigned int g = first_cell; g < end_cell; ++g)
        weights.push_back(0.5 * g);
    }

    Points<2>           points;
    std::vector<double> weights;
  };



  TEST_F(Hdf5FileTest, PointsAndCellsSharedDifferently)
  {
    constexpr unsigned int n_cells = 23;
    const double           n_ranks =
      dealii::Utilities::MPI::n_mpi_processes(communicator);
    const Share saved(n_cells * rank / n_ranks, n_cells * (rank + 1) / n_ranks);
    {
      Hdf5OutputFile file(path, communicator);
      save_points(file, saved.points, saved.weights);
      file.close();
      EXPECT_EQ(file.error(), "");
    }
    // Shares that grow with the power of the rank; one may have no cell.
    for (const double power : {1., 2., 5.})
      {
        const auto cut = [&](const unsigned int r) -> unsigned int {
          return n_cells * std::pow(r / n_ranks, power);
        };
        const Share   expected(cut(rank), cut(rank + 1));
        Hdf5InputFile file(path, communicator);
        Points<2>     points;
        EXPECT_EQ(load_cell_weights(file, expected.weights.size()),
                  expected.weights);
        const std::vector<unsigned int> cells =
          load_points(file, expected.weights.size(), points);
        ASSERT_EQ(points.size(), expected.points.size());
        ASSERT_EQ(cells.size(), points.size());
        for (const Segment &segment : expected.points.segments())
          for (unsigned int p = segment.begin; p < segment.end; ++p)
            {
              EXPECT_EQ(cells[p], segment.cell);
              for (unsigned int d = 0; d < 2; ++d)
                EXPECT_EQ(points.data(points.position, d)[p],
                          expected.points.data(points.position, d)[p]);
            }
      }
  }



  // Any flipped bit of an array or a text shows.
  TEST_F(Hdf5FileTest, ChecksumNoticesAFlippedBit)
  {
    write_file();
    MPI_Barrier(communicator);
    std::string content;
    {
      std::ifstream     in(path, std::ios::binary);
      std::stringstream all;
      all << in.rdbuf();
      content = all.str();
    }
    const double      value    = 0.1;
    const std::string as_bytes = {reinterpret_cast<const char *>(&value), 8};
    for (const auto &[name, bytes] :
         {std::pair<std::string, std::string>{"a group/some rows", as_bytes},
          std::pair<std::string, std::string>{"text", "two\nlines"}})
      {
        const std::size_t at = content.rfind(bytes);
        ASSERT_NE(at, std::string::npos);
        for (unsigned int bit = 0; bit < 64; bit += 7)
          {
            std::string damaged = content;
            damaged[at + bit / 8] ^= char(1 << (bit % 8));
            MPI_Barrier(communicator);
            if (rank == 0)
              std::ofstream(path, std::ios::binary) << damaged;
            MPI_Barrier(communicator);
            EXPECT_EQ(damage_of(name),
                      "the checksum of '" + name +
                        "' does not match its content");
          }
      }
  }



  TEST(Checksum, OfPartsAddsUpAndNoticesOrder)
  {
    const std::vector<double> all = {1., 2., 2., -0.};
    EXPECT_EQ(checksum(all, 7), checksum({1.}, 7) + checksum({2., 2., -0.}, 8));
    EXPECT_NE(checksum(all, 0), checksum({2., 1., 2., -0.}, 0));
    EXPECT_NE(checksum(all, 0), checksum({1., 2., 2., 0.}, 0));
    EXPECT_NE(checksum(all, 0), checksum(all, 1));
  }
} // namespace
