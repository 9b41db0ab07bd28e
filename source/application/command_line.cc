// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/application/command_line.h>
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/base/processor.h>
#include <talus/simulation/simulation.h>
#include <talus/version.h>

#include <deal.II/base/config.h>
#include <deal.II/base/utilities.h>

#include <boost/program_options.hpp>

#include <iostream>
#include <set>
#include <sstream>

namespace talus
{
  namespace po = boost::program_options;

  namespace
  {
    /// Options shown by `--help`; parsed values are stored in @p result. The
    /// parameter file is positional and not included.
    po::options_description
    visible_options(CommandLine &result)
    {
      po::options_description options("Options");
      // clang-format off
      options.add_options()
        ("set", po::value(&result.overrides),
         "set a parameter in place of the file: "
         "--set \"Section/Subsection/Entry=value\"; may be repeated")
        ("output", po::value(&result.output_folder),
         "folder for the results, in place of Output/Folder")
        ("resume", po::bool_switch(&result.resume),
         "continue from the newest checkpoint in the output folder; give the "
         "same file and options as before")
        ("overwrite", po::bool_switch(&result.overwrite),
         "start from the beginning even if the output folder holds the "
         "checkpoint of an unfinished run")
        ("validate", po::bool_switch(&result.validate),
         "read and check everything, make mesh and points, and describe the "
         "run: size, time steps, estimated time, and all remarks")
        ("document", po::bool_switch(&result.document),
         "print the reference of all parameters")
        ("version", "print the version")
        ("help", "print this help");
      // clang-format on
      return options;
    }
  } // namespace



  /// All ranks parse, so that all ranks know the options; only the first rank
  /// prints.
  std::optional<CommandLine>
  parse_command_line(const int argc, const char *const *argv)
  {
    CommandLine             result;
    po::options_description visible = visible_options(result);
    po::options_description all;
    all.add(visible).add_options()("file", po::value(&result.parameter_file));
    po::positional_options_description positional;
    positional.add("file", 1);

    po::variables_map variables;
    po::store(po::command_line_parser(argc, argv)
                .options(all)
                .positional(positional)
                .run(),
              variables);
    po::notify(variables);

    // A stream without buffer discards its input.
    std::ostream  nowhere(nullptr);
    std::ostream &out = is_first_rank(MPI_COMM_WORLD) ? std::cout : nowhere;
    if (variables.count("help"))
      {
        out << "talus: submarine landslides by the material point "
               "method\n\nUsage: talus [options] FILE.prm\n\n"
            << visible;
        return {};
      }
    if (variables.count("version"))
      {
        out << "talus " << TALUS_VERSION << " (git revision "
            << TALUS_GIT_REVISION << "), deal.II " << DEAL_II_PACKAGE_VERSION
            << ", kernels for " << processor() << std::endl;
        return {};
      }
    AssertThrow(result.document || !result.parameter_file.empty(),
                ExcUser("No parameter file was given. Usage: talus [options] "
                        "FILE.prm; see talus --help."));
    AssertThrow(!(result.resume && result.overwrite),
                ExcUser("--resume and --overwrite were given, but a run can "
                        "only continue or start again. Give one of the two."));
    return result;
  }



  namespace
  {
    /// Parameters that nearly every case sets. `*` is the name of a body or of
    /// a material.
    const std::set<std::string> first_parameters = {
      "Bodies/*/Material",
      "Bodies/*/Shape",
      "Bodies/*/Vertices",
      "Bodies/Names",
      "Boundaries/Bottom",
      "Boundaries/Seabed/Friction coefficient",
      "Boundaries/Seabed/Maximum shear stress",
      "End time",
      "Gravity/Magnitude",
      "Gravity/Slope angle",
      "Grid/Cell size",
      "Grid/Lower corner",
      "Grid/Upper corner",
      "Materials/*/Density",
      "Materials/*/Law",
      "Materials/*/Poisson's ratio",
      "Materials/*/Undrained shear strength",
      "Materials/*/Young's modulus",
      "Materials/Names",
      "Output/Folder"};



    /// Copy a listing of parameters from @p in to @p out, with a mark above
    /// each of the first parameters.
    void
    mark_first_parameters(std::istream &in, std::ostream &out)
    {
      std::vector<std::string> sections;
      for (std::string line; std::getline(in, line); out << line << '\n')
        {
          const std::string words = dealii::Utilities::trim(line);
          if (words == "end")
            sections.pop_back();
          else if (words.rfind("subsection ", 0) == 0)
            sections.push_back(
              sections.size() == 1 &&
                  (sections[0] == "Bodies" || sections[0] == "Materials")
                ? "*"
                : words.substr(11));
          else if (words.rfind("set ", 0) == 0)
            {
              std::string name;
              for (const std::string &section : sections)
                name += section + '/';
              name +=
                dealii::Utilities::trim(words.substr(4, words.find('=') - 4));
              if (first_parameters.count(name) > 0)
                out << std::string(line.find("set "), ' ')
                    << "# * One of the twenty parameters to set first.\n";
            }
        }
    }
  } // namespace



  /// The parameters depend on the names of bodies and materials and on the
  /// laws, so the reference describes an example with all laws. The example is
  /// 2-D; parameters in 3-D have the same names.
  void
  document(std::ostream &out)
  {
    // The example has a body, an obstacle and so on, and for each law a
    // material with the name of the law.
    ParameterPreview preview;
    preview.bodies    = {"slide"};
    preview.obstacles = {"bed"};
    preview.surfaces  = {"mudline"};
    for (const std::string &law : material_names<2>())
      preview.materials.push_back({law, law});
    Simulation<2> simulation(preview, MPI_COMM_SELF);
    dealii::ParameterAcceptor::declare_all_parameters();
    std::stringstream listing;
    dealii::ParameterAcceptor::prm.print_parameters(
      listing, dealii::ParameterHandler::Text);
    mark_first_parameters(listing, out);
  }
} // namespace talus
