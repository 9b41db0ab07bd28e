// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/checkpoint/checkpoint.h>
#include <talus/checkpoint/checkpoint_folder.h>
#include <talus/checkpoint/parameter_changes.h>
#include <talus/io/checksum.h>
#include <talus/transfer/points_of_cells.h>

#include <gtest/gtest.h>

#include <numeric>
#include <sstream>

#include "observers_setup.h"

namespace
{
  using namespace talus;
  namespace fs = std::filesystem;

  TEST(StateList, NumbersGoThroughADouble)
  {
    StateList             list;
    unsigned long         steps      = (1ul << 53) - 1;
    unsigned int          generation = 3;
    double                work       = 0.1;
    std::array<double, 2> vector     = {{1., 2.}};
    list.add("steps", "-", steps, Reduction::equal);
    list.add("generation", "-", generation, Reduction::maximum);
    list.add("work", "J", work, Reduction::sum);
    list.add_components("vector", "m", vector, 2, Reduction::sum);
    ASSERT_EQ(list.numbers().size(), 5u);
    EXPECT_EQ(list.numbers()[4].name, "vector 1");
    std::vector<double> saved;
    for (const auto &number : list.numbers())
      saved.push_back(number.get());
    steps = generation = 0;
    work = vector[0] = vector[1] = 0;
    for (unsigned int i = 0; i < saved.size(); ++i)
      list.numbers()[i].set(saved[i]);
    EXPECT_EQ(steps, (1ul << 53) - 1);
    EXPECT_EQ(generation, 3u);
    EXPECT_EQ(work, 0.1);
    EXPECT_EQ(vector[1], 2.);
  }



  TEST(StateList, SharesOnAnotherNumberOfRanks)
  {
    const std::vector<double> shares = {1., 5., 3.};
    for (const Reduction reduction :
         {Reduction::sum, Reduction::maximum, Reduction::equal})
      EXPECT_EQ(restored_share(shares, reduction, 1, 3), 5.);
    EXPECT_EQ(restored_share(shares, Reduction::sum, 0, 2), 9.);
    EXPECT_EQ(restored_share(shares, Reduction::sum, 1, 2), 0.);
    EXPECT_EQ(restored_share(shares, Reduction::maximum, 1, 2), 5.);
    EXPECT_EQ(restored_share(shares, Reduction::equal, 1, 4), 1.);
  }



  // ------------------------------------------------------------- checkpoints

  const std::string parameters = "subsection Bodies\n  set Names = soil\nend\n";



  class CheckpointTest : public ObserversTest
  {
  protected:
    CheckpointTest()
      : checkpoint(std::make_unique<Checkpoint<2>>())
      , scene("0, 0", "8, 4")
    {
      scene.points.add_column("plastic strain", "-", 1, Inheritance::copied);
      scene.add({0.5, 0.5});
      scene.add({7.5, 3.5}, 3.);
      scene.add({0.25, 0.5}, 2.);
      scene.sort();
      for (const Column &column : scene.points.columns())
        if (column.first != scene.points.body)
          for (unsigned int c = 0; c < column.n_components; ++c)
            for (unsigned int p = 0; p < 3; ++p)
              scene.points.data(column.first, c)[p] += 0.1 * c + 1e-3 * p;
      state.add("answer", "-", answer, Reduction::equal);
      state.add_text({"words",
                      [this]() { return words; },
                      [this](const std::string &text) { words = text; }});
      checkpoint->begin(folder, MPI_COMM_WORLD);
    }

    fs::path
    write(const unsigned long step)
    {
      std::vector<double> weights(scene.grid.n_owned_cells(), 1.);
      weights[5] = 5.;
      return checkpoint->write({scene.grid,
                                scene.points,
                                weights,
                                state,
                                parameters,
                                step,
                                0.1 * step,
                                1.});
    }

    FoundCheckpoint
    find(const unsigned int dimension = 2) const
    {
      return find_checkpoint(folder, dimension, MPI_COMM_WORLD);
    }

    void
    flip_a_bit(const fs::path &path) const
    {
      std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
      file.seekg(fs::file_size(path) / 2);
      const char byte = char(file.get() ^ 4);
      file.seekp(fs::file_size(path) / 2);
      file.put(byte);
    }

    // Declared before the scene, which parses the parameters.
    std::unique_ptr<Checkpoint<2>> checkpoint;
    Scene<2>                       scene;
    StateList                      state;
    double                         answer = 42.;
    std::string                    words  = "so\nmany";
  };



