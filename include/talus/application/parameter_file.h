// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_application_parameter_file_h
#define talus_application_parameter_file_h

#include <talus/problem/parameter_preview.h>

#include <deal.II/base/parameter_handler.h>

#include <mpi.h>

#include <string>
#include <vector>

namespace talus
{
  /// Parameter file, which may include more files by lines `include FILE`, with
  /// the overrides of the command line. The file is read once, so it may be a
  /// pipe.
  ///
  /// deal.II's parameters are global: the handler ParameterAcceptor::prm refers
  /// to the members of all objects made since it was cleared. Several runs can
  /// exist in a process because the handler is cleared before and after the
  /// objects of each run are made and parse() has filled them, see Run.
  class ParameterFile
  {
  public:
    /// Read the file on the first rank of @p communicator. @p overrides have
    /// the form "Section/Subsection/Entry=value". Throws ExcUser if a file
    /// cannot be read or has a line that check_lines() refuses, if files
    /// include each other in a circle, or if an override is malformed.
    /// Collective.
    ParameterFile(const std::string              &file_name,
                  const std::vector<std::string> &overrides,
                  MPI_Comm                        communicator);

    /// Take the content of a parameter file from @p text. Files that the
    /// parameters name are relative to the current folder. Throws as the
    /// constructor.
    static ParameterFile
    from_text(const std::string              &text,
              const std::vector<std::string> &overrides);

    /// First, tolerant pass: read only the parameters that determine which
    /// parameters exist.
    ParameterPreview
    preview() const;

    /// Second, strict pass: fill all objects that accept parameters. Throws,
    /// naming file and line, at the first entry that is unknown or out of
    /// range. Returns remarks on values far from usual ones.
    std::vector<std::string>
    parse() const;

  private:
    ParameterFile(const std::string              &file_name,
                  const std::string              &content,
                  const std::vector<std::string> &overrides);

    /// Check all lines and overrides.
    void
    check();

    /// Check the lines of a file and of all included files, which become
    /// protected inputs.
    /// @param content Text of the file.
    /// @param chain Names of the files whose lines `include` led to the file,
    ///   ending with the file itself.
    /// @param n_left Number of files that may still be included; decreased.
    void
    check(const std::string              &content,
          const std::vector<std::string> &chain,
          unsigned int                   &n_left);
    void
    parse_into(dealii::ParameterHandler &prm, bool skip_undefined) const;

    std::string              file_name_;
    std::string              content_;
    std::vector<std::string> overrides_;
    std::vector<std::string> remarks_; ///< on entries set twice in a file
  };
} // namespace talus

#endif
