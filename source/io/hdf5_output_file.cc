// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
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

    /// So that no reader finds a file under its name that is not complete.
    std::filesystem::path
    path_while_written(std::filesystem::path path, const bool is_atomic)
    {
      if (is_atomic)
        path += ".part";
      return path;
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



  /// The file must exist before its space can be reserved, and H5Fcreate() may
  /// be the first to fill the disk; so space for an empty file is reserved
  /// before. If that fails the library never sees the file. Whatever has the
  /// name while the file is written goes: a link would lead to a file of the
  /// user.
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
  Hdf5OutputFile::close()
  {
    if (!error().empty())
      return;
    // Flushed first, so that a full disk shows before the file is closed.
    bool success = (H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0);
    success      = file_.close() && success;
    if (!check_on_all_ranks(success, "it could not be completed"))
      return;
    if (is_first_rank_)
      {
        Assert(std::filesystem::file_size(part_) <= n_bytes_,
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



  /// n_bytes_ is the size of the file at most, as all ranks count it alike, so
  /// they agree without a message whether more must be reserved. The first rank
  /// does it.
  void
  Hdf5OutputFile::reserve(const std::uint64_t n_bytes)
  {
    n_bytes_ += n_bytes;
    if (!error().empty() || n_bytes_ <= n_reserved_)
      return;
    // A little more: many arrays are short.
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
    // Names stay in the header, which has a checksum. The other storage, for
    // many names, has one too, but HDF5 1.10 crashes where it is wrong.
    H5Pset_link_phase_change(properties, 60000, 50000);
    const Handle group(
      H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT),
      H5Gclose);
    check_on_all_ranks(group.is_valid(),
                       "the group '" + name + "' could not be made");
  }



  /// All ranks give the same value, as collective metadata demand. A failure is
  /// noted, and told with the next agreement: no rank waits for this one.
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



  /// The checksum of a part depends on the places of its values in the whole,
  /// and the sum over the parts is that of the array, however many ranks wrote
  /// it.
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



  /// Reserved as if nothing could be compressed, since nobody knows before.
  /// When the array is written, n_bytes_ takes its true size, so that the next
  /// reservations do not add up to many times the file. That size is the first
  /// rank's word, or the ranks might count differently.
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
                 communicator(), std::uint64_t(H5Dget_storage_size(array))));
    success = array.close() && success;
    check_on_all_ranks(success, failure);
  }



  /// With one column it has no columns at all.
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
  Hdf5OutputFile::write_known(const std::string         &name,
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
  Hdf5OutputFile::write_text(const std::string &name, const std::string &text)
  {
    if (!error().empty())
      return;
    const std::string same = Utilities::MPI::broadcast(communicator(), text);
    const Handle      type = text_type(same);
    const Handle      space(H5Screate(H5S_SCALAR), H5Sclose);
    write_by_first_rank(name, type, type, space, same.c_str());
    if (options_.has_checksums)
      set_attribute(name, "checksum", checksum(same));
  }



  /// Making an array is collective, writing need not be.
  void
  Hdf5OutputFile::write_by_first_rank(const std::string &name,
                                      const hid_t        memory_type,
                                      const hid_t        file_type,
                                      const hid_t        space,
                                      const void        *values)
  {
    reserve(small_overhead +
            H5Sget_simple_extent_npoints(space) * H5Tget_size(file_type));
    if (!error().empty())
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
