// SPDX-License-Identifier: LGPL-2.1-or-later
// What the user is told when something goes wrong.

#include <talus/application/message.h>
#include <talus/base/errors.h>

#include <deal.II/base/parameter_handler.h>

#include <boost/program_options.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <new>
#include <sstream>

namespace
{
  using namespace talus;
  namespace Patterns = dealii::Patterns;

  /// What is told when the parser finds @p input, with the entries below.
  std::string
  told_of(const std::string &input, const std::string &name = "slope.prm")
  {
    dealii::ParameterHandler prm;
    prm.declare_entry("Title", "");
    prm.enter_subsection("Grid");
    prm.declare_entry("Cell size", "1", Patterns::Double(0.));
    prm.declare_entry("Share", "0.5", Patterns::Double(0., 1.));
    prm.declare_entry("Start", "0", Patterns::Double());
    prm.declare_entry("Levels", "1", Patterns::Integer(1));
    prm.declare_entry("Dimension", "2", Patterns::Integer(2, 3));
    prm.declare_entry("Offset", "2", Patterns::Integer());
    prm.declare_entry("Rule", "on", Patterns::Selection("auto|on|off"));
    prm.declare_entry("Shape", "", Patterns::Selection("|box|ball"));
    prm.declare_entry("Moves", "true", Patterns::Bool());
    prm.declare_entry("Places", "", Patterns::List(Patterns::Double()));
    prm.declare_entry("Names", "1", Patterns::List(Patterns::Double(), 1));
    prm.declare_entry("Corner",
                      "0, 0",
                      Patterns::List(Patterns::Double(), 2, 2));
    prm.leave_subsection();
    std::istringstream stream(input);
    try
      {
        prm.parse_input(stream, name);
      }
    catch (const std::exception &exception)
      {
        return message(exception);
      }
    return "";
  }



  /// What is told of the entry @p name of the section Grid if it is 'jelly'.
  std::string
  told_of_value(const std::string &name)
  {
    return told_of("# a comment\nsubsection Grid\n  set " + name +
                   " = jelly\nend\n");
  }



  TEST(Message, ValuesOfAnotherKind)
  {
    const std::pair<std::string, std::string> expected[] = {
      {"Cell size", "a number of at least 0"},
      {"Share", "a number from 0 to 1"},
      {"Start", "a number"},
      {"Levels", "a whole number of at least 1"},
      {"Dimension", "a whole number from 2 to 3"},
      {"Offset", "a whole number"},
      {"Rule", "one of auto | on | off"},
      {"Shape", "one of box | ball"},
      {"Moves", "true or false"},
      {"Places", "a list of values, each a number,"},
      {"Names", "a list of 1 or more values, each a number,"},
      {"Corner", "a list of 2 values, each a number,"}};
    for (const auto &[entry, words] : expected)
      EXPECT_EQ(told_of_value(entry),
                "slope.prm, line 3: '" + entry + "' is 'jelly', where " +
                  words + " was expected; correct the value.");
  }



  TEST(Message, WhatThereIsNot)
  {
    const std::string end =
      ". `talus --document` lists all sections and parameters. Sections of "
      "bodies and materials are named in Bodies/Names and Materials/Names.";
    EXPECT_EQ(
      told_of("set Titel = slide\n"),
      "slope.prm, line 1: there is no parameter 'Titel' in this section" + end);
    const std::string section = told_of("\nsubsection Girder\nend\n");
    EXPECT_EQ(section.find("slope.prm, line 2: there is no section 'Girder' "
                           "here. `talus --document` lists"),
              0u)
      << section;
  }



  TEST(Message, LinesThatCannotBeRead)
  {
    EXPECT_EQ(
      told_of("let there be soil\n"),
      "slope.prm, line 1: 'let there be soil' was found, where 'set "
      "Entry = value', 'subsection Name' or 'end' was expected; start a "
      "comment with #.");
  }



  // Of what the command line sets there is no line to name.
  TEST(Message, OverridesAreNamedAsGiven)
  {
    EXPECT_EQ(
      told_of("subsection Grid\nset Levels = 0\nend\n", "--set Grid/Levels=0"),
      "--set Grid/Levels=0: 'Levels' is '0', where a whole number of at "
      "least 1 was expected; correct the value.");
  }



  TEST(Message, OwnSentencesStayOnOneLine)
  {
    EXPECT_EQ(message(ExcUser("The body 'slide'\n  is empty.")),
              "The body 'slide' is empty.");
    EXPECT_EQ(message(ExcPoint("Point 7 left.")), "Point 7 left.");
    EXPECT_EQ(message(std::runtime_error("odd")), "odd");
    EXPECT_EQ(message(ExcUser("No '\033[31mred'.")), "No '\\x1b[31mred'.");
  }



  TEST(Message, CommandLineAndMemory)
  {
    EXPECT_EQ(
      message(boost::program_options::unknown_option("--sett")),
      "On the command line, unrecognised option '--sett'; `talus --help` "
      "shows what is expected.");
    EXPECT_EQ(message(std::bad_alloc())
                .find("There is not enough memory on this machine;"),
              0u);
    EXPECT_EQ(message(std::filesystem::filesystem_error(
                "symlink_status",
                std::string(4100, 'a'),
                std::make_error_code(std::errc::filename_too_long))),
              "The path '" + std::string(100, 'a') +
                "' cannot be used (File name too long). Give another path.");
  }
} // namespace
