// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/field_writer.h>
#include <talus/io/hdf5_writer.h>
#include <talus/io/vtu_writer.h>

namespace talus
{
  namespace
  {
    // Entry of the list of formats.
    struct Format
    {
      std::string name;
      std::string files; ///< description for the user
      std::unique_ptr<FieldWriter> (*make)();
    };



    /// Return the entry for a class of writers.
    template <typename Writer>
    Format
    format(const std::string &name)
    {
      return {name,
              Writer::documentation,
              []() -> std::unique_ptr<FieldWriter> {
                return std::make_unique<Writer>();
              }};
    }



    /// Return all formats. A new format is one line here; the parameter and the
    /// documentation follow.
    const std::vector<Format> &
    formats()
    {
      static const std::vector<Format> all = {
        format<VtuWriter>("vtu"),
        format<Hdf5Writer>("hdf5"),
      };
      return all;
    }



    /// Concatenate a text for each format, with separators.
    template <typename GetText>
    std::string
    joined(const std::string &separator, const GetText &text_of)
    {
      std::string result;
      for (const Format &format : formats())
        result += (result.empty() ? "" : separator) + text_of(format);
      return result;
    }
  } // namespace



  std::string
  field_format_names()
  {
    return joined("|", [](const Format &format) { return format.name; });
  }



  std::string
  field_format_documentation()
  {
    return joined("; or ", [](const Format &format) {
      return format.name + ", " + format.files;
    });
  }



  /// The parameter admits known names only; the check is for names from
  /// elsewhere.
  std::unique_ptr<FieldWriter>
  make_field_writer(const std::string &name)
  {
    for (const Format &format : formats())
      if (format.name == name)
        return format.make();
    AssertThrow(false,
                ExcUser(text("There is no output format `",
                             name,
                             "`. Set Output/Format to one of ",
                             field_format_names(),
                             ".")));
    return nullptr;
  }
} // namespace talus
