// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/application/message.h>
#include <talus/application/parameter_file.h>
#include <talus/application/parameter_lines.h>
#include <talus/application/unusual_values.h>
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/checkpoint/parameter_changes.h>
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
#include <map>
#include <set>
#include <sstream>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Write an override in the language of parameter files: "A/B/C=value"
    /// becomes entry C in subsection B of subsection A. The first = separates
    /// name and value; further = belong to the value, for example an
    /// expression.
    std::string
    as_parameter_file(const std::string &override_text)
    {
      const auto equals = override_text.find('=');
      AssertThrow(equals != std::string::npos && equals > 0,
                  ExcUser("--set '" + override_text +
                          "' was given, where 'Section/Subsection/Entry=value' "
                          "was expected."));
      // A line break in the value could hide an `include`, a backslash at the
      // end joins the next line, and # begins a comment.
      AssertThrow(override_text.find_first_of("\n#") == std::string::npos &&
                    Utilities::trim(override_text).back() != '\\',
                  ExcUser("--set '" + override_text.substr(0, equals) +
                          "' was given a value of several lines, with a '#' or "
                          "with a backslash at its end, where one line without "
                          "a comment was expected. Correct the value, and "
                          "give --set once for each entry."));
      check_utf8("--set '" + override_text.substr(0, equals) + "'",
                 override_text.substr(equals));
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



    /// Split a list of names, which become sections: names must differ, contain
    /// no slash, and not be `Names`, an entry of the section.
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
                              "' lists 'Names', the name of the entry itself. "
                              "Choose a different name."));
          AssertThrow(std::count(result.begin(), result.end(), name) == 1,
                      ExcUser("'" + where + " = " + list + "' lists '" + name +
                              "' twice; names must differ."));
        }
      return result;
    }



    /// Read a parameter file. Only the first file may be a pipe: included files
    /// are read twice.
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



    /// Read a file on the first rank and send text or error to all ranks:
    /// several ranks would each get a part of a pipe and wait for the rest.
    /// Collective.
    std::string
    read_by_first_rank(const std::string &name, const MPI_Comm communicator)
    {
      std::string content, error;
      if (is_first_rank(communicator))
        try
          {
            content = read_parameter_file(name, Pipes::read);
          }
        catch (const ExcUser &exception)
          {
            error = message(exception);
          }
      error = first_sentence(error, communicator);
      AssertThrow(error.empty(), ExcUser(error));
      return Utilities::MPI::broadcast(communicator, content);
    }



    /// Name of the file that the line includes; empty without `include`.
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



  /// Read errors are reported here, as deal.II's message would include its
  /// stack. The record of an earlier run is not protected: the new run replaces
  /// it by an equal record.
  ParameterFile::ParameterFile(const std::string              &file_name,
                               const std::vector<std::string> &overrides,
                               const MPI_Comm                  communicator)
    : ParameterFile(file_name,
                    read_by_first_rank(file_name, communicator),
                    overrides)
  {
    if (!is_run_record(file_name_))
      protect_input(file_name_);
    check();
  }



  ParameterFile::ParameterFile(const std::string              &file_name,
                               const std::string              &content,
                               const std::vector<std::string> &overrides)
    : file_name_(file_name)
    , content_(content)
    , overrides_(overrides)
  {}



  ParameterFile
  ParameterFile::from_text(const std::string              &text,
                           const std::vector<std::string> &overrides)
  {
    ParameterFile result("parameters given as text", text, overrides);
    result.check();
    return result;
  }



  void
  ParameterFile::check()
  {
    unsigned int n_includes = 1000;
    check(content_, {file_name_}, n_includes);
    for (const std::string &override_text : overrides_)
      for (const ParameterLine &line :
           parameter_lines(as_parameter_file(override_text)))
        check_line("--set " + override_text + ": ", line.text);
  }



  // deal.II reads included files as parts of the text, but would follow a
  // circle for ever. The number of inclusions is limited, as it doubles along a
  // chain of files that include the next file twice.
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
                            "', so the files include each other in a circle. "
                            "Remove one of the lines 'include'."));
        AssertThrow(n_left > 0,
                    ExcUser("The parameter file '" + chain.front() +
                            "' includes files more than 1000 times, directly "
                            "and through further files. Include fewer."));
        --n_left;
        protect_input(file);
        std::vector<std::string> longer = chain;
        longer.push_back(file);
        AssertThrow(longer.size() <= 20,
                    ExcUser("The parameter file '" + chain.front() +
                            "' includes files through more than 20 files, "
                            "down to '" +
                            file + "'. Include fewer."));
        check(read_parameter_file(file, Pipes::refused), longer, n_left);
      }
  }



  /// Overrides come after the file and take precedence, with the same language
  /// and checks. Errors name the option in place of a file.
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



  /// The existing parameters depend on the dimension, the names of bodies and
  /// materials, and the law of each material. Two passes that ignore all
  /// further entries read first the names, which give the sections of the laws,
  /// and then the laws. Afterwards all objects can declare their parameters,
  /// and parse() is strict.
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
    preview.folder      = std::filesystem::path(file_name_).parent_path();
    preview.dimension   = prm.get_integer("Dimension");
    preview.remarks     = remarks_;
    const auto names_in = [&prm](const std::string &section) {
      return names(prm.get({section}, "Names"), section + "/Names");
    };
    preview.bodies       = names_in("Bodies");
    preview.obstacles    = names_in("Obstacles");
    preview.surfaces     = names_in("Surfaces");
    const auto materials = names_in("Materials");
    prm.enter_subsection("Materials");
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
    for (const std::string &name : materials)
      preview.materials.push_back({name, prm.get({"Materials", name}, "Law")});
    return preview;
  }



  namespace
  {
    /// Far above all quantities in SI units, and products of a few numbers of
    /// this size do not overflow.
    constexpr double largest_number = 1e30;



    /// Throw ExcUser if a value, or a component of a list, is a number that is
    /// too large.
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
          // Allow "inf", which means no limit in some entries.
          const bool is_number =
            *end == '\0' && word.find_first_of("0123456789") != word.npos;
          AssertThrow(!is_number || std::abs(number) <= largest_number,
                      ExcUser(text("'",
                                   path,
                                   "' has '",
                                   word,
                                   "', larger than any quantity in SI units: "
                                   "at most ",
                                   largest_number,
                                   " was expected. Correct the value, or omit "
                                   "the entry for no limit.")));
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



    /// Return whether the value is a name or text, which may look like a
    /// number, for example the folder 57e1234.
    bool
    is_text(const std::string &entry)
    {
      static const std::set<std::string> texts = {
        "Title", "Folder", "File", "Names", "Material", "Surface", "Constants"};
      return texts.count(entry) > 0;
    }



    /// Check all entries in the form of a parameter file, as only there entries
    /// have their sections. Avoids std::regex, whose use of stack grows with
    /// the text.
    void
    check_sizes(const std::map<std::string, std::string> &values)
    {
      for (const auto &[path, value] : values)
        if (!is_text(path.substr(path.rfind('/') + 1)))
          check_size(path, value);
    }



    /// Throw ExcUser if there is no body or no material. Call after the strict
    /// pass, which reports misspelt sections.
    void
    check_has_names(const ParameterHandler &prm)
    {
      for (const std::string section : {"Bodies", "Materials"})
        AssertThrow(!prm.get({section}, "Names").empty(),
                    ExcUser("'" + section +
                            "/Names' is empty, but at least one name is "
                            "needed: the parameters are in a section with "
                            "this name."));
    }
  } // namespace



  /// An undeclared entry is an error here: most are misspelt. All parameters
  /// are declared by add_parameter(), which fills the members while parsing:
  /// ParameterAcceptor::parse_all_parameters() would also enter the sections of
  /// other runs in the process.
  std::vector<std::string>
  ParameterFile::parse() const
  {
    try
      {
        parse_into(ParameterAcceptor::prm, /*skip_undefined=*/false);
      }
    catch (const std::exception &exception)
      {
        // Reworded while the parameters with similar names are declared.
        AssertThrow(false, ExcUser(message(exception)));
      }
    check_has_names(ParameterAcceptor::prm);
    const auto values =
      values_by_path(parameters_as_text(ParameterAcceptor::prm));
    check_sizes(values);
    return unusual_values(values);
  }
} // namespace talus
