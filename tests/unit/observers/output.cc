// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/run_record.h>
#include <talus/observers/output.h>

#include <gtest/gtest.h>

#include <csignal>
#include <sstream>

#include "observers_setup.h"

#include <sys/resource.h>

namespace
{
  using namespace talus;
  namespace fs = std::filesystem;

  // ----------------------------------------------------------------- output

  /// Files can be no longer than a kilobyte as long as this object lives.
  class SmallFiles
  {
  public:
    SmallFiles()
      : handler_(std::signal(SIGXFSZ, SIG_IGN))
    {
      getrlimit(RLIMIT_FSIZE, &before_);
      const rlimit small = {1024, before_.rlim_max};
      setrlimit(RLIMIT_FSIZE, &small);
    }

    ~SmallFiles()
    {
      setrlimit(RLIMIT_FSIZE, &before_);
      std::signal(SIGXFSZ, handler_);
    }

  private:
    void (*handler_)(int);
    rlimit before_;
  };



  class OutputTest : public ObserversTest
  {
  protected:
    PhaseTimer timer;
    Log        log{MPI_COMM_WORLD};
  };



  TEST_F(OutputTest, WritesWhatIsDueAndNoRowTwice)
  {
    Output<2> output(timer, log);
    Scene<2>  s("0, 0", "8, 4");
    s.add({0.5, 0.5});
    s.sort();
    output.set_folder(folder / "a" / "b");
    output.begin(s, 1.25, parameters_as_text(output.prm));
    output.start(s);
    for (s.step = 1; s.step <= 12; ++s.step)
      {
        s.time = s.step * 0.1;
        output.observe(s, s.step == 12);
      }
    // Rows at 0, 0.3, 0.5, 0.8, 1 and 1.2; fields at 0, 1 and 1.2.
    const auto rows = lines("a/b/statistics.csv");
    ASSERT_EQ(rows.size(), 1u + 6u);
    EXPECT_EQ(std::stod(rows[2]), 3 * 0.1);
    EXPECT_EQ(std::stod(rows[3]), 0.5);
    EXPECT_EQ(std::stod(rows[6]), 12 * 0.1);
    EXPECT_EQ(lines("a/b/profile.csv").size(), 1u + 3u);
    for (const std::string file : {"points", "grid"})
      {
        EXPECT_TRUE(fs::exists(folder / "a/b" / (file + ".pvd")));
        EXPECT_TRUE(fs::exists(folder / "a/b" / (file + "-0002.vtu")));
        EXPECT_FALSE(fs::exists(folder / "a/b" / (file + "-0003.vtu")));
      }
  }



  TEST_F(OutputTest, NoSecondRowIfTheLastStepIsDueAnyway)
  {
    Output<2> output(timer, log);
    Scene<2>  s("0, 0", "8, 4");
    s.add({0.5, 0.5});
    s.sort();
    output.set_folder(folder);
    output.begin(s, 1., parameters_as_text(output.prm));
    output.start(s);
    log.say(LogLevel::detail, "It begins.");
    s.step = 1;
    s.time = 0.1;
    EXPECT_FALSE(output.observe(s, false));
    s.step = 2;
    s.time = 1.;
    EXPECT_TRUE(output.observe(s, true));
    // Before the table of wall times.
    EXPECT_EQ(lines("log.txt").at(0), "It begins.");
    EXPECT_EQ(lines("log.txt").at(1).find("Wall time by phase"), 0u);
    // One point in two steps.
    EXPECT_EQ(lines("log.txt").back().find("Work: 2 point-steps of "), 0u);
    EXPECT_EQ(lines("statistics.csv").size(), 3u);
    EXPECT_EQ(lines("profile.csv").size(), 3u);
  }



  TEST_F(OutputTest, RecordsParametersAndVersions)
  {
    Output<2> output(timer, log);
    Scene<2>  s("0, 0", "8, 4");
    s.add({0.5, 0.5});
    s.sort();
    output.set_folder(folder);
    output.begin(s, 1., parameters_as_text(output.prm));
    output.start(s);
    std::string record;
    for (const std::string &line : lines("parameters.prm"))
      record += line + '\n';
    for (const std::string part : {"#   talus ",
                                   "git revision",
                                   "#   deal.II 9",
                                   "#   Trilinos 1",
                                   "#   p4est 2",
                                   "#   HDF5 1.",
                                   "#   Boost 1.",
                                   "subsection Output",
                                   "Statistics interval  = 0.25",
                                   "Cell size"})
      EXPECT_NE(record.find(part), std::string::npos) << part << record;
    EXPECT_NE(record.find(folder.string()), std::string::npos) << record;
    // It can be read again.
    dealii::ParameterAcceptor::prm.parse_input_from_string(record);
  }



