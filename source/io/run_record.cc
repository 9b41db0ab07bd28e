// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/checksum.h>
#include <talus/io/files.h>
#include <talus/io/run_record.h>
#include <talus/version.h>

#include <deal.II/base/config.h>

#include <boost/version.hpp>

#include <hdf5.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// First line of older records, without a checksum.
    const std::string old_first_line =
      "# The parameters of this run as they were understood by";

    const std::string first_line =
      "# The parameters of this run (with a checksum, last line) as they were "
      "understood by";



    /// Beginning of the last line of a record; the checksum behind it detects
    /// changes by the user.
    const std::string last_line = "# CRC-32 of all before this line: ";
  } // namespace



  /// A line per library that can affect the results; @p prefix makes each line
  /// a comment of a parameter file.
  std::string
  versions(const std::string &prefix)
  {
    // Versions at compile time. The version of HDF5 is asked for at run time,
    // because the library itself checks the agreement of both.
    unsigned int hdf5[3];
    H5get_libversion(&hdf5[0], &hdf5[1], &hdf5[2]);
    const auto line = [&prefix](const auto &...words) {
      return text(prefix, words..., '\n');
    };
    const auto dotted = [](const auto a, const auto b, const auto c) {
      return text(a, '.', b, '.', c);
    };
    return line("talus ",
                TALUS_VERSION,
                ", git revision ",
                TALUS_GIT_REVISION) +
           line("deal.II ", DEAL_II_PACKAGE_VERSION) +
           line("Trilinos ",
                dotted(DEAL_II_TRILINOS_VERSION_MAJOR,
                       DEAL_II_TRILINOS_VERSION_MINOR,
                       DEAL_II_TRILINOS_VERSION_SUBMINOR)) +
           line("p4est ",
                dotted(DEAL_II_P4EST_VERSION_MAJOR,
                       DEAL_II_P4EST_VERSION_MINOR,
                       DEAL_II_P4EST_VERSION_SUBMINOR)) +
           line("HDF5 ", dotted(hdf5[0], hdf5[1], hdf5[2])) +
           line("Boost ",
                dotted(BOOST_VERSION / 100000,
                       BOOST_VERSION / 100 % 1000,
                       BOOST_VERSION % 100));
  }



  /// In the order of the declarations and with defaults: the text can be run
  /// again and compared line by line.
  std::string
  parameters_as_text(const ParameterHandler &parameters)
  {
    std::ostringstream out;
    parameters.print_parameters(out,
                                ParameterHandler::ShortPRM |
                                  ParameterHandler::KeepDeclarationOrder);
    return out.str();
  }



  /// Without date and host: runs with the same parameters have the same file.
  void
  write_run_record(const std::filesystem::path &path,
                   const std::string           &parameters)
  {
    const std::string record =
      text(first_line, '\n', versions("#   "), '\n', parameters);
    write_file(path, [&](std::ostream &out) {
      out << record << last_line << checksum(record) << '\n';
    });
  }



  // A changed record belongs to the user. Pipes are excluded: the content can
  // be read only once.
  bool
  is_run_record(const std::filesystem::path &path)
  {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
      return false;
    std::ifstream      file(path);
    std::ostringstream content;
    content << file.rdbuf();
    const std::string record      = content.str();
    const auto        begins_with = [&](const std::string &line) {
      return record.compare(0, line.size() + 1, line + '\n') == 0;
    };
    const std::size_t last = record.rfind(last_line);
    return begins_with(old_first_line) ||
           (begins_with(first_line) && last != record.npos &&
            record.substr(last) ==
              text(last_line, checksum(record.substr(0, last)), '\n'));
  }
} // namespace talus
