// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/assertion.h>
#include <talus/io/checksum.h>
#include <talus/io/disk_space.h>
#include <talus/io/files.h>
#include <talus/io/hdf5_output_file.h>
#include <talus/io/hdf5_rows.h>

#include <algorithm>
#include <type_traits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    using Handle = Hdf5Handle;

    /// Return a temporary name, under which no reader looks for the file.
    std::filesystem::path
    path_while_written(std::filesystem::path path, const bool is_atomic)
    {
      if (is_atomic)
        path += ".part";
      return path;
    }



    /// Add an upper bound of the library's own data for an array: list of
    /// chunks, attributes, and an excess if the data cannot be compressed.
    std::uint64_t
    with_overhead(const std::uint64_t n_bytes)
    {
      return n_bytes + n_bytes / 50 + (1 << 14);
    }

    /// Upper bound of the library's own data for a short object, bytes.
    constexpr std::uint64_t small_overhead = 1 << 12;

    /// Types in memory and in the file; the latter are the same on all
    /// machines.
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
  } // namespace



  Hdf5OutputFile::Hdf5OutputFile(const std::filesystem::path &path,
                                 const MPI_Comm               communicator,
                                 const Hdf5Options           &options)
    : Hdf5File(path, communicator)
    , part_(path_while_written(path, options.is_atomic))
    , is_first_rank_(is_first_rank(communicator))
    , options_(options)
  {
    check_not_input(path);
    check_not_input(part_);
    create();
  }



  Hdf5OutputFile::~Hdf5OutputFile()
  {
    file_.close();
    std::error_code ignored;
    if (is_first_rank_ && part_ != path())
      std::filesystem::remove(part_, ignored);
  }



  /// The file must exist before disk space can be reserved, and H5Fcreate() may
  /// be the first call to fill the disk. Therefore space for an empty file is
  /// reserved before; on failure the library never sees the file. Any old file
  /// under the temporary name is removed, because a link could lead to a file
  /// of the user.
  void
  Hdf5OutputFile::create()
  {
    std::error_code ignored;
    if (is_first_rank_ && part_ != path())
      std::filesystem::remove(part_, ignored);
    reserve(with_overhead(0));
    if (!error().empty())
      return;
    file_ = Handle(H5Fcreate(part_.c_str(),
                             H5F_ACC_TRUNC,
                             undated(H5P_FILE_CREATE),
                             access_properties()),
                   H5Fclose);
    check_on_all_ranks(file_.is_valid(), "it could not be made");
    // Once more, because the library has emptied the file.
    n_reserved_ = 0;
    reserve(0);
  }



  /// Order: hand all data to the operating system; close the file on all ranks;
  /// release unused reserved space; sync the content to the disk; finally
  /// rename. If the machine crashes in between, the older file of the same name
  /// is complete. After each step of a single rank, all ranks agree whether to
  /// go on.
  void
  Hdf5OutputFile::close()
  {
    if (!error().empty())
      return;
    // Flushed before closing, to detect a full disk.
    bool success = (H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0);
    success      = file_.close() && success;
    if (!check_on_all_ranks(success, "it could not be completed"))
      return;
    if (is_first_rank_)
      {
        TalusAssert(std::filesystem::file_size(part_) <= n_bytes_,
                    ExcMessage("More was written than reserved."));
        std::string failure = release_disk_space(part_);
        if (failure.empty() && part_ != path())
          failure = sync_to_disk(part_);
        note_error(failure);
      }
    if (!check_on_all_ranks() || part_ == path())
      return;
    std::error_code error;
    if (is_first_rank_)
      std::filesystem::rename(part_, path(), error);
    note_error(error ? error.message() : "");
    check_on_all_ranks();
  }



  /// n_bytes_ is an upper bound of the size of the file, equal on all ranks:
  /// the ranks agree without a message whether more must be reserved. Only the
  /// first rank reserves.
  void
  Hdf5OutputFile::reserve(const std::uint64_t n_bytes)
  {
    n_bytes_ += n_bytes;
    if (!error().empty() || n_bytes_ <= n_reserved_)
      return;
    // A little more, because many arrays are short.
    n_reserved_ = n_bytes_ + (1 << 16);
    if (is_first_rank_)
      note_error(reserve_disk_space(part_, n_reserved_));
    check_on_all_ranks();
  }



  void
  Hdf5OutputFile::create_group(const std::string &name)
  {
    reserve(small_overhead);
    if (!error().empty())
      return;
    const Handle properties = undated(H5P_GROUP_CREATE);
    // Names stay in the header, which has a checksum. The alternative storage
    // for many names has a checksum, too, but HDF5 1.10 crashes if the checksum
    // is wrong.
    H5Pset_link_phase_change(properties, 60000, 50000);
    const Handle group(
      H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT),
      H5Gclose);
    check_on_all_ranks(group.is_valid(),
                       "the group '" + name + "' could not be made");
  }



  /// All ranks give the same value, because collective metadata require equal
  /// values. A failure is kept until the next check_on_all_ranks(), since no
  /// rank waits for this call.
  void
  Hdf5OutputFile::write_attribute(const std::string &object,
                                  const std::string &name,
                                  const hid_t        memory_type,
                                  const hid_t        file_type,
                                  const void        *value)
  {
    reserve(256 + name.size() + H5Tget_size(file_type));
    if (!error().empty())
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
  Hdf5OutputFile::set_attribute(const std::string &object,
                                const std::string &name,
                                const std::string &value)
  {
    const Handle type = text_type(value);
    write_attribute(object, name, type, type, value.c_str());
  }



  /// The checksum of a part depends on the positions of the values in the whole
  /// array; the sum over the parts is independent of the number of ranks.
  template <typename Number>
  void
  Hdf5OutputFile::write(const std::string         &name,
                        const std::vector<Number> &rows,
                        const unsigned int         n_columns)
  {
    if (!error().empty())
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
                        Utilities::MPI::sum(own, communicator()));
        }
  }



  /// Space is reserved for uncompressed data, because the compressed size is
  /// unknown. After writing, n_bytes_ is corrected to the true size; otherwise
  /// the reservations would add up to a multiple of the file. All ranks use the
  /// size found by the first rank, to count alike.
  void
  Hdf5OutputFile::write_rows(const std::string &name,
                             const hid_t        memory_type,
                             const hid_t        file_type,
                             const Rows        &rows,
                             const void        *values)
  {
    const std::uint64_t before = n_bytes_;
    reserve(with_overhead(rows.n_on_all_ranks * rows.n_columns *
                          H5Tget_size(file_type)));
    if (!error().empty())
      return;
    // After every step the ranks agree whether to go on: a rank that gave up
    // alone would leave all ranks waiting in the next step.
    const std::string failure = "the array '" + name + "' could not be written";
    Handle            array =
      create_array(name, file_type, rows.n_on_all_ranks, rows.n_columns);
    if (!check_on_all_ranks(array.is_valid(), failure))
      return;
    bool success = transfer_rows(
      H5Dwrite, array, memory_type, rows.first, rows.n, rows.n_columns, values);
    n_bytes_ =
      before + with_overhead(Utilities::MPI::broadcast(
                 communicator(), std::uint64_t(H5Dget_storage_size(array))));
    success = array.close() && success;
    check_on_all_ranks(success, failure);
  }



  /// An array with one column is stored as one-dimensional.
  Hdf5Handle
  Hdf5OutputFile::create_array(const std::string  &name,
                               const hid_t         type,
                               const std::uint64_t n_rows,
                               const unsigned int  n_columns)
  {
    const int     rank       = (n_columns == 1 ? 1 : 2);
    const hsize_t extent[2]  = {n_rows, n_columns};
    const Handle  properties = undated(H5P_DATASET_CREATE);
    const Handle  space(H5Screate_simple(rank, extent, nullptr), H5Sclose);
    bool          success = properties.is_valid() && space.is_valid();
    // Shuffling stores the first bytes of all values together, and so on: signs
    // and exponents of neighbours are similar. Level 1 of deflate is the
    // fastest.
    if (options_.is_compressed && n_rows > 0)
      {
        // Chunks of a quarter of a megabyte: enough chunks to keep the ranks
        // busy, and each chunk compresses about as well as the whole array.
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



  /// All ranks must know the length, a part of the type. Making an array is
  /// collective; only the first rank writes.
  void
  Hdf5OutputFile::write_text(const std::string &name, const std::string &text)
  {
    if (!error().empty())
      return;
    const std::string same = Utilities::MPI::broadcast(communicator(), text);
    const Handle      type = text_type(same);
    reserve(small_overhead + H5Tget_size(type));
    if (!error().empty())
      return;
    const Handle array(H5Dcreate2(file_,
                                  name.c_str(),
                                  type,
                                  Handle(H5Screate(H5S_SCALAR), H5Sclose),
                                  H5P_DEFAULT,
                                  undated(H5P_DATASET_CREATE),
                                  H5P_DEFAULT),
                       H5Dclose);
    const bool   success =
      array.is_valid() &&
      (!is_first_rank_ ||
       H5Dwrite(array, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, same.c_str()) >= 0);
    note_error(success, "'" + name + "' could not be written");
    if (options_.has_checksums)
      set_attribute(name, "checksum", checksum(same));
  }



  template void
  Hdf5OutputFile::write(const std::string &,
                        const std::vector<double> &,
                        unsigned int);
  template void
  Hdf5OutputFile::write(const std::string &,
                        const std::vector<float> &,
                        unsigned int);
  template void
  Hdf5OutputFile::write(const std::string &,
                        const std::vector<std::int64_t> &,
                        unsigned int);
} // namespace talus
