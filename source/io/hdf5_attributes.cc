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



  void
  Hdf5File::write_attribute(const std::string &object,
                            const std::string &name,
                            const hid_t        type,
                            const void        *value)
  {
    if (!error_.empty())
      return;
    const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
    const Handle attribute(H5Acreate_by_name(file_,
                                             object.c_str(),
                                             name.c_str(),
                                             type,
                                             space,
                                             H5P_DEFAULT,
                                             H5P_DEFAULT,
                                             H5P_DEFAULT),
                           H5Aclose);
    remember(attribute >= 0 && H5Awrite(attribute, type, value) >= 0,
             "the attribute '" + name + "' could not be written");
  }



  void
  Hdf5File::read_attribute(const std::string &object,
                           const std::string &name,
                           const hid_t        type,
                           void              *value)
  {
    if (!error_.empty())
      return;
    const Handle attribute = open_attribute(file_, object, name);
    conclude(attribute >= 0 && H5Aread(attribute, type, value) >= 0,
             is_missing(object, name));
  }



  void
  Hdf5File::set_attribute(const std::string &object,
                          const std::string &name,
                          const std::string &value)
  {
    write_attribute(object, name, text_type(value), value.c_str());
  }



  void
  Hdf5File::set_attribute(const std::string &object,
                          const std::string &name,
                          const double       value)
  {
    write_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
  }



  void
  Hdf5File::set_attribute(const std::string  &object,
                          const std::string  &name,
                          const std::uint64_t value)
  {
    write_attribute(object, name, H5T_NATIVE_UINT64, &value);
  }



  std::string
  Hdf5File::text_attribute(const std::string &object, const std::string &name)
  {
    if (!error_.empty())
      return "";
    const Handle attribute = open_attribute(file_, object, name);
    const Handle type(H5Aget_type(attribute), H5Tclose);
    std::string  value(H5Tget_size(type), '\0');
    conclude(H5Tget_class(type) == H5T_STRING &&
               H5Aread(attribute, type, value.data()) >= 0,
             is_missing(object, name));
    return value.substr(0, value.find('\0'));
  }



  double
  Hdf5File::number_attribute(const std::string &object, const std::string &name)
  {
    double value = 0;
    read_attribute(object, name, H5T_NATIVE_DOUBLE, &value);
    return value;
  }



  std::uint64_t
  Hdf5File::integer_attribute(const std::string &object,
                              const std::string &name)
  {
    std::uint64_t value = 0;
    read_attribute(object, name, H5T_NATIVE_UINT64, &value);
    return value;
  }



  bool
  Hdf5File::is_text(const std::string &name)
  {
    if (!error_.empty())
      return false;
    const Handle dataset(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle type(H5Dget_type(dataset), H5Tclose);
    const auto   kind = H5Tget_class(type);
    conclude(kind == H5T_STRING || kind == H5T_FLOAT,
             "'" + name + "' is neither an array nor a text");
    return kind == H5T_STRING;
  }



  void
  Hdf5File::verify(const std::string &name)
  {
    if (is_text(name))
      {
        compare(name, checksum(read_text(name)));
        return;
      }
    const std::uint64_t n_ranks =
      Utilities::MPI::n_mpi_processes(communicator_);
    const std::uint64_t rank = Utilities::MPI::this_mpi_process(communicator_);
    const auto [n_rows, n_columns] = shape(name);
    const std::uint64_t first      = n_rows * rank / n_ranks;
    const std::uint64_t end        = n_rows * (rank + 1) / n_ranks;
    const std::uint64_t own =
      checksum(read(name, first, end - first), first * n_columns);
    compare(name, Utilities::MPI::sum(own, communicator_));
  }



  void
  Hdf5File::compare(const std::string &name, const std::uint64_t found)
  {
    const std::uint64_t expected = integer_attribute(name, "checksum");
    if (error_.empty() && found != expected)
      error_ = "the checksum of '" + name + "' does not match its content";
  }
} // namespace talus