  TEST_F(CheckpointTest, GivesBackPointsAndState)
  {
    const fs::path        path  = write(3);
    const FoundCheckpoint found = find();
    EXPECT_EQ(found.path, path);
    EXPECT_TRUE(found.errors.empty());
    EXPECT_EQ(found.head.step, 3u);
    EXPECT_EQ(found.head.end_time, 1.);
    EXPECT_EQ(found.head.dimension, 2u);

    Points<2> points;
    points.add_column("plastic strain", "-", 1, Inheritance::copied);
    std::vector<double> weights;
    scene.grid.create({});
    scene.grid.load((path / "mesh").string());
    scene.grid.prepare();
    const std::vector<unsigned int> cells =
      load_points(scene.grid, points, weights);
    ASSERT_EQ(points.size(), 3u);
    for (const Column &column : points.columns())
      for (unsigned int c = 0; c < column.n_components; ++c)
        for (unsigned int p = 0; p < 3; ++p)
          EXPECT_EQ(points.data(column.first, c)[p],
                    scene.points.data(column.first, c)[p]);
    for (const Segment &segment : scene.points.segments())
      for (unsigned int p = segment.begin; p < segment.end; ++p)
        EXPECT_EQ(cells.at(p), segment.cell);
    EXPECT_EQ(weights.size(), 32u);
    EXPECT_EQ(weights[5], 5.);

    const Hdf5Image file = open_state(path, MPI_COMM_WORLD);
    answer               = 0;
    words                = "";
    load_state(file, state, MPI_COMM_WORLD);
    EXPECT_EQ(answer, 42.);
    EXPECT_EQ(words, "so\nmany");
    EXPECT_EQ(file.read_text("parameters"), parameters);

    // A law with another internal variable cannot go on from it.
    check_columns(file, points);
    Points<2> others;
    others.add_column("damage", "-", 1, Inheritance::copied);
    EXPECT_NE(sentence_thrown_by([&]() {
                check_columns(file, others);
              }).find("different columns"),
              std::string::npos);
  }



  // One array per number would take minutes, and hours to be read.
  TEST_F(CheckpointTest, GivesBackManyNumbers)
  {
    constexpr unsigned int n = 20000;
    std::vector<double>    many(n);
    std::iota(many.begin(), many.end(), 0.5);
    state.add_components("number", "m", many, n, Reduction::equal);
    const Hdf5Image file = open_state(write(3), MPI_COMM_WORLD);
    many.assign(n, 0.);
    load_state(file, state, MPI_COMM_WORLD);
    for (unsigned int i = 0; i < n; ++i)
      EXPECT_EQ(many[i], i + 0.5);

    // A number of another version.
    StateList others;
    others.add("question", "-", answer, Reduction::equal);
    EXPECT_NE(sentence_thrown_by([&]() {
                load_state(file, others, MPI_COMM_WORLD);
              }).find("the number 'question' is missing"),
              std::string::npos);
  }



  TEST_F(CheckpointTest, GivesBackTheMesh)
  {
    const fs::path path = write(1);
    scene.grid.create({});
    scene.grid.load((path / "mesh").string());
    scene.grid.prepare();
    EXPECT_EQ(scene.grid.n_owned_cells(), 32u);
    EXPECT_EQ(scene.grid.finest_size(), 1.);
  }



