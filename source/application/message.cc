// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/application/message.h>
#include <talus/base/did_you_mean.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/utilities.h>

#include <boost/program_options/errors.hpp>

#include <filesystem>
#include <iomanip>
#include <map>
#include <new>
#include <regex>
#include <sstream>

namespace talus
{
  namespace
  {
    /// Replace control characters of @p word as in \x1b, so that text from a
    /// file cannot control the terminal.
    std::string
    printable(const std::string &word)
    {
      std::ostringstream result;
      for (const unsigned char c : word)
        if (c < ' ' || c == 127)
          result << "\\x" << std::hex << std::setw(2) << std::setfill('0')
                 << static_cast<int>(c);
        else
          result << c;
      return result.str();
    }



    /// Text of an exception without line breaks. For deal.II's exceptions only
    /// print_info(): file, line and stack tell a user nothing.
    std::string
    one_line(const std::exception &exception)
    {
      std::ostringstream information;
      if (const auto *e =
            dynamic_cast<const dealii::ExceptionBase *>(&exception))
        e->print_info(information);
      else
        information << exception.what();
      std::istringstream words(information.str());
      std::string        line, word;
      while (words >> word)
        line +=
          (line.empty() ? "" : " ") +
          printable(word.size() < 1000 ? word : word.substr(0, 100) + "...'");
      return line;
    }



    /// Translate deal.II's description of a pattern, made for programs, into
    /// plain words. The order matters: special cases come before general cases.
    std::string
    expected(const std::string &pattern)
    {
      static const std::pair<std::regex, std::string> words[] = {
        {std::regex("\\[Bool\\]"), "true or false"},
        {std::regex("\\[Double( -?M(IN|AX)_DOUBLE\\.\\.\\.MAX_DOUBLE "
                    "\\(inclusive\\))?\\]"),
         "a number"},
        {std::regex("\\[Double (\\S+)\\.\\.\\.MAX_DOUBLE \\(inclusive\\)\\]"),
         "a number of at least $1"},
        {std::regex("\\[Double (\\S+)\\.\\.\\.(\\S+) \\(inclusive\\)\\]"),
         "a number from $1 to $2"},
        {std::regex("\\[Integer( range -2147483648\\.\\.\\.2147483647 "
                    "\\(inclusive\\))?\\]"),
         "a whole number"},
        {std::regex("\\[Integer range (\\S+)\\.\\.\\.2147483647 "
                    "\\(inclusive\\)\\]"),
         "a whole number of at least $1"},
        {std::regex(
           "\\[Integer range (\\S+)\\.\\.\\.(\\S+) \\(inclusive\\)\\]"),
         "a whole number from $1 to $2"},
        {std::regex("\\[Selection \\|?(.*?) ?\\]"), "one of $1"},
        {std::regex("\\[List of <(.*)> of length (\\S+)\\.\\.\\.(\\S+) "
                    "\\(inclusive\\)\\]"),
         "a list of $2 to $3 values, each $1,"},
        {std::regex("(\\d+) to \\1 values"), "$1 values"},
        {std::regex("list of 0 to 4294967295 values"), "list of values"},
        {std::regex("(\\d+) to 4294967295 values"), "$1 or more values"}};
      std::string result = pattern;
      for (const auto &[description, plain] : words)
        result = std::regex_replace(result, description, plain);
      return std::regex_replace(result, std::regex("\\|"), " | ");
    }



    /// Return a question for the entry or section most similar to @p name,
    /// among the lines of all parameters that begin with @p keyword.
    std::string
    similar(const std::string &name, const std::string &keyword)
    {
      std::stringstream all;
      dealii::ParameterAcceptor::prm.print_parameters(
        all, dealii::ParameterHandler::ShortText);
      std::vector<std::string> names;
      for (std::string line; std::getline(all, line);)
        if (line = dealii::Utilities::trim(line); line.rfind(keyword, 0) == 0)
          names.push_back(dealii::Utilities::trim(
            line.substr(keyword.size(), line.find('=') - keyword.size())));
      return did_you_mean(name, names);
    }



