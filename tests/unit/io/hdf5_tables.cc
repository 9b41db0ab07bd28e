// SPDX-License-Identifier: LGPL-2.1-or-later
// Compressed tables in a file that has its name only when it is complete. The
// suite works on any number of ranks; ctest runs it on 1 and on 3.
#include <talus/base/errors.h>
#include <talus/io/hdf5_output_file.h>
#include <talus/observers/points_output.h>

#include <deal.II/base/utilities.h>

#include <random>
#include <thread>

#include <sys/mount.h>
#include <sys/stat.h>

#include "hdf5_reading.h"
#include "observers_setup.h"
#include "suites.h"

TALUS_ALSO_ON_RANKS(Hdf5TablesTest, 3);

namespace
{
  using namespace talus;
  namespace fs  = std::filesystem;
  namespace MPI = dealii::Utilities::MPI;

  /// A file as output writes it.
  class Table : public Hdf5OutputFile
  {
  public:
    explicit Table(const fs::path &path)
      : Hdf5OutputFile(path,
                       MPI_COMM_WORLD,
                       {/*has_checksums=*/false,
                        /*is_compressed=*/true,
                        /*is_atomic=*/true})
    {}
  };



  /// A folder for all ranks; the second rank, if any, has no data.
  class Hdf5TablesTest : public testing::Test
  {
  protected:
    Hdf5TablesTest()
      : rank(MPI::this_mpi_process(MPI_COMM_WORLD))
      , n_ranks(MPI::n_mpi_processes(MPI_COMM_WORLD))
    {
      dealii::ParameterAcceptor::clear();
      const auto *test = testing::UnitTest::GetInstance()->current_test_info();
      folder           = fs::temp_directory_path() /
               ("talus-" + std::string(test->name()) + "-" +
                std::to_string(MPI::broadcast(MPI_COMM_WORLD, getpid())));
      if (rank == 0)
        fs::create_directories(folder);
      MPI_Barrier(MPI_COMM_WORLD);
    }

    ~Hdf5TablesTest() override
    {
      MPI_Barrier(MPI_COMM_WORLD);
      if (rank == 0)
        fs::remove_all(folder);
    }

    /// Number of rows of rank @p r where the first has @p n.
    static std::size_t
    n_rows(const unsigned int r, const std::size_t n)
    {
      return r == 1 ? 0 : n + r;
    }

    /// 0, 1, 2, ... over all ranks.
    template <typename Number>
    std::vector<Number>
    counted(const std::size_t n, const unsigned int n_columns) const
    {
      std::size_t first = 0;
      for (unsigned int r = 0; r < rank; ++r)
        first += n_rows(r, n) * n_columns;
      std::vector<Number> values(n_rows(rank, n) * n_columns);
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = first + i;
      return values;
    }

    template <typename Number>
    void
    write_and_read(const std::size_t n, const unsigned int n_columns) const
    {
      Table file(folder / "x.h5");
      file.create_group("g");
      file.write("g/a table", counted<Number>(n, n_columns), n_columns);
      file.set_attribute("g/a table", "unit", std::string("m/s"));
      file.set_attribute("g/a table", "nothing", std::string());
      file.close();
      EXPECT_EQ(file.error(), "");

      const auto  read = read_dataset<Number>(folder / "x.h5", "g/a table");
      std::size_t rows = 0;
      for (unsigned int r = 0; r < n_ranks; ++r)
        rows += n_rows(r, n);
      ASSERT_EQ(read.extent,
                n_columns == 1 ? std::vector<hsize_t>({rows})
                               : std::vector<hsize_t>({rows, n_columns}));
      for (std::size_t i = 0; i < read.values.size(); ++i)
        ASSERT_EQ(read.values[i], Number(i)) << n << " x " << n_columns;
      EXPECT_EQ(read_attribute(folder / "x.h5", "g/a table", "unit"), "m/s");
      MPI_Barrier(MPI_COMM_WORLD);
      EXPECT_EQ(files_in(folder), std::vector<std::string>({"x.h5"}));
      MPI_Barrier(MPI_COMM_WORLD);
    }

    /// Numbers that cannot be compressed. Returns the error.
    std::string
    write_much(const fs::path &path) const
    {
      std::mt19937       random(rank);
      std::vector<float> values(n_rows(rank, 30000));
      for (float &value : values)
        value = std::generate_canonical<float, 24>(random);
      Table file(path);
      file.create_group("g");
      for (const std::string name : {"g/a", "g/b", "g/c"})
        file.write(name, values, 1);
      file.close();
      return file.error();
    }

    unsigned int rank, n_ranks;
    fs::path     folder;
  };



  // Sizes around that of a chunk, 65536 values.
  TEST_F(Hdf5TablesTest, WritesWhatIsReadBack)
  {
    for (const unsigned int n_columns : {1, 3, 9})
      for (const std::size_t n : {1, 2, 7281, 7282, 21845, 65536, 70000})
        {
          write_and_read<float>(n, n_columns);
          write_and_read<std::int64_t>(n, n_columns);
        }
  }



