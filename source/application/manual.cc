// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/application/manual.h>
#include <talus/version.h>

#include <string>

namespace talus
{
  namespace po = boost::program_options;

  namespace
  {
    /// Escape a sentence for troff: a plain - would become a hyphen, which
    /// cannot be copied into a shell.
    std::string
    in_troff(const std::string &sentence)
    {
      std::string result;
      for (const char c : sentence)
        result += (c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string(1, c));
      return result;
    }



    bool
    takes_value(const po::option_description &option)
    {
      return option.semantic()->max_tokens() > 0;
    }
  } // namespace



  /// Generated with the package, so that the page lists the options of the
  /// program.
  void
  write_manual(std::ostream &out, const po::options_description &options)
  {
    out << ".TH TALUS 1 \"\" \"talus " TALUS_VERSION "\"\n"
        << ".SH NAME\ntalus \\- simulation of submarine landslides by the "
           "material point method\n"
        << ".SH SYNOPSIS\n.B talus\n[\\fIoptions\\fR] \\fIFILE.prm\\fR\n.PP\n"
        << ".B mpirun \\-np\n\\fIN\\fR\n.B talus\n[\\fIoptions\\fR] "
           "\\fIFILE.prm\\fR\n"
        << ".SH DESCRIPTION\n"
        << "Runs the simulation described by the parameter file, and writes "
           "fields for ParaView and tables of global quantities into one "
           "folder.\n"
        << ".SH OPTIONS\n";
    for (const auto &option : options.options())
      out << ".TP\n\\fB\\-\\-" << in_troff(option->long_name()) << "\\fR"
          << (takes_value(*option) ? " \\fIvalue\\fR" : "") << '\n'
          << in_troff(option->description()) << ".\n";
    out << ".SH EXIT STATUS\n"
        << ".TP\n.B 0\nThe end time was reached, or the requested task is "
           "done.\n"
        << ".TP\n.B 1\nAn error occurred; the message is on standard error.\n"
        << ".TP\n.B 75\nThe run was stopped by a signal or its limit of time; "
           "\\fB\\-\\-resume\\fR continues the run.\n"
        << ".SH FILES\n.TP\n.I /usr/share/talus/prm\n"
           "Parameter files to begin with, if talus was installed by its "
           "package.\n"
        << ".SH EXAMPLES\n.EX\n"
        << "talus /usr/share/talus/prm/landslide\\-quick.prm "
           "\\-\\-output slide\n"
        << "talus slope.prm \\-\\-set \"Grid/Cell size=0.2\"\n.EE\n";
  }



  /// A folder completes options with a value; a parameter file completes
  /// arguments that are not options.
  void
  write_completion(std::ostream &out, const po::options_description &options)
  {
    std::string all, with_value;
    for (const auto &option : options.options())
      {
        const std::string name = "--" + option->long_name();
        all += (all.empty() ? "" : " ") + name;
        if (takes_value(*option))
          with_value += (with_value.empty() ? "" : "|") + name;
      }
    out << "# Completion of talus for bash.\n"
        << "_talus()\n{\n"
        << "  local word=${COMP_WORDS[COMP_CWORD]}\n"
        << "  case ${COMP_WORDS[COMP_CWORD-1]} in\n"
        << "    " << with_value
        << ")\n      mapfile -t COMPREPLY < <(compgen -d -- \"$word\")\n"
        << "      return ;;\n  esac\n"
        << "  if [[ $word == -* ]]; then\n"
        << "    mapfile -t COMPREPLY < <(compgen -W '" << all
        << "' -- \"$word\")\n  else\n"
        << "    mapfile -t COMPREPLY < <(compgen -f -X '!*.prm' -- \"$word\"; "
           "compgen -d -- \"$word\")\n"
        << "  fi\n}\n"
        << "complete -o filenames -F _talus talus\n";
  }
} // namespace talus