    /// Return what replaces a parameter or section of former versions;
    /// otherwise empty.
    std::string
    replacement(const std::string &name)
    {
      static const std::map<std::string, std::string> replacements = {
        {"Format",
         " Points, grid and obstacles are VTU files without a choice: remove "
         "Output/Format."},
        {"Smallest load step",
         " The factor of safety is found without load steps: remove the line."},
        {"Undrained shear strength",
         " The laws 'von Mises', 'Bingham' and 'Herschel-Bulkley' have it; "
         "'Mohr-Coulomb' has 'Cohesion' and 'Friction angle', and under "
         "'modified Cam clay' it is a result."},
        {"Friction angle",
         " The laws 'Mohr-Coulomb' and 'modified Cam clay' have it; 'von "
         "Mises', 'Bingham' and 'Herschel-Bulkley' have 'Undrained shear "
         "strength'."},
        {"Young's modulus",
         " The stiffness of 'modified Cam clay' follows from the stress and "
         "the 'Slope of swelling line': remove the line."},
        {"Strain",
         " Static stages always use small strain: remove the line. A body at "
         "large strain comes to rest in the stage 'dynamics', with "
         "'Gravity/Ramp time' and 'Damping/Local damping'."},
        {"Tsunami source",
         " Set 'Output/Plan interval' and, for other cells, 'Maps/Cell size'. "
         "After the run, `talus-tsunami FOLDER` makes the source; its options "
         "replace the other parameters."}};
      const auto found = replacements.find(name);
      return found == replacements.end() ? "" : found->second;
    }



    /// Rewrite an @p error of the parameter parser as a sentence that begins
    /// with @p place and says what to do. Unknown messages, for example of a
    /// new version of deal.II, pass unchanged.
    std::string
    say_anew(const std::string &place, const std::string &error)
    {
      static const std::regex unknown_entry(
        "No entry with name <(.*)> was declared.*");
      static const std::regex unknown_section(
        // Wording of deal.II 9.4 and of deal.II 9.6.
        "(?:There is no such subsection to be entered: |You are trying to "
        "enter a subsection ')(.*?)(?:', but the ParameterHandler .*)?");
      static const std::regex bad_value(
        "The entry value (?:(.*) )?for the entry "
        "named (.*) does not match the given "
        "pattern: (.*)");
      static const char *const listed =
        " `talus --document` lists all sections and parameters. Sections of "
        "bodies and materials are named in Bodies/Names and Materials/Names.";
      static const std::regex bad_line("The line <(.*)> could not be parsed.*");

      std::smatch part;
      const auto  advice = [&part](const std::string &keyword) {
        const std::string found = replacement(part[1]);
        return found.empty() ? similar(part[1], keyword) + listed : found;
      };
      if (std::regex_match(error, part, unknown_entry))
        return place + "there is no parameter '" + part[1].str() +
               "' in this section." + advice("set ");
      if (std::regex_match(error, part, unknown_section))
        return place + "there is no section '" + part[1].str() + "' here." +
               advice("subsection ");
      if (std::regex_match(error, part, bad_value))
        return place + "'" + part[2].str() + "' is '" + part[1].str() +
               "', where " + expected(part[3]) +
               " was expected; correct the value.";
      if (std::regex_match(error, part, bad_line))
        return place + "'" + part[1].str() +
               "' was found, where 'set Entry = value', 'subsection Name' or "
               "'end' was expected; start a comment with #.";
      return place + error;
    }
  } // namespace



  /// Messages of talus are sentences already and pass unchanged. Messages of
  /// deal.II and of the standard library are translated here only.
  std::string
  message(const std::exception &exception)
  {
    // deal.II's message contains the place; the names after "file" are set by
    // ParameterFile::parse_into().
    static const std::regex in_command(
      "Line <\\d+> of file <(--set .*?)>?: (.*)");
    static const std::regex in_file("Line <(\\d+)> of file <(.*?)>?: (.*)");

    const std::string line = one_line(exception);
    std::smatch       part;
    if (const auto *error =
          dynamic_cast<const std::filesystem::filesystem_error *>(&exception))
      return "The path '" + printable(error->path1().string().substr(0, 100)) +
             "' cannot be used (" + error->code().message() +
             "). Give another path.";
    if (dynamic_cast<const boost::program_options::error *>(&exception))
      return "On the command line, " + line +
             "; `talus --help` shows what is expected.";
    if (dynamic_cast<const std::bad_alloc *>(&exception))
      return "There is not enough memory on this machine; doc/cluster.md gives "
             "the memory per point and cell. Use fewer points or cells, or "
             "more ranks on more machines.";
    // Test before in_file, whose pattern matches, too.
    if (std::regex_match(line, part, in_command))
      return say_anew(part[1].str() + ": ", part[2]);
    if (std::regex_match(line, part, in_file))
      return say_anew(part[2].str() + ", line " + part[1].str() + ": ",
                      part[3]);
    return line;
  }
} // namespace talus