  // Root may write everywhere, so the folder's parent is a file.
  TEST_F(OutputTest, FolderThatCannotBeMade)
  {
    std::ofstream(folder / "file") << "kept\n";
    for (const fs::path &path : {folder / "file", folder / "file" / "below"})
      {
        Output<2> output(timer, log);
        Scene<2>  s("0, 0", "8, 4");
        s.add({0.5, 0.5});
        s.sort();
        output.set_folder(path);
        const std::string sentence = sentence_thrown_by(
          [&]() { output.begin(s, 1., parameters_as_text(output.prm)); });
        EXPECT_NE(sentence.find("The output folder '" + path.string()),
                  std::string::npos)
          << sentence;
        EXPECT_NE(sentence.find("Output/Folder"), std::string::npos);
      }
    EXPECT_EQ(lines("file").at(0), "kept");
  }



  TEST_F(OutputTest, FullDisk)
  {
    Output<2> output(timer, log);
    Scene<2>  s("0, 0", "8, 4");
    s.add({0.5, 0.5});
    s.sort();
    output.set_folder(folder);
    fs::create_symlink("/dev/full", folder / "statistics.csv");
    std::string sentence = sentence_thrown_by(
      [&]() { output.begin(s, 1., parameters_as_text(output.prm)); });
    EXPECT_NE(sentence.find("The file '" +
                            (folder / "statistics.csv").string() +
                            "' could not be written (No space left on device"),
              std::string::npos)
      << sentence;

    // A file that is written as a whole is so or not at all: where it cannot be
    // written to its end, one that is there stays.
    const fs::path path = folder / "points-0000.vtu";
    std::ofstream(path) << "earlier result\n";
    {
      const SmallFiles only;
      sentence = sentence_thrown_by([&]() {
        write_file(path,
                   [](std::ostream &out) { out << std::string(1 << 16, 'x'); });
      });
    }
    EXPECT_NE(sentence.find("points-0000.vtu' could not be written (File too "
                            "large"),
              std::string::npos)
      << sentence;
    EXPECT_EQ(lines("points-0000.vtu").at(0), "earlier result");
    EXPECT_FALSE(fs::exists(folder / "points-0000.vtu.part"));
  }



  // A link with the name of a file that is being written leads to a file of the
  // user.
  TEST_F(OutputTest, LinksAreNotFollowed)
  {
    std::ofstream(folder / "mine") << "mine\n";
    fs::create_symlink("mine", folder / "table.part");
    write_file(folder / "table", [](std::ostream &out) { out << "ours\n"; });
    EXPECT_EQ(lines("mine").at(0), "mine");
    EXPECT_EQ(lines("table").at(0), "ours");
  }



  TEST_F(OutputTest, RemarksAreNumbered)
  {
    log.remark("Said before log.txt is open.");
    log.open(folder, Beginning::fresh);
    log.say(LogLevel::detail, "No remark.");
    log.remark("Soil is in the air.");
    EXPECT_EQ(log.count_of_remarks(), "2 remarks");
    EXPECT_EQ(lines("log.txt").at(0), "No remark.");
    EXPECT_EQ(lines("log.txt").at(1), "Remark 2: Soil is in the air.");
  }



  // --------------------------------------------------------------- progress

  TEST(Progress, LinesOnATerminalAndThroughputAlways)
  {
    for (const bool is_terminal : {true, false})
      {
        std::ostringstream out;
        Progress           progress(out, is_terminal);
        progress.begin(0., 2., MPI_COMM_WORLD);
        progress.count_step(100);
        progress.count_step(120);
        progress.print_line(0.5, 120);
        EXPECT_EQ(out.str().empty(), !is_terminal);
        for (const char *part : {"0.500 s", "25 %", "120 points"})
          EXPECT_EQ(out.str().find(part) != std::string::npos, is_terminal);
        out.str("");
        progress.finish(0.5, 120);
        EXPECT_NE(out.str().find("2 steps to t = 0.5 s, 120 points"),
                  std::string::npos);
        EXPECT_NE(out.str().find("220 point-steps"), std::string::npos);
        EXPECT_NE(out.str().find("million point-steps per second."),
                  std::string::npos);
      }
  }
} // namespace
