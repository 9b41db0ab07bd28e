#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/io/disk_space.h>
#include <talus/io/files.h>
#include <talus/io/hdf5_writer.h>

#include <algorithm>
#include <array>

namespace talus
{
  using namespace dealii;

  namespace
  {
    std::filesystem::path
    with_part(std::filesystem::path path)
    {
      path += ".part";
      return path;
    }



    /// With what the library adds to a table for itself: the list of chunks,
    /// attributes, a group; and a little if the data cannot be compressed.
    std::uint64_t
    with_overhead(const std::uint64_t n_bytes)
    {
      return n_bytes + n_bytes / 50 + (1 << 14);
    }



    bool
    add_attribute(const hid_t        object,
                  const std::string &name,
                  const hid_t        memory_type,
                  const hid_t        file_type,
                  const void        *value)
    {
      const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose);
      const Hdf5Handle attribute(
        H5Acreate2(
          object, name.c_str(), file_type, space, H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
      return attribute.well() && H5Awrite(attribute, memory_type, value) >= 0;
    }



    bool
    add_text(const hid_t        object,
             const std::string &name,
             const std::string &text)
    {
      const Hdf5Handle type = text_type(text);
      return type.well() &&
             add_attribute(object, name, type, type, text.c_str());
    }
  } // namespace



  Hdf5Writer::Hdf5Writer(const std::filesystem::path &path,
                         const MPI_Comm               communicator)
    : path_(path)
    , communicator_(communicator)
    , rank_(Utilities::MPI::this_mpi_process(communicator))
    , n_ranks_(Utilities::MPI::n_mpi_processes(communicator))
    , part_{with_part(path), rank_ == 0}
  {
    const Hdf5Handle creation = undated(H5P_FILE_CREATE);
    const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    bool             well = creation.well() && access.well();
    if (well && n_ranks_ > 1)
      well = H5Pset_fapl_mpio(access, communicator_, MPI_INFO_NULL) >= 0;
    agree(well);
    // Now, and again when the library has emptied the file.
    reserve(0);
    file_ =
      Hdf5Handle(H5Fcreate(part_.path.c_str(), H5F_ACC_TRUNC, creation, access),
                 H5Fclose);
    agree(file_.well());
    reserve(0);
  }



  Hdf5Writer::Part::~Part()
  {
    std::error_code ignored;
    if (is_mine)
      std::filesystem::remove(path, ignored);
  }



  void
  Hdf5Writer::add_number(const std::string &name, const double value)
  {
    agree(
      add_attribute(file_, name, H5T_NATIVE_DOUBLE, H5T_IEEE_F64LE, &value));
  }



  void
  Hdf5Writer::add_group(const std::string &name)
  {
    const Hdf5Handle creation = undated(H5P_GROUP_CREATE);
    const Hdf5Handle group(
      H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT),
      H5Gclose);
    agree(creation.well() && group.well());
  }



  void
  Hdf5Writer::add_table(const std::string        &name,
                        const std::vector<float> &values,
                        const unsigned int        n_columns,
                        const Attributes         &attributes)
  {
    write_table(name,
                {values.data(),
                 H5T_NATIVE_FLOAT,
                 H5T_IEEE_F32LE,
                 values.size() / n_columns,
                 n_columns},
                attributes);
  }



  void
  Hdf5Writer::add_table(const std::string               &name,
                        const std::vector<std::int64_t> &values,
                        const unsigned int               n_columns,
                        const Attributes                &attributes)
  {
    write_table(name,
                {values.data(),
                 H5T_NATIVE_INT64,
                 H5T_STD_I64LE,
                 values.size() / n_columns,
                 n_columns},
                attributes);
  }



  void
  Hdf5Writer::write_table(const std::string &name,
                          const Table       &table,
                          const Attributes  &attributes)
  {
    std::uint64_t first = 0;
    std::uint64_t n     = table.n_rows;
    MPI_Exscan(&n, &first, 1, MPI_UINT64_T, MPI_SUM, communicator_);
    MPI_Allreduce(MPI_IN_PLACE, &n, 1, MPI_UINT64_T, MPI_SUM, communicator_);

    reserve(n * table.n_columns * H5Tget_size(table.file_type));
    // After every step the ranks agree whether to go on: one that gave up
    // alone would leave the others waiting for it in the next step.
    Hdf5Handle dataset = create_dataset(name, table, n);
    bool       well    = dataset.well();
    for (const auto &[attribute, value] : attributes)
      well = well && add_text(dataset, attribute, value);
    agree(well);
    agree(n == 0 || write_rows(dataset, table, first));
    n_bytes_ += with_overhead(H5Dget_storage_size(dataset));
    agree(dataset.close());
  }



