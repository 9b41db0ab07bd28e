// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/io/checksum.h>
#include <talus/io/disk_space.h>
#include <talus/io/files.h>
#include <talus/io/hdf5_checks.h>
#include <talus/io/hdf5_file.h>

#include <algorithm>
#include <type_traits>

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



    /// So that no reader finds a file under its name that is not complete.
    std::filesystem::path
    path_while_written(std::filesystem::path path, const bool is_atomic)
    {
      if (is_atomic)
        path += ".part";
      return path;
    }



    /// How the ranks open a file.
    Handle
    access_properties(const MPI_Comm communicator)
    {
      Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
      H5Pset_fapl_mpio(access, communicator, MPI_INFO_NULL);
      // Metadata are read by one rank and broadcast, and written together: else
      // each rank would ask the file system for each group and attribute.
      H5Pset_all_coll_metadata_ops(access, true);
      H5Pset_coll_metadata_write(access, true);
      // From this version on the metadata have checksums.
      H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST);
      return access;
    }



    /// With what the library adds to an array for itself: the list of chunks,
    /// attributes; and a little if the data cannot be compressed.
    std::uint64_t
    with_overhead(const std::uint64_t n_bytes)
    {
      return n_bytes + n_bytes / 50 + (1 << 14);
    }

    /// What it adds to something short.
    constexpr std::uint64_t small_overhead = 1 << 12;

    constexpr unsigned int largest_n_columns = 1 << 16;



    /// Types in memory and, the same on all machines, in the file.
    std::pair<hid_t, hid_t>
    types_of(double)
    {
      return {H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE};
    }

    std::pair<hid_t, hid_t>
    types_of(float)
    {
      return {H5T_NATIVE_FLOAT, H5T_IEEE_F32LE};
    }

    std::pair<hid_t, hid_t>
    types_of(std::int64_t)
    {
      return {H5T_NATIVE_INT64, H5T_STD_I64LE};
    }



    /// Write or read (@p transfer is H5Dwrite or H5Dread) the rows
    /// [first, first + n_rows) of an array. Returns whether that worked.
    template <typename Transfer, typename Values>
    bool
    transfer_rows(const Transfer transfer,
                  const hid_t    array,
                  const hid_t    type,
                  const hsize_t  first,
                  const hsize_t  n_rows,
                  const hsize_t  n_columns,
                  Values        *values)
    {
      const hsize_t start[2] = {first, 0}, count[2] = {n_rows, n_columns};
      const int     rank = (n_columns == 1 ? 1 : 2);
      const Handle  file_space(H5Dget_space(array), H5Sclose);
      if (H5Sget_simple_extent_npoints(file_space) == 0)
        return true;
      const Handle memory_space(H5Screate_simple(rank, count, nullptr),
                                H5Sclose);
      const Handle together(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
      H5Pset_dxpl_mpio(together, H5FD_MPIO_COLLECTIVE);
      // A rank without rows takes part with an empty selection: the call is
      // collective.
      const herr_t selected =
        (n_rows == 0
           ? H5Sselect_none(memory_space) + H5Sselect_none(file_space)
           : H5Sselect_hyperslab(
               file_space, H5S_SELECT_SET, start, nullptr, count, nullptr));
      // Even if that failed: the others are in this call, too.
      const herr_t status =
        transfer(array, type, memory_space, file_space, together, values);
      return selected >= 0 && status >= 0;
    }



    /// Not valid if there is no such array; the same of open_attribute().
    Handle
    open_array(const hid_t file, const std::string &name)
    {
      return {H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose};
    }



    Handle
    open_attribute(const hid_t        file,
                   const std::string &object,
                   const std::string &name)
    {
      return {H5Aopen_by_name(
                file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
              H5Aclose};
    }



    std::string
    is_missing(const std::string &object, const std::string &name)
    {
      return "'" + object + "' has no attribute '" + name + "'";
    }
  } // namespace



  // ------------------------------------------------------- opening and closing

  Hdf5File::Hdf5File(const std::filesystem::path &path,
                     const Access                 access,
                     const MPI_Comm               communicator,
                     const Hdf5Options           &options)
    : path_(path)
    , is_new_(access == Access::create)
    , part_(path_while_written(path, is_new_ && options.is_atomic))
    , communicator_(communicator)
    , is_first_rank_(is_first_rank(communicator))
    , options_(options)
    , errors_(silent_errors())
  {
    if (is_new_)
      {
        create();
        return;
      }
    file_ = Handle(H5Fopen(path_.c_str(),
                           H5F_ACC_RDONLY,
                           access_properties(communicator_)),
                   H5Fclose);
    check_on_all_ranks(file_.is_valid(), "it could not be opened");
  }



  Hdf5File::~Hdf5File()
  {
    file_.close();
    std::error_code ignored;
    if (is_first_rank_ && part_ != path_)
      std::filesystem::remove(part_, ignored);
  }



  /// The file must exist before its space can be reserved, and H5Fcreate() may
  /// be the first to fill the disk; so space for an empty file is reserved
  /// before. If that fails the library never sees the file.
  void
  Hdf5File::create()
  {
    reserve(with_overhead(0));
    if (!error_.empty())
      return;
    file_ = Handle(H5Fcreate(part_.c_str(),
                             H5F_ACC_TRUNC,
                             undated(H5P_FILE_CREATE),
                             access_properties(communicator_)),
                   H5Fclose);
    check_on_all_ranks(file_.is_valid(), "it could not be made");
    // Again: the library has emptied the file.
    n_reserved_ = 0;
    reserve(0);
  }



  /// In this order: all data to the operating system; the file closed on all
  /// ranks; what was reserved and not used given back; content to the disk; and
  /// only then the name. If the machine dies in between, the older file of that
  /// name is whole. After each step that one rank does alone all of them agree
  /// whether to go on.
  void
  Hdf5File::close()
  {
    if (!error_.empty())
      return;
    // Flushed first, so that a full disk shows before the file is closed.
    bool success = (H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0);
    success      = file_.close() && success;
    if (!check_on_all_ranks(success, "it could not be completed") || !is_new_)
      return;
    if (is_first_rank_)
      {
        Assert(std::filesystem::file_size(part_) <= n_bytes_,
               ExcMessage("More was written than reserved."));
        own_error_ = release_disk_space(part_);
        if (own_error_.empty() && part_ != path_)
          own_error_ = sync_to_disk(part_);
      }
    if (!check_on_all_ranks() || part_ == path_)
      return;
    std::error_code error;
    if (is_first_rank_)
      std::filesystem::rename(part_, path_, error);
    own_error_ = (error ? error.message() : "");
    check_on_all_ranks();
  }



  // ----------------------------------------------------------------- failures

  /// The first failure stays: what follows mostly comes of it.
  void
  Hdf5File::note_error(const bool success, const std::string &failure)
  {
    if (!success && own_error_.empty())
      own_error_ = failure + " (HDF5: " + errors_.reason() + ")";
  }



  bool
  Hdf5File::check_on_all_ranks()
  {
    error_ = first_sentence(own_error_, communicator_);
    return error_.empty();
  }



  bool
  Hdf5File::check_on_all_ranks(const bool success, const std::string &failure)
  {
    note_error(success, failure);
    return check_on_all_ranks();
  }



  /// n_bytes_ is the size of the file at most, as all ranks count it alike, so
  /// they agree without a message whether more must be reserved. The first rank
  /// does it.
  void
  Hdf5File::reserve(const std::uint64_t n_bytes)
  {
    n_bytes_ += n_bytes;
    if (!error_.empty() || n_bytes_ <= n_reserved_)
      return;
    // A little more: many arrays are short.
    n_reserved_ = n_bytes_ + (1 << 16);
    if (is_first_rank_ && own_error_.empty())
      own_error_ = reserve_disk_space(part_, n_reserved_);
    check_on_all_ranks();
  }



  // ----------------------------------------------------- groups and attributes

  void
  Hdf5File::create_group(const std::string &name)
  {
    reserve(small_overhead);
    if (!error_.empty())
      return;
    const Handle properties = undated(H5P_GROUP_CREATE);
    // Names stay in the header, which has a checksum. The other storage, for
    // many names, has one too, but HDF5 1.10 crashes where it is wrong.
    H5Pset_link_phase_change(properties, 60000, 50000);
    const Handle group(
      H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT),
      H5Gclose);
    check_on_all_ranks(group.is_valid(),
                       "the group '" + name + "' could not be made");
  }



  /// From an index by name, so that the order is that of the names and the same
  /// for files that were written in another order.
  std::vector<std::string>
  Hdf5File::names(const std::string &group)
  {
    std::vector<std::string> result;
    if (!error_.empty())
      return result;
    const auto add = [](hid_t,
                        const char       *name,
                        const H5L_info_t *info,
                        void             *data) -> herr_t {
      static_cast<std::vector<std::string> *>(data)->push_back(name);
      // A link may lead out of the file, or to where it came from.
      return info->type == H5L_TYPE_HARD ? 0 : -1;
    };
    const Handle opened(H5Gopen2(file_, group.c_str(), H5P_DEFAULT), H5Gclose);
    const bool   success =
      opened.is_valid() &&
      H5Literate(opened, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &result) >=
        0;
    check_on_all_ranks(success, "the group '" + group + "' could not be read");
    return result;
  }



  /// All ranks give the same value, as collective metadata demand. A failure is
  /// noted, and told with the next agreement: no rank waits for this one.
  void
  Hdf5File::write_attribute(const std::string &object,
                            const std::string &name,
                            const hid_t        memory_type,
                            const hid_t        file_type,
                            const void        *value)
  {
    reserve(256 + name.size() + H5Tget_size(file_type));
    if (!error_.empty())
      return;
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate_by_name(file_,
                                             object.c_str(),
                                             name.c_str(),
                                             file_type,
                                             space,
                                             H5P_DEFAULT,
                                             H5P_DEFAULT,
                                             H5P_DEFAULT),
                           H5Aclose);
    note_error(attribute.is_valid() &&
                 H5Awrite(attribute, memory_type, value) >= 0,
               "the attribute '" + name + "' could not be written");
  }



  void
  Hdf5File::set_attribute(const std::string &object,
                          const std::string &name,
                          const std::string &value)
  {
    const Handle type = text_type(value);
    write_attribute(object, name, type, type, value.c_str());
  }



  /// Numbers are converted from the file's type to that of memory, as far as the
  /// two have the same values.
  template <typename Number>
  Number
  Hdf5File::read_attribute(const std::string &object,
                           const std::string &name,
                           const hid_t        memory_type,
                           const hid_t        file_type)
  {
    Number value = 0;
    if (!error_.empty())
      return value;
    const Handle attribute = open_attribute(file_, object, name);
    check_on_all_ranks(attribute.is_valid() &&
                         is_number(attribute, file_type) &&
                         H5Aread(attribute, memory_type, &value) >= 0,
                       is_missing(object, name));
    return value;
  }



  /// Texts have a fixed length in the file, filled up with zeros.
  std::string
  Hdf5File::text_attribute(const std::string &object, const std::string &name)
  {
    if (!error_.empty())
      return "";
    const Handle attribute = open_attribute(file_, object, name);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    const Handle space(H5Aget_space(attribute), H5Sclose);
    const auto   length = length_of_text(type, space);
    // What the library takes of it, it has taken already.
    std::string value(length.value_or(0), '\0');
    check_on_all_ranks(length.has_value() &&
                         H5Aread(attribute, type, value.data()) >= 0,
                       is_missing(object, name));
    return value.substr(0, value.find('\0'));
  }



  // ------------------------------------------------------------------- arrays

  /// MPI_Scan() sums up to and including this rank.
  std::pair<std::uint64_t, std::uint64_t>
  Hdf5File::first_and_total(const std::uint64_t n_rows) const
  {
    std::uint64_t end = 0;
    const int     status =
      MPI_Scan(&n_rows, &end, 1, MPI_UINT64_T, MPI_SUM, communicator_);
    AssertThrowMPI(status);
    return {end - n_rows, Utilities::MPI::sum(n_rows, communicator_)};
  }



  /// The checksum of a part depends on the places of its values in the whole,
  /// and the sum over the parts is that of the array, however many ranks wrote
  /// it.
  template <typename Number>
  void
  Hdf5File::write(const std::string         &name,
                  const std::vector<Number> &rows,
                  const unsigned int         n_columns)
  {
    if (!error_.empty())
      return;
    const std::uint64_t n           = rows.size() / n_columns;
    const auto [first, total]       = first_and_total(n);
    const auto [in_memory, in_file] = types_of(Number());
    write_rows(
      name, in_memory, in_file, {first, n, total, n_columns}, rows.data());
    if constexpr (std::is_same_v<Number, double>)
      if (options_.has_checksums)
        {
          const std::uint64_t own = checksum(rows, first * n_columns);
          set_attribute(name,
                        "checksum",
                        Utilities::MPI::sum(own, communicator_));
        }
  }



  /// Reserved as if nothing could be compressed, since nobody knows before.
  /// When the array is written, n_bytes_ takes its true size, so that the next
  /// reservations do not add up to many times the file. That size is the first
  /// rank's word, or the ranks might count differently.
  void
  Hdf5File::write_rows(const std::string &name,
                       const hid_t        memory_type,
                       const hid_t        file_type,
                       const Rows        &rows,
                       const void        *values)
  {
    const std::uint64_t before = n_bytes_;
    reserve(with_overhead(rows.n_on_all_ranks * rows.n_columns *
                          H5Tget_size(file_type)));
    if (!error_.empty())
      return;
    // After every step the ranks agree whether to go on: one that gave up
    // alone would leave the others waiting for it in the next step.
    const std::string failure = "the array '" + name + "' could not be written";
    Handle            array =
      create_array(name, file_type, rows.n_on_all_ranks, rows.n_columns);
    if (!check_on_all_ranks(array.is_valid(), failure))
      return;
    bool success = transfer_rows(
      H5Dwrite, array, memory_type, rows.first, rows.n, rows.n_columns, values);
    n_bytes_ =
      before + with_overhead(Utilities::MPI::broadcast(
                 communicator_, std::uint64_t(H5Dget_storage_size(array))));
    success = array.close() && success;
    check_on_all_ranks(success, failure);
  }



  /// With one column it has no columns at all.
  Hdf5Handle
  Hdf5File::create_array(const std::string  &name,
                         const hid_t         type,
                         const std::uint64_t n_rows,
                         const unsigned int  n_columns)
  {
    const int     rank       = (n_columns == 1 ? 1 : 2);
    const hsize_t extent[2]  = {n_rows, n_columns};
    const Handle  properties = undated(H5P_DATASET_CREATE);
    const Handle  space(H5Screate_simple(rank, extent, nullptr), H5Sclose);
    bool          success = properties.is_valid() && space.is_valid();
    // Shuffled, first bytes of all values together and so on: signs and
    // exponents of neighbours are alike. Level 1 of deflate is the fastest one.
    if (options_.is_compressed && n_rows > 0)
      {
        // Chunks of a quarter of a megabyte: many enough to keep the ranks
        // busy, and each compresses about as well as the whole.
        constexpr hsize_t n_values = 1 << 16;
        const hsize_t     chunk[2] = {std::min<hsize_t>(n_rows,
                                                    n_values / n_columns),
                                      n_columns};
        success = success && H5Pset_chunk(properties, rank, chunk) >= 0 &&
                  H5Pset_shuffle(properties) >= 0 &&
                  H5Pset_deflate(properties, 1) >= 0;
      }
    if (!success)
      return {};
    return {
      H5Dcreate2(
        file_, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
      H5Dclose};
  }



  /// All ranks have the values, so only the first one writes, which needs no
  /// agreement on how rows are distributed.
  void
  Hdf5File::write_known(const std::string         &name,
                        const std::vector<double> &values)
  {
    const hsize_t extent = values.size();
    const Handle  space(H5Screate_simple(1, &extent, nullptr), H5Sclose);
    write_by_first_rank(
      name, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, space, values.data());
    if (options_.has_checksums)
      set_attribute(name, "checksum", checksum(values, 0));
  }



  /// All ranks must know the length, which is part of the type.
  void
  Hdf5File::write_text(const std::string &name, const std::string &text)
  {
    if (!error_.empty())
      return;
    const std::string same = Utilities::MPI::broadcast(communicator_, text);
    const Handle      type = text_type(same);
    const Handle      space(H5Screate(H5S_SCALAR), H5Sclose);
    write_by_first_rank(name, type, type, space, same.c_str());
    if (options_.has_checksums)
      set_attribute(name, "checksum", checksum(same));
  }



  /// Making an array is collective, writing need not be.
  void
  Hdf5File::write_by_first_rank(const std::string &name,
                                const hid_t        memory_type,
                                const hid_t        file_type,
                                const hid_t        space,
                                const void        *values)
  {
    reserve(small_overhead +
            H5Sget_simple_extent_npoints(space) * H5Tget_size(file_type));
    if (!error_.empty())
      return;
    const Handle array(H5Dcreate2(file_,
                                  name.c_str(),
                                  file_type,
                                  space,
                                  H5P_DEFAULT,
                                  undated(H5P_DATASET_CREATE),
                                  H5P_DEFAULT),
                       H5Dclose);
    const bool   success =
      array.is_valid() &&
      (!is_first_rank_ ||
       H5Dwrite(array, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >=
         0);
    note_error(success, "'" + name + "' could not be written");
  }



  /// A list has one column.
  std::pair<std::uint64_t, unsigned int>
  Hdf5File::shape(const std::string &name)
  {
    if (!error_.empty())
      return {0, 0};
    hsize_t      extent[2] = {0, 1};
    const Handle array     = open_array(file_, name);
    const Handle space(H5Dget_space(array), H5Sclose);
    const Handle type(H5Dget_type(array), H5Tclose);
    const int    rank = H5Sget_simple_extent_ndims(space);
    const bool   success =
      (rank == 1 || rank == 2) && H5Tequal(type, H5T_IEEE_F64LE) > 0 &&
      H5Sget_simple_extent_dims(space, extent, nullptr) == rank &&
      extent[1] > 0 && extent[1] <= largest_n_columns &&
      is_stored(file_, array);
    if (!check_on_all_ranks(success, "it has no array '" + name + "'"))
      return {0, 0};
    return {extent[0], static_cast<unsigned int>(extent[1])};
  }



  std::vector<double>
  Hdf5File::read(const std::string  &name,
                 const std::uint64_t first,
                 const std::uint64_t n_rows)
  {
    const auto [n_there, n_columns] = shape(name);
    if (!error_.empty() ||
        !check_on_all_ranks(first <= n_there && n_rows <= n_there - first,
                            text("the array '",
                                 name,
                                 "' has ",
                                 n_there,
                                 " rows, where ",
                                 first + n_rows,
                                 " were expected")))
      return {};
    std::vector<double> rows(n_rows * n_columns);
    const Handle        array   = open_array(file_, name);
    const bool          success = array.is_valid() && transfer_rows(H5Dread,
                                                           array,
                                                           H5T_NATIVE_DOUBLE,
                                                           first,
                                                           n_rows,
                                                           n_columns,
                                                           rows.data());
    check_on_all_ranks(success, "the array '" + name + "' could not be read");
    return rows;
  }



  std::string
  Hdf5File::read_text(const std::string &name)
  {
    if (!error_.empty())
      return "";
    const Handle array = open_array(file_, name);
    const Handle type(H5Dget_type(array), H5Tclose);
    const Handle space(H5Dget_space(array), H5Sclose);
    const auto   length   = length_of_text(type, space);
    const bool   is_there = length.has_value() && is_stored(file_, array);
    std::string  text(is_there ? *length : 0, '\0');
    const bool   success =
      is_there &&
      H5Dread(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()) >= 0;
    check_on_all_ranks(success, "it has no text '" + name + "'");
    return text.substr(0, text.find('\0'));
  }



  /// What decides how the checksum is taken.
  bool
  Hdf5File::is_text(const std::string &name)
  {
    if (!error_.empty())
      return false;
    const Handle array = open_array(file_, name);
    const Handle type(H5Dget_type(array), H5Tclose);
    const auto   kind = H5Tget_class(type);
    check_on_all_ranks(kind == H5T_STRING || kind == H5T_FLOAT,
                       "'" + name + "' is neither an array nor a text");
    return kind == H5T_STRING;
  }



  /// Each rank reads an equal share of the rows, whatever rank wrote them: a
  /// large file is checked in the time of reading it once.
  void
  Hdf5File::verify(const std::string &name)
  {
    std::uint64_t found = 0;
    if (is_text(name))
      found = checksum(read_text(name));
    else
      {
        const std::uint64_t n_ranks =
          Utilities::MPI::n_mpi_processes(communicator_);
        const std::uint64_t rank =
          Utilities::MPI::this_mpi_process(communicator_);
        const auto [n_rows, n_columns] = shape(name);
        const std::uint64_t first      = n_rows * rank / n_ranks;
        const std::uint64_t end        = n_rows * (rank + 1) / n_ranks;
        const std::uint64_t own =
          checksum(read(name, first, end - first), first * n_columns);
        found = Utilities::MPI::sum(own, communicator_);
      }
    const std::uint64_t expected = integer_attribute(name, "checksum");
    if (error_.empty() && found != expected)
      error_ = "the checksum of '" + name + "' does not match its content";
  }



  template double
  Hdf5File::read_attribute(const std::string &,
                           const std::string &,
                           hid_t,
                           hid_t);
  template std::uint64_t
  Hdf5File::read_attribute(const std::string &,
                           const std::string &,
                           hid_t,
                           hid_t);
  template void
  Hdf5File::write(const std::string &,
                  const std::vector<double> &,
                  unsigned int);
  template void
  Hdf5File::write(const std::string &,
                  const std::vector<float> &,
                  unsigned int);
  template void
  Hdf5File::write(const std::string &,
                  const std::vector<std::int64_t> &,
                  unsigned int);
} // namespace talus