  TEST_F(CheckpointTest, KeepsTwoAndNothingHalfWritten)
  {
    fs::create_directories(folder / "checkpoints" / "0000000009.part");
    for (const unsigned long step : {1, 20, 300})
      write(step);
    const auto found = find_checkpoints(folder);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].filename(), "0000000300");
    EXPECT_EQ(found[1].filename(), "0000000020");
    EXPECT_EQ(find().path, found[0]);

    // A run that resumes removes what was half-written, or not yet removed when
    // the run before was killed; one that starts anew removes all.
    fs::create_directories(folder / "checkpoints" / "0000000001");
    checkpoint->begin(folder, MPI_COMM_WORLD, found[0]);
    EXPECT_EQ(find_checkpoints(folder).size(), 2u);
    EXPECT_FALSE(fs::exists(folder / "checkpoints" / "0000000009.part"));
    checkpoint->begin(folder, MPI_COMM_WORLD);
    EXPECT_TRUE(fs::is_empty(folder / "checkpoints"));
  }



  TEST_F(CheckpointTest, FallsBackToThePrevious)
  {
    const fs::path previous = write(1);
    const fs::path newest   = write(2);
    flip_a_bit(newest / "state.h5");
    FoundCheckpoint found = find();
    EXPECT_EQ(found.path, previous);
    EXPECT_EQ(found.head.step, 1u);
    ASSERT_EQ(found.errors.size(), 1u);
    EXPECT_EQ(found.errors[0].find("The checkpoint '" + newest.string() +
                                   "' is damaged: "),
              0u);

    // Resumed from the previous, the run comes to the same step again.
    checkpoint->begin(folder, MPI_COMM_WORLD, previous);
    EXPECT_EQ(write(2), newest);
    EXPECT_EQ(find().path, newest);

    flip_a_bit(newest / "mesh");
    flip_a_bit(previous / "mesh.info");
    const std::string sentence = sentence_thrown_by([&]() { find(); });
    EXPECT_NE(sentence.find("no other checkpoint"), std::string::npos)
      << sentence;
    EXPECT_NE(sentence.find("mesh"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find(previous.string()), std::string::npos) << sentence;
  }



  // A user's notes, and what NFS keeps of a file that was removed.
  TEST_F(CheckpointTest, FilesOfOthersAreNoDamage)
  {
    const fs::path previous = write(1);
    const fs::path newest   = write(2);
    for (const std::string name : {"notes.txt", ".nfs0001"})
      std::ofstream(newest / name) << "of others\n";
    EXPECT_EQ(find().path, newest);
    fs::remove(newest / "mesh.info");
    EXPECT_EQ(find().path, previous);

    // The run comes to the same step again.
    checkpoint->begin(folder, MPI_COMM_WORLD, previous);
    EXPECT_EQ(write(2), newest);
    EXPECT_EQ(find().path, newest);
    EXPECT_TRUE(fs::exists(newest / "notes.txt"));
  }



  TEST_F(CheckpointTest, OfAnotherDimensionOrFormat)
  {
    const fs::path path = write(1);
    EXPECT_NE(sentence_thrown_by([&]() { find(3); }).find("Dimension = 2"),
              std::string::npos);
    const std::string lines = text("format ", checkpoint_format + 1, '\n');
    std::ofstream(path / "checksums")
      << lines << "checksums " << checksum(lines) << '\n';
    const std::string sentence = sentence_thrown_by([&]() { find(); });
    for (const std::string &part :
         {text("the format version ", checkpoint_format + 1),
          text("reads version ", checkpoint_format)})
      EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
  }



  TEST_F(CheckpointTest, UnfinishedRunsAreGuarded)
  {
    check_nothing_unfinished(folder, MPI_COMM_WORLD);
    write(3); // at 0.3 of 1 s
    EXPECT_NE(sentence_thrown_by([&]() {
                check_nothing_unfinished(folder, MPI_COMM_WORLD);
              }).find("--resume"),
              std::string::npos);
    write(10);
    check_nothing_unfinished(folder, MPI_COMM_WORLD);
  }



  TEST_F(CheckpointTest, FolderThatCannotBeWritten)
  {
    // Root may write everywhere, so there is a file where the folder should be.
    fs::remove_all(folder / "checkpoints");
    std::ofstream(folder / "checkpoints") << "a file\n";
    const std::string sentence = sentence_thrown_by([&]() { write(1); });
    EXPECT_NE(sentence.find("A checkpoint could not be written to '" +
                            folder.string()),
              std::string::npos)
      << sentence;
    EXPECT_NE(sentence.find("There is no earlier checkpoint"),
              std::string::npos)
      << sentence;
  }



  // -------------------------------------------------------------- parameters

  const std::string saved_parameters = "# comment\n"
                                       "set End time = 1\n"
                                       "subsection Grid\n"
                                       "  set Cell size    = 1e-1  # [m]\n"
                                       "  set Lower corner = 0, 0\n"
                                       "end\n"
                                       "subsection Materials\n"
                                       "  subsection clay\n"
                                       "    set Law = von Mises\n"
                                       "  end\n"
                                       "  set Names = clay\n"
                                       "end\n"
                                       "subsection Output\n"
                                       "  set Folder = a=b\n"
                                       "end\n";

  std::string
  change(const std::string &from, const std::string &to)
  {
    std::string now = saved_parameters;
    now.replace(now.find(from), from.size(), to);
    return sentence_thrown_by(
      [&]() { check_parameter_changes(saved_parameters, now); });
  }



  TEST(ParameterChanges, OnlyCriticalOnesAreRefused)
  {
    EXPECT_EQ(change("= 1\n", "= 2\n"), "no error");
    EXPECT_EQ(change("a=b", "c"), "no error");
    EXPECT_EQ(change("1e-1 ", "0.1"), "no error");
    EXPECT_EQ(change("0, 0", "0,0.0"), "no error");
    const std::string sentence = change("von Mises", "neo-Hookean");
    EXPECT_NE(sentence.find("'Materials/clay/Law' is 'neo-Hookean', but in the "
                            "run to resume it was 'von Mises'"),
              std::string::npos)
      << sentence;
    for (const auto &[from, to] :
         {std::pair<std::string, std::string>{"1e-1 ", "0.2"},
          std::pair<std::string, std::string>{"0, 0", "0, 1"},
          std::pair<std::string, std::string>{"0, 0", "0"},
          std::pair<std::string, std::string>{"set Names = clay", ""},
          std::pair<std::string, std::string>{"end\n", "  set X = 1\nend\n"}})
      EXPECT_NE(change(from, to), "no error") << from << to;
  }
} // namespace
