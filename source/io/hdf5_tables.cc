#include <talus/base/errors.h>
#include <talus/io/hdf5_errors.h>
#include <talus/io/hdf5_handle.h>
#include <talus/io/hdf5_tables.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Names of the links in a group, or with @p get_name = H5Aget_name_by_idx
    /// of the attributes of an object; @p n of them.
    template <typename GetName>
    bool
    read_names(const hid_t               object,
               const hsize_t             n,
               const GetName            &get_name,
               std::vector<std::string> &names)
    {
      for (hsize_t i = 0; i < n; ++i)
        {
          const auto get = [&](char *name, const std::size_t size) {
            return get_name(object,
                            ".",
                            H5_INDEX_NAME,
                            H5_ITER_INC,
                            i,
                            name,
                            size,
                            H5P_DEFAULT);
          };
          const auto length = get(nullptr, 0);
          if (length < 0)
            return false;
          std::string name(length, ' ');
          if (get(name.data(), length + 1) < 0)
            return false;
          names.push_back(name);
        }
      return true;
    }



    bool
    read_text(const hid_t dataset, const std::string &name, std::string &text)
    {
      const Hdf5Handle attribute(H5Aopen(dataset, name.c_str(), H5P_DEFAULT),
                                 H5Aclose);
      const Hdf5Handle type(H5Aget_type(attribute), H5Tclose);
      if (!type.well() || H5Tget_class(type) != H5T_STRING)
        return false;
      text.assign(H5Tget_size(type), '\0');
      return H5Aread(attribute, type, text.data()) >= 0;
    }



    bool
    read_table(const hid_t file, Hdf5Table &table)
    {
      const Hdf5Handle dataset(H5Dopen2(file, table.path.c_str(), H5P_DEFAULT),
                               H5Dclose);
      const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
      const int        rank      = H5Sget_simple_extent_ndims(space);
      hsize_t          extent[2] = {0, 1};
      if ((rank != 1 && rank != 2) ||
          H5Sget_simple_extent_dims(space, extent, nullptr) < 0)
        return false;
      table.n_rows    = extent[0];
      table.n_columns = extent[1];

      H5O_info_t               info;
      std::vector<std::string> names;
      if (H5Oget_info2(dataset, &info, H5O_INFO_NUM_ATTRS) < 0 ||
          !read_names(dataset, info.num_attrs, H5Aget_name_by_idx, names))
        return false;
      for (const std::string &name : names)
        if (!read_text(dataset, name, table.attributes[name]))
          return false;
      return true;
    }



    bool
    read_tables(const std::filesystem::path &path,
                const std::string           &group_name,
                std::vector<Hdf5Table>      &tables)
    {
      const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT),
                            H5Fclose);
      const Hdf5Handle group(H5Gopen2(file, group_name.c_str(), H5P_DEFAULT),
                             H5Gclose);
      H5G_info_t       info;
      std::vector<std::string> names;
      if (H5Gget_info(group, &info) < 0 ||
          !read_names(group, info.nlinks, H5Lget_name_by_idx, names))
        return false;
      for (const std::string &name : names)
        {
          tables.push_back({"/" + group_name + "/" + name, 0, 0, {}});
          if (!read_table(file, tables.back()))
            return false;
        }
      return true;
    }
  } // namespace



  std::vector<Hdf5Table>
  list_tables(const std::filesystem::path &path, const std::string &group)
  {
    const Hdf5Errors       errors;
    std::vector<Hdf5Table> tables;
    const bool             well = read_tables(path, group, tables);
    AssertThrow(well,
                ExcUser(text("The file '",
                             path.string(),
                             "' could not be read (",
                             errors.reason(),
                             "), but an output of this run is expected in it. "
                             "Remove or restore the file, or choose another "
                             "folder with Output/Folder or --output.")));
    return tables;
  }
} // namespace talus
