// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_application_parameter_file_h
#define talus_application_parameter_file_h

#include <talus/problem/parameter_preview.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace talus
{
  /// A parameter file, which may include others by lines `include FILE`, and
  /// what the command line sets on top of it. It is read once, so that it may be
  /// a pipe.
  class ParameterFile
  {
  public:
    /// @p overrides: "Section/Subsection/Entry=value" each. Throws ExcUser if
    /// the file, or one that it includes, cannot be read or has a line that
    /// check_lines() refuses, if files include each other in a circle, or if an
    /// override has another form.
    ParameterFile(const std::string              &file_name,
                  const std::vector<std::string> &overrides);

    /// First, tolerant pass: only what decides which parameters there are.
    ParameterPreview
    preview() const;

    /// Second, strict pass into all objects that accept parameters. Throws,
    /// naming file and line, at the first entry that is unknown or out of range.
    void
    parse() const;

  private:
    /// Check the lines of a file with this content, and those of the files that
    /// it includes, which become protected inputs. @p chain: the file itself,
    /// last, and the files whose lines `include` have led to it; @p n_left: how
    /// many more may be included in all.
    void
    check(const std::string              &content,
          const std::vector<std::string> &chain,
          unsigned int                   &n_left);
    void
    parse_into(dealii::ParameterHandler &prm, bool skip_undefined) const;

    std::string              file_name_;
    std::string              content_;
    std::vector<std::string> overrides_;
    std::vector<std::string> remarks_; ///< on what the files say twice
  };
} // namespace talus

#endif
