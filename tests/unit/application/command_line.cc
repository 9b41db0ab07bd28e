// SPDX-License-Identifier: LGPL-2.1-or-later
// What the command line asks for.

#include <talus/application/command_line.h>
#include <talus/materials/material_model.h>

#include <boost/program_options/errors.hpp>

#include <sstream>

#include "core_setup.h"

namespace
{
  using namespace talus;

  std::optional<CommandLine>
  parse(std::vector<const char *> arguments)
  {
    arguments.insert(arguments.begin(), "talus");
    return parse_command_line(arguments.size(), arguments.data());
  }



  TEST(CommandLine, FileAlone)
  {
    const auto line = parse({"slope.prm"});
    ASSERT_TRUE(line);
    EXPECT_EQ(line->parameter_file, "slope.prm");
    EXPECT_TRUE(line->overrides.empty());
    EXPECT_EQ(line->output_folder, "");
    EXPECT_FALSE(line->validate || line->document || line->resume ||
                 line->overwrite);
  }



  TEST(CommandLine, OptionsAroundTheFile)
  {
    const auto line = parse({"--set",
                             "End time=3",
                             "--output",
                             "there",
                             "slope.prm",
                             "--resume",
                             "--validate",
                             "--set",
                             "Grid/Refinement boxes=30,0; 60,4; 1"});
    ASSERT_TRUE(line);
    EXPECT_EQ(line->parameter_file, "slope.prm");
    EXPECT_EQ(line->overrides,
              (std::vector<std::string>{
                "End time=3", "Grid/Refinement boxes=30,0; 60,4; 1"}));
    EXPECT_EQ(line->output_folder, "there");
    EXPECT_TRUE(line->resume && line->validate);
    EXPECT_FALSE(line->overwrite || line->document);
  }



  TEST(CommandLine, QuestionsAreAnswered)
  {
    const auto answer = [](const char *question) {
      testing::internal::CaptureStdout();
      EXPECT_FALSE(parse({question}));
      return testing::internal::GetCapturedStdout();
    };
    const std::string help = answer("--help");
    for (const std::string option : {"--set",
                                     "--output",
                                     "--resume",
                                     "--overwrite",
                                     "--validate",
                                     "--document",
                                     "--version"})
      EXPECT_TRUE(contains(help, option)) << option;
    EXPECT_EQ(answer("--version").find("talus "), 0u);
    // The reference of all parameters is of no file.
    EXPECT_TRUE(parse({"--document"})->document);
  }



  TEST(CommandLine, WhatMakesNoSenseIsRefused)
  {
    EXPECT_TRUE(contains(message_of<ExcUser>([] { parse({}); }),
                         "No parameter file was given."));
    EXPECT_TRUE(contains(message_of<ExcUser>([] {
                           parse({"slope.prm", "--resume", "--overwrite"});
                         }),
                         "Give one of the two."));
    for (const std::vector<const char *> &wrong :
         {std::vector<const char *>{"slope.prm", "--sett"},
          std::vector<const char *>{"slope.prm", "flat.prm"},
          std::vector<const char *>{"slope.prm", "--set"},
          std::vector<const char *>{"slope.prm", "--resume=yes"}})
      EXPECT_THROW(parse(wrong), boost::program_options::error);
  }



  // Each law in a section of its own, each parameter with its sentence.
  TEST(CommandLine, DocumentHasAllLaws)
  {
    const FreshParameters fresh;
    std::ostringstream    out;
    document(out);
    for (const std::string &law : material_names<2>())
      EXPECT_TRUE(contains(out.str(), "subsection " + law + "\n")) << law;
    EXPECT_TRUE(contains(out.str(), "set Cell size"));
    EXPECT_TRUE(contains(out.str(), "# Constitutive law."))
      << "sentences are comments above the entries";
  }
} // namespace
