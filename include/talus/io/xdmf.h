#ifndef talus_io_xdmf_h
#define talus_io_xdmf_h

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace talus
{
  /// An XDMF file: tells ParaView the times of a sequence of HDF5 files that
  /// write_hdf5() made, and what is where in them.
  ///
  /// It is made from the files alone, so it does not matter whether they were
  /// written by this run or by one that this run resumes.
  class XdmfIndex
  {
  public:
    /// Write the index @p path of the files with these times, s, and names, all
    /// in one folder. Files that are no longer there are left out. For one
    /// rank. Throws ExcUser if a file cannot be read or the index not written.
    void
    write(const std::filesystem::path                       &path,
          const std::vector<std::pair<double, std::string>> &times_and_names);

  private:
    /// What the index says of a file, by name: files are read once.
    std::map<std::string, std::string> grids_;
  };
} // namespace talus

#endif