  TEST_F(Hdf5TablesTest, NothingOnAnyRank)
  {
    Table file(folder / "x.h5");
    file.write("list", std::vector<float>(), 1);
    file.write("table", std::vector<float>(), 9);
    file.close();
    EXPECT_EQ(file.error(), "");
    EXPECT_EQ(read_dataset<float>(folder / "x.h5", "list").extent,
              std::vector<hsize_t>({0}));
    EXPECT_EQ(read_dataset<float>(folder / "x.h5", "table").extent,
              std::vector<hsize_t>({0, 9}));
  }



  // Dates in HDF5 count seconds.
  TEST_F(Hdf5TablesTest, SameBytesLater)
  {
    const auto write = [this](const std::string &name) {
      Table file(folder / name);
      file.set_attribute("/", "time [s]", 0.25);
      file.create_group("g");
      file.write("g/t", counted<float>(70000, 3), 3);
      file.set_attribute("g/t", "unit", std::string("m"));
      file.close();
      std::ifstream     in(folder / name, std::ios::binary);
      std::stringstream content;
      content << in.rdbuf();
      return content.str();
    };
    const std::string first = write("a.h5");
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    EXPECT_TRUE(first == write("b.h5"));
  }



  TEST_F(Hdf5TablesTest, FolderIsMissing)
  {
    Table file(folder / "none" / "x.h5");
    EXPECT_EQ(file.error(), "No such file or directory");
    EXPECT_TRUE(files_in(folder).empty());
  }



  // What was there before survives, and nothing else is left.
  TEST_F(Hdf5TablesTest, TableTwice)
  {
    if (rank == 0)
      std::ofstream(folder / "x.h5") << "older";
    MPI_Barrier(MPI_COMM_WORLD);
    {
      Table file(folder / "x.h5");
      file.write("t", counted<float>(10, 1), 1);
      EXPECT_EQ(file.error(), "");
      file.write("t", counted<float>(10, 1), 1);
      EXPECT_EQ(file.error().find("the array 't' could not be written (HDF5: "),
                0u)
        << file.error();
      file.close();
    }
    MPI_Barrier(MPI_COMM_WORLD);
    EXPECT_EQ(files_in(folder), std::vector<std::string>({"x.h5"}));
    EXPECT_EQ(fs::file_size(folder / "x.h5"), 5u);
  }



  // Small disks, which only root may mount; one has no space left at all.
  TEST_F(Hdf5TablesTest, DiskIsFull)
  {
    const fs::path disk = folder / "disk";
    for (const std::string size : {"8k", "64k", "128k", "256k"})
      {
        int failed = 0;
        if (rank == 0)
          {
            fs::create_directory(disk);
            failed = mount(
              "tmpfs", disk.c_str(), "tmpfs", 0, ("size=" + size).c_str());
            std::ofstream(disk / "x.h5") << "older";
          }
        if (MPI::broadcast(MPI_COMM_WORLD, failed) != 0)
          GTEST_SKIP() << "no file system to fill";
        EXPECT_EQ(write_much(disk / "x.h5"), "No space left on device");
        MPI_Barrier(MPI_COMM_WORLD);
        EXPECT_EQ(files_in(disk), std::vector<std::string>({"x.h5"}));
        std::string content;
        std::ifstream(disk / "x.h5") >> content;
        EXPECT_EQ(content, "older");
        MPI_Barrier(MPI_COMM_WORLD);
        if (rank == 0)
          umount(disk.c_str());
      }
    EXPECT_EQ(write_much(folder / "x.h5"), "");
  }



  // What was reserved and not used is given back.
  TEST_F(Hdf5TablesTest, NoLargerThanNeeded)
  {
    Table file(folder / "x.h5");
    file.write("zeros", std::vector<float>(1000000), 1);
    file.close();
    struct stat status;
    ASSERT_EQ(stat((folder / "x.h5").c_str(), &status), 0);
    EXPECT_LT(status.st_size, 100000);
    EXPECT_LT(status.st_blocks * 512, 120000);
  }



  TEST_F(Hdf5TablesTest, PointsOfAllRanks)
  {
    Scene<2> s("0, 0", "8, 4");
    for (unsigned int i = 0; i < n_rows(rank, 2); ++i)
      s.add({0.5 + i, 0.5 + rank});
    PointsOutput<2> output;
    output.begin({folder, "hdf5", true}, s);
    output.write(s);

    const fs::path file  = folder / "points-0000.h5";
    const auto     cells = read_dataset<std::int64_t>(file, "mesh/cells");
    const auto     x     = read_dataset<float>(file, "mesh/vertices");
    const auto     at    = read_dataset<float>(file, "fields/position");
    ASSERT_EQ(cells.values.size(), 4 * at.extent[0]);
    std::size_t c = 0;
    for (unsigned int r = 0; r < n_ranks; ++r)
      for (unsigned int i = 0; i < n_rows(r, 2); ++i, ++c)
        {
          EXPECT_EQ(at.values[3 * c], 0.5f + i);
          EXPECT_EQ(at.values[3 * c + 1], 0.5f + r);
          const auto *lower = &x.values[3 * cells.values[4 * c]];
          const auto *upper = &x.values[3 * cells.values[4 * c + 2]];
          EXPECT_EQ(lower[0], 0.25f + i);
          EXPECT_EQ(upper[1], 0.75f + r);
        }
    EXPECT_EQ(at.extent[0], c);
  }
} // namespace
