// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/application/message.h>
#include <talus/application/parameter_file.h>
#include <talus/application/parameter_lines.h>
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/io/files.h>
#include <talus/io/run_record.h>
#include <talus/io/text_file.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// The override in the language of parameter files.
    /// "A/B/C=value" becomes C in subsection B of subsection A. The first =
    /// separates, so that a value, as an expression, may have others.
    std::string
    as_parameter_file(const std::string &override_text)
    {
      const auto equals = override_text.find('=');
      AssertThrow(equals != std::string::npos && equals > 0,
                  ExcUser("--set '" + override_text +
                          "' was given, where 'Section/Subsection/Entry=value' "
                          "was expected."));
      // What stood in a line of its own could include a file, and a backslash
      // at the end joins the next line.
      AssertThrow(override_text.find('\n') == std::string::npos &&
                    Utilities::trim(override_text).back() != '\\',
                  ExcUser("--set '" + override_text.substr(0, equals) +
                          "' was given a value of several lines, or with a "
                          "backslash at its end, where one line was expected. "
                          "Give --set once for each entry."));
      auto path =
        Utilities::split_string_list(override_text.substr(0, equals), '/');
      const std::string entry = path.back();
      path.pop_back();
      std::string result;
      for (const std::string &section : path)
        result += "subsection " + section + "\n";
      result +=
        "set " + entry + " = " + override_text.substr(equals + 1) + "\n";
      for (std::size_t i = 0; i < path.size(); ++i)
        result += "end\n";
      return result;
    }



    /// The names become sections, so they may have no slash and must differ; the
    /// section has an entry `Names` already.
    std::vector<std::string>
    names(const std::string &list, const std::string &where)
    {
      const auto result = Utilities::split_string_list(list, ',');
      for (const std::string &name : result)
        {
          AssertThrow(!name.empty() && name.find('/') == std::string::npos,
                      ExcUser("'" + where + " = " + list +
                              "' must be a list of names separated by commas, "
                              "without slashes."));
          AssertThrow(name != "Names",
                      ExcUser("'" + where + " = " + list +
                              "' lists 'Names', which is the entry itself. "
                              "Choose another name."));
          AssertThrow(std::count(result.begin(), result.end(), name) == 1,
                      ExcUser("'" + where + " = " + list + "' lists '" + name +
                              "' twice; names must differ."));
        }
      return result;
    }
  } // namespace



  namespace
  {
    /// The whole of a file that parameters may be in. Only the first one may be a
    /// pipe: those that it includes are read twice.
    std::string
    read_parameter_file(const std::string &name, const Pipes pipes)
    {
      const auto content = read_text_file(name, pipes);
      AssertThrow(content.has_value(),
                  ExcUser("The parameter file '" + name +
                          "' cannot be read. Give the path of an existing "
                          "file."));
      return *content;
    }



    /// The first rank reads and tells the others: of a pipe each would get a part,
    /// and wait for the rest. So does what went wrong. Collective.
    std::string
    read_by_first_rank(const std::string &name)
    {
      std::string content, error;
      if (is_first_rank(MPI_COMM_WORLD))
        try
          {
            content = read_parameter_file(name, Pipes::read);
          }
        catch (const ExcUser &exception)
          {
            error = message(exception);
          }
      error = first_sentence(error, MPI_COMM_WORLD);
      AssertThrow(error.empty(), ExcUser(error));
      return Utilities::MPI::broadcast(MPI_COMM_WORLD, content);
    }



    /// What a line includes; empty if it does not.
    std::string
    included_file(const std::string &line)
    {
      std::istringstream words(line);
      std::string        word, file;
      words >> word;
      if (word != "include" && word != "INCLUDE")
        return "";
      std::getline(words >> std::ws, file);
      return Utilities::trim(file);
    }
  } // namespace



  /// deal.II's own message would show its stack. The record of an earlier run may
  /// be replaced by that of this one, which says the same.
  ParameterFile::ParameterFile(const std::string              &file_name,
                               const std::vector<std::string> &overrides)
    : file_name_(file_name)
    , content_(read_by_first_rank(file_name))
    , overrides_(overrides)
  {
    if (!is_run_record(file_name_))
      protect_input(file_name_);
    unsigned int n_includes = 1000;
    check(content_, {file_name_}, n_includes);
    for (const std::string &override_text : overrides_)
      for (const ParameterLine &line :
           parameter_lines(as_parameter_file(override_text)))
        check_line("--set " + override_text + ": ", line.text);
  }



  // deal.II reads the files that are included, as parts of the text, but would
  // follow a circle for ever. Files that include others twice double with each
  // file of the chain.
  void
  ParameterFile::check(const std::string              &content,
                       const std::vector<std::string> &chain,
                       unsigned int                   &n_left)
  {
    const auto lines = parameter_lines(content);
    check_lines(chain.back(), lines);
    for (const std::string &remark : entries_set_twice(chain.back(), lines))
      if (std::find(remarks_.begin(), remarks_.end(), remark) == remarks_.end())
        remarks_.push_back(remark);
    for (const ParameterLine &line : lines)
      {
        const std::string file = included_file(line.text);
        if (file.empty())
          continue;
        AssertThrow(std::find(chain.begin(), chain.end(), file) == chain.end(),
                    ExcUser("The parameter file '" + chain.back() +
                            "' includes '" + file +
                            "', which includes it in turn, directly or by "
                            "others. Remove one of the lines 'include'."));
        AssertThrow(n_left > 0,
                    ExcUser("The parameter file '" + chain.front() +
                            "' includes others more than 1000 times, those "
                            "that they include counted. Include fewer."));
        --n_left;
        protect_input(file);
        std::vector<std::string> longer = chain;
        longer.push_back(file);
        AssertThrow(longer.size() <= 20,
                    ExcUser("The parameter file '" + chain.front() +
                            "' includes others through more than 20 files, "
                            "down to '" +
                            file + "'. Include fewer."));
        check(read_parameter_file(file, Pipes::refused), longer, n_left);
      }
  }



  /// What the command line sets comes after the file and so wins, in the same
  /// language and with the same checks. Errors name the option as they would a
  /// file.
  void
  ParameterFile::parse_into(ParameterHandler &prm,
                            const bool        skip_undefined) const
  {
    std::istringstream file(content_);
    prm.parse_input(file, file_name_, "", skip_undefined);
    for (const std::string &override_text : overrides_)
      {
        std::istringstream input(as_parameter_file(override_text));
        prm.parse_input(input, "--set " + override_text, "", skip_undefined);
      }
  }



  /// Which parameters there are depends on parameters: the dimension, the names
  /// of bodies and materials, and the law of each. These are read first, with
  /// all others ignored: once for the names, which say in which sections the
  /// laws are, and then for the laws. After that every object can declare its
  /// own, and parse() is strict.
  ParameterPreview
  ParameterFile::preview() const
  {
    ParameterHandler prm;
    prm.declare_entry("Dimension", "2", Patterns::Integer(2, 3));
    for (const std::string section :
         {"Bodies", "Materials", "Obstacles", "Surfaces"})
      {
        prm.enter_subsection(section);
        prm.declare_entry("Names", "");
        prm.leave_subsection();
      }
    parse_into(prm, /*skip_undefined=*/true);

    ParameterPreview preview;
    preview.folder    = std::filesystem::path(file_name_).parent_path();
    preview.dimension = prm.get_integer("Dimension");
    preview.remarks   = remarks_;
    prm.enter_subsection("Bodies");
    preview.bodies = names(prm.get("Names"), "Bodies/Names");
    prm.leave_subsection();
    prm.enter_subsection("Obstacles");
    preview.obstacles = names(prm.get("Names"), "Obstacles/Names");
    prm.leave_subsection();
    prm.enter_subsection("Surfaces");
    preview.surfaces = names(prm.get("Names"), "Surfaces/Names");
    prm.leave_subsection();
    prm.enter_subsection("Materials");
    const auto materials = names(prm.get("Names"), "Materials/Names");
    const Patterns::Selection laws(
      boost::algorithm::join(material_names<2>(), "|"));
    for (const std::string &name : materials)
      {
        prm.enter_subsection(name);
        prm.declare_entry("Law", "linear elastic", laws);
        prm.leave_subsection();
      }
    prm.leave_subsection();

    parse_into(prm, /*skip_undefined=*/true);
    prm.enter_subsection("Materials");
    for (const std::string &name : materials)
      {
        prm.enter_subsection(name);
        preview.materials.push_back({name, prm.get("Law")});
        prm.leave_subsection();
      }
    return preview;
  }



  namespace
  {
    /// No quantity in SI units comes near, and products of several such numbers
    /// are no infinities.
    constexpr double largest_number = 1e30;



    /// Throw ExcUser if the value of an entry is a number that is too large, or
    /// one of a list.
    void
    check_size(const std::string &path, std::string value)
    {
      for (char &c : value)
        if (c == ',' || c == ';' || c == '|')
          c = ' ';
      std::istringstream words(value);
      for (std::string word; words >> word;)
        {
          char *end           = nullptr;
          errno               = 0;
          const double number = std::strtod(word.c_str(), &end);
          const bool   is_lost_in_rounding =
            errno == ERANGE && std::abs(number) < 1.;
          // Not "inf", which some entries have for no limit.
          const bool is_number =
            *end == '\0' && word.find_first_of("0123456789") != word.npos;
          AssertThrow(!is_number || std::abs(number) <= largest_number,
                      ExcUser(text("'",
                                   path,
                                   "' has '",
                                   word,
                                   "', which is larger than any quantity in SI "
                                   "units: at most ",
                                   largest_number,
                                   " was expected. Correct the value, or leave "
                                   "it out if there is to be no limit.")));
          AssertThrow(!is_number || !is_lost_in_rounding,
                      ExcUser(
                        text("'",
                             path,
                             "' has '",
                             word,
                             "', which is closer to zero than numbers of "
                             "double precision can be. Give 0, or correct "
                             "the value.")));
        }
    }



    /// Whether the value is a name or a text, which may look like a number, as
    /// the folder 57e1234 does.
    bool
    is_text(const std::string &entry)
    {
      for (const std::string name : {"Title",
                                     "Folder",
                                     "File",
                                     "Names",
                                     "Material",
                                     "Surface",
                                     "Constants"})
        if (entry == name)
          return true;
      return false;
    }



    /// All entries, by the file that they would make: what is declared knows its
    /// place only there. Without std::regex, which takes stack by the character.
    void
    check_sizes(const ParameterHandler &prm)
    {
      std::istringstream       lines(parameters_as_text(prm));
      std::vector<std::string> path;
      const std::string        section = "subsection ", entry = "set ";
      for (std::string line; std::getline(lines, line);)
        {
          line = Utilities::trim(line);
          if (line.rfind(section, 0) == 0)
            path.push_back(line.substr(section.size()) + '/');
          else if (line == "end")
            path.pop_back();
          else if (line.rfind(entry, 0) == 0)
            {
              const std::size_t equals = line.find('=');
              const std::string name   = Utilities::trim(
                line.substr(entry.size(), equals - entry.size()));
              if (!is_text(name))
                check_size(boost::algorithm::join(path, "") + name,
                           line.substr(equals + 1));
            }
        }
    }
  } // namespace



  namespace
  {
    /// Throw ExcUser if there is no body or no material. After the strict pass,
    /// which tells if the section of the names is misspelt.
    void
    check_has_names(ParameterHandler &prm)
    {
      for (const std::string section : {"Bodies", "Materials"})
        {
          prm.enter_subsection(section);
          AssertThrow(!prm.get("Names").empty(),
                      ExcUser("'" + section +
                              "/Names' is empty, but at least one name is "
                              "needed: each has a section of that name with "
                              "its parameters."));
          prm.leave_subsection();
        }
    }
  } // namespace



  /// An entry that nobody declared is an error here: it is mostly misspelt.
  void
  ParameterFile::parse() const
  {
    ParameterAcceptor::declare_all_parameters();
    parse_into(ParameterAcceptor::prm, /*skip_undefined=*/false);
    check_has_names(ParameterAcceptor::prm);
    check_sizes(ParameterAcceptor::prm);
    ParameterAcceptor::parse_all_parameters();
  }
} // namespace talus
