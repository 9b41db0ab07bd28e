// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_input_file_h
#define talus_io_input_file_h

#include <talus/base/state_list.h>

#include <filesystem>
#include <string>

namespace talus
{
  /// A file beside the parameters that the results depend on. The comparison of
  /// parameters sees its path alone, so its checksum is state of the run.
  struct InputFile
  {
    std::string           name; ///< of what is read from it, without slashes
    std::string           kind; ///< for messages: table, raster
    std::filesystem::path path;
    std::string           checksum; ///< of what was read

    /// Loading throws ExcUser if the file is not the one of the run to resume.
    void
    list_state(StateList &list) const;
  };
} // namespace talus

#endif