  Hdf5Handle
  Hdf5Writer::create_dataset(const std::string &name,
                             const Table       &table,
                             const hsize_t      n_rows_of_all) const
  {
    const Hdf5Handle             creation = undated(H5P_DATASET_CREATE);
    const unsigned int           rank     = (table.n_columns == 1 ? 1 : 2);
    const std::array<hsize_t, 2> extent   = {{n_rows_of_all, table.n_columns}};
    bool                         well     = creation.well();
    if (n_rows_of_all > 0)
      {
        // Chunks of a quarter of a megabyte: many enough to keep the ranks
        // busy, and each compresses about as well as the whole.
        constexpr hsize_t            n_values = 1 << 16;
        const std::array<hsize_t, 2> chunk    = {
             {std::min(n_rows_of_all, n_values / table.n_columns),
              table.n_columns}};
        well = well && H5Pset_chunk(creation, rank, chunk.data()) >= 0 &&
               H5Pset_shuffle(creation) >= 0 &&
               H5Pset_deflate(creation, 1) >= 0;
      }
    const Hdf5Handle space(H5Screate_simple(rank, extent.data(), nullptr),
                           H5Sclose);
    if (!well || !space.well())
      return {};
    return {H5Dcreate2(file_,
                       name.c_str(),
                       table.file_type,
                       space,
                       H5P_DEFAULT,
                       creation,
                       H5P_DEFAULT),
            H5Dclose};
  }



  bool
  Hdf5Writer::write_rows(const hid_t   dataset,
                         const Table  &table,
                         const hsize_t first_row) const
  {
    const std::array<hsize_t, 2> start = {{first_row, 0}};
    const std::array<hsize_t, 2> count = {{table.n_rows, table.n_columns}};
    const Hdf5Handle             in_file(H5Dget_space(dataset), H5Sclose);
    const Hdf5Handle in_memory(H5Screate_simple(table.n_columns == 1 ? 1 : 2,
                                                count.data(),
                                                nullptr),
                               H5Sclose);
    const Hdf5Handle transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
    bool             well =
      in_file.well() && in_memory.well() && transfer.well() &&
      (n_ranks_ == 1 || H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE) >= 0);
    // A rank without rows takes part with nothing.
    if (table.n_rows == 0)
      well =
        well && H5Sselect_none(in_file) >= 0 && H5Sselect_none(in_memory) >= 0;
    else
      well = well && H5Sselect_hyperslab(in_file,
                                         H5S_SELECT_SET,
                                         start.data(),
                                         nullptr,
                                         count.data(),
                                         nullptr) >= 0;
    agree(well);
    return H5Dwrite(dataset,
                    table.memory_type,
                    in_memory,
                    in_file,
                    transfer,
                    table.data) >= 0;
  }



  void
  Hdf5Writer::finish()
  {
    agree(H5Fflush(file_, H5F_SCOPE_GLOBAL) >= 0);
    agree(file_.close());
    std::string complaint;
    if (rank_ == 0)
      {
        Assert(std::filesystem::file_size(part_.path) <=
                 n_bytes_ + with_overhead(0),
               ExcMessage("More was written than reserved."));
        complaint = release_disk_space(part_.path);
        if (complaint.empty())
          complaint = sync_to_disk(part_.path);
      }
    conclude(complaint);
    std::error_code error;
    if (rank_ == 0)
      std::filesystem::rename(part_.path, path_, error);
    conclude(error ? error.message() : "");
  }



  void
  Hdf5Writer::reserve(const std::uint64_t n_bytes) const
  {
    std::string complaint;
    if (rank_ == 0)
      complaint =
        reserve_disk_space(part_.path, n_bytes_ + with_overhead(n_bytes));
    conclude(complaint);
  }



  void
  Hdf5Writer::agree(const bool well) const
  {
    conclude(well ? "" : errors_.reason());
  }



  void
  Hdf5Writer::conclude(const std::string &complaint) const
  {
    const std::string reason = first_sentence(complaint, communicator_);
    AssertThrow(reason.empty(), ExcUser(failed_write(path_, reason)));
  }
} // namespace talus
