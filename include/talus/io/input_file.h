// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_input_file_h
#define talus_io_input_file_h

#include <talus/base/state_list.h>

#include <filesystem>
#include <string>

namespace talus
{
  /// Input file that affects the results, besides the parameters. The
  /// comparison of parameters sees only the path; therefore the checksum
  /// belongs to the state of the run.
  struct InputFile
  {
    std::string           name; ///< for messages, without slashes
    std::string           kind; ///< for messages: table, raster
    std::filesystem::path path;
    std::string           checksum; ///< checksum of the content as read

    /// Add the checksum to the state of the run. Loading throws ExcUser if the
    /// file differs from the file of the run to resume.
    void
    list_state(StateList &list) const;
  };
} // namespace talus

#endif
