#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/io/checksum.h>
#include <talus/io/hdf5_file.h>
#include <talus/io/hdf5_handle.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    using Handle = Hdf5Handle;

    /// Nor may the library print anything when it ends: what it could not read
    /// of a damaged file it cannot close either.
    Hdf5Errors
    silent_errors()
    {
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
      return Hdf5Errors();
    }



    Handle
    group_properties()
    {
      Handle properties = undated(H5P_GROUP_CREATE);
      // Names stay in the header, which has a checksum. The other storage, for
      // many names, has one too, but HDF5 1.10 crashes where it is wrong.
      H5Pset_link_phase_change(properties, 60000, 50000);
      return properties;
    }



    /// Write or read (@p transfer is H5Dwrite or H5Dread) the rows
    /// [first, first + n_rows) of a data set. Returns whether that worked.
    template <typename Transfer, typename Rows>
    bool
    transfer_rows(const Transfer transfer,
                  const hid_t    dataset,
                  const hsize_t  first,
                  const hsize_t  n_rows,
                  const hsize_t  n_columns,
                  Rows          *rows)
    {
      const hsize_t start[2] = {first, 0}, count[2] = {n_rows, n_columns};
      const int     rank = (n_columns == 1 ? 1 : 2);
      const Handle  file_space(H5Dget_space(dataset), H5Sclose);
      const Handle  memory_space(H5Screate_simple(rank, count, nullptr),
                                H5Sclose);
      const Handle  together(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
      H5Pset_dxpl_mpio(together, H5FD_MPIO_COLLECTIVE);
      const herr_t selected =
        (n_rows == 0
           ? H5Sselect_none(memory_space) + H5Sselect_none(file_space)
           : H5Sselect_hyperslab(
               file_space, H5S_SELECT_SET, start, nullptr, count, nullptr));
      // Even if that failed: the others are in this call, too.
      const herr_t status = transfer(
        dataset, H5T_NATIVE_DOUBLE, memory_space, file_space, together, rows);
      return selected >= 0 && status >= 0;
    }
  } // namespace



  Hdf5File::Hdf5File(const std::filesystem::path &path,
                     const Access                 access,
                     const MPI_Comm               communicator)
    : path_(path)
    , communicator_(communicator)
    , errors_(silent_errors())
  {
    const Handle properties(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_mpio(properties, communicator_, MPI_INFO_NULL);
    H5Pset_all_coll_metadata_ops(properties, true);
    H5Pset_coll_metadata_write(properties, true);
    // From this version on the metadata have checksums.
    H5Pset_libver_bounds(properties, H5F_LIBVER_V18, H5F_LIBVER_LATEST);
    if (access == Access::create)
      file_ = H5Fcreate(path_.c_str(),
                        H5F_ACC_TRUNC,
                        undated(H5P_FILE_CREATE),
                        properties);
    else
      file_ = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, properties);
    conclude(file_ >= 0, "it could not be opened");
  }



  Hdf5File::~Hdf5File()
  {
    if (file_ >= 0)
      H5Fclose(file_);
  }



  void
  Hdf5File::remember(const bool success, const std::string &failure)
  {
    if (!success && own_complaint_.empty())
      own_complaint_ = failure + " (HDF5: " + errors_.reason() + ")";
  }



  bool
  Hdf5File::conclude(const bool success, const std::string &failure)
  {
    remember(success, failure);
    error_ = first_sentence(own_complaint_, communicator_);
    return error_.empty();
  }



  void
  Hdf5File::close()
  {
    if (!error_.empty())
      return;
    bool success = (H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0);
    success      = (H5Fclose(file_) >= 0) && success;
    file_        = -1;
    conclude(success, "it could not be completed");
  }



  void
  Hdf5File::create_group(const std::string &name)
  {
    if (!error_.empty())
      return;
    const Handle group(H5Gcreate2(file_,
                                  name.c_str(),
                                  H5P_DEFAULT,
                                  group_properties(),
                                  H5P_DEFAULT),
                       H5Gclose);
    conclude(group >= 0, "the group '" + name + "' could not be made");
  }



  std::vector<std::string>
  Hdf5File::names(const std::string &group)
  {
    std::vector<std::string> result;
    if (!error_.empty())
      return result;
    const auto add =
      [](hid_t, const char *name, const H5L_info_t *, void *data) -> herr_t {
      static_cast<std::vector<std::string> *>(data)->push_back(name);
      return 0;
    };
    const Handle opened(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
    const bool   success =
      opened >= 0 &&
      H5Literate(opened, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &result) >=
        0;
    conclude(success, "the group '" + group + "' could not be read");
    return result;
  }



  std::pair<std::uint64_t, std::uint64_t>
  Hdf5File::first_and_total(const std::uint64_t n_rows) const
  {
    std::uint64_t end = 0;
    const int     status =
      MPI_Scan(&n_rows, &end, 1, MPI_UINT64_T, MPI_SUM, communicator_);
    AssertThrowMPI(status);
    return {end - n_rows, Utilities::MPI::sum(n_rows, communicator_)};
  }



  void
  Hdf5File::write(const std::string         &name,
                  const std::vector<double> &rows,
                  const unsigned int         n_columns)
  {
    if (!error_.empty())
      return;
    const std::uint64_t n_rows = rows.size() / n_columns;
    const auto [first, total]  = first_and_total(n_rows);
    const hsize_t extent[2]    = {total, n_columns};
    const Handle  space(
      H5Screate_simple(n_columns == 1 ? 1 : 2, extent, nullptr), H5Sclose);
    const Handle dataset(H5Dcreate2(file_,
                                    name.c_str(),
                                    H5T_IEEE_F64LE,
                                    space,
                                    H5P_DEFAULT,
                                    undated(H5P_DATASET_CREATE),
                                    H5P_DEFAULT),
                         H5Dclose);
    const bool   success =
      dataset >= 0 &&
      (total == 0 ||
       transfer_rows(H5Dwrite, dataset, first, n_rows, n_columns, rows.data()));
    conclude(success, "the array '" + name + "' could not be written");
    const std::uint64_t own = checksum(rows, first * n_columns);
    set_attribute(name, "checksum", Utilities::MPI::sum(own, communicator_));
  }



  std::pair<std::uint64_t, unsigned int>
  Hdf5File::shape(const std::string &name)
  {
    if (!error_.empty())
      return {0, 0};
    hsize_t      extent[2] = {0, 1};
    const Handle dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle space(H5Dget_space(dataset), H5Sclose);
    const int    rank = H5Sget_simple_extent_ndims(space);
    const bool   success =
      (rank == 1 || rank == 2) &&
      H5Sget_simple_extent_dims(space, extent, nullptr) == rank;
    if (!conclude(success, "it has no array '" + name + "'"))
      return {0, 0};
    return {extent[0], static_cast<unsigned int>(extent[1])};
  }



  std::vector<double>
  Hdf5File::read(const std::string  &name,
                 const std::uint64_t first,
                 const std::uint64_t n_rows)
  {
    const auto [total, n_columns] = shape(name);
    if (!error_.empty())
      return {};
    std::vector<double> rows(n_rows * n_columns);
    const Handle dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    const bool   success =
      dataset >= 0 &&
      (total == 0 ||
       transfer_rows(H5Dread, dataset, first, n_rows, n_columns, rows.data()));
    conclude(success, "the array '" + name + "' could not be read");
    return rows;
  }



  void
  Hdf5File::write_known(const std::string         &name,
                        const std::vector<double> &values)
  {
    if (!error_.empty())
      return;
    const hsize_t extent = values.size();
    const Handle  space(H5Screate_simple(1, &extent, nullptr), H5Sclose);
    write_by_first_rank(
      name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space, values.data());
    set_attribute(name, "checksum", checksum(values, 0));
  }



  void
  Hdf5File::write_text(const std::string &name, const std::string &text)
  {
    if (!error_.empty())
      return;
    const std::string same = Utilities::MPI::broadcast(communicator_, text);
    const Handle      type = text_type(same);
    const Handle      space(H5Screate(H5S_SCALAR), H5Sclose);
    write_by_first_rank(name, type, type, space, same.c_str());
    set_attribute(name, "checksum", checksum(same));
  }



  void
  Hdf5File::write_by_first_rank(const std::string &name,
                                const hid_t        file_type,
                                const hid_t        type,
                                const hid_t        space,
                                const void        *values)
  {
    const Handle dataset(H5Dcreate2(file_,
                                    name.c_str(),
                                    file_type,
                                    space,
                                    H5P_DEFAULT,
                                    undated(H5P_DATASET_CREATE),
                                    H5P_DEFAULT),
                         H5Dclose);
    const bool   success =
      dataset >= 0 &&
      (!is_first_rank(communicator_) ||
       H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
    remember(success, "'" + name + "' could not be written");
  }



  std::string
  Hdf5File::read_text(const std::string &name)
  {
    if (!error_.empty())
      return "";
    const Handle dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle type(H5Dget_type(dataset), H5Tclose);
    std::string  text(H5Tget_size(type), '\0');
    const bool   success =
      H5Tget_class(type) == H5T_STRING &&
      H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) >= 0;
    conclude(success, "it has no text '" + name + "'");
    return text.substr(0, text.find('\0'));
  }
} // namespace talus
