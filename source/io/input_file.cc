// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/input_file.h>

namespace talus
{
  // By value: the list may outlive this object.
  void
  InputFile::list_state(StateList &list) const
  {
    list.add_text(
      {"checksum of the " + name,
       [now = checksum]() { return now; },
       [file = *this](const std::string &saved) {
         AssertThrow(
           saved == file.checksum,
           ExcUser("The " + file.kind + " '" + file.path.string() +
                   "' differs from the file of the run to resume. Restore the "
                   "file, or start anew in another folder."));
       }});
  }
} // namespace talus
