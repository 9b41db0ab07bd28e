#ifndef talus_io_hdf5_tables_h
#define talus_io_hdf5_tables_h

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace talus
{
  /// What there is to know of a dataset without reading it.
  struct Hdf5Table
  {
    std::string                        path; ///< in the file, from the root
    std::uint64_t                      n_rows;
    std::uint64_t                      n_columns;
    std::map<std::string, std::string> attributes;
  };



  /// The datasets in the group @p group of the file @p path, by name; for one
  /// rank. Throws ExcUser if they cannot be read.
  std::vector<Hdf5Table>
  list_tables(const std::filesystem::path &path, const std::string &group);
} // namespace talus

#endif
