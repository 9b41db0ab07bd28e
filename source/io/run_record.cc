#include <talus/base/errors.h>
#include <talus/io/files.h>
#include <talus/io/run_record.h>
#include <talus/version.h>

#include <deal.II/base/config.h>

#include <boost/version.hpp>

#include <hdf5.h>

#include <array>

namespace talus
{
  using namespace dealii;

  std::string
  versions(const std::string &prefix)
  {
    // The libraries' own numbers at compile time; HDF5's is asked for at run
    // time, as its library checks that the two agree.
    std::array<unsigned int, 3> hdf5;
    H5get_libversion(&hdf5[0], &hdf5[1], &hdf5[2]);
    const std::string revision = TALUS_GIT_REVISION;
    return text(prefix,
                "talus ",
                TALUS_VERSION,
                ", git revision ",
                revision.empty() ? "unknown" : revision,
                "\n",
                prefix,
                "deal.II ",
                DEAL_II_PACKAGE_VERSION,
                "\n",
                prefix,
                "Trilinos ",
                DEAL_II_TRILINOS_VERSION_MAJOR,
                ".",
                DEAL_II_TRILINOS_VERSION_MINOR,
                ".",
                DEAL_II_TRILINOS_VERSION_SUBMINOR,
                "\n",
                prefix,
                "p4est ",
                DEAL_II_P4EST_VERSION_MAJOR,
                ".",
                DEAL_II_P4EST_VERSION_MINOR,
                ".",
                DEAL_II_P4EST_VERSION_SUBMINOR,
                "\n",
                prefix,
                "HDF5 ",
                hdf5[0],
                ".",
                hdf5[1],
                ".",
                hdf5[2],
                "\n",
                prefix,
                "Boost ",
                BOOST_VERSION / 100000,
                ".",
                BOOST_VERSION / 100 % 1000,
                ".",
                BOOST_VERSION % 100,
                "\n");
  }



  std::string
  parameters_as_text(const ParameterHandler &parameters)
  {
    std::ostringstream out;
    parameters.print_parameters(out,
                                ParameterHandler::ShortPRM |
                                  ParameterHandler::KeepDeclarationOrder);
    return out.str();
  }



  void
  write_run_record(const std::filesystem::path &path,
                   const ParameterHandler      &parameters)
  {
    write_file(path, [&](std::ostream &out) {
      out << "# The parameters of this run as they were understood by\n"
          << versions("#   ") << '\n'
          << parameters_as_text(parameters);
    });
  }
} // namespace talus
