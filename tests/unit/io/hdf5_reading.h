// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef io_hdf5_reading_h
#define io_hdf5_reading_h

#include <talus/io/hdf5_handle.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// A dataset as the HDF5 library reads it.
template <typename Number>
struct Dataset
{
  std::vector<hsize_t> extent;
  std::vector<Number>  values;
};



inline hid_t
native_type(float)
{
  return H5T_NATIVE_FLOAT;
}

inline hid_t
native_type(double)
{
  return H5T_NATIVE_DOUBLE;
}

inline hid_t
native_type(std::int64_t)
{
  return H5T_NATIVE_INT64;
}



template <typename Number>
Dataset<Number>
read_dataset(const std::filesystem::path &path, const std::string &name)
{
  using talus::Hdf5Handle;
  Dataset<Number>  result;
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT),
                        H5Fclose);
  const Hdf5Handle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose);
  EXPECT_TRUE(space.is_valid()) << path << ": " << name;
  if (!space.is_valid())
    return result;
  result.extent.resize(H5Sget_simple_extent_ndims(space));
  H5Sget_simple_extent_dims(space, result.extent.data(), nullptr);
  result.values.resize(H5Sget_simple_extent_npoints(space));
  EXPECT_GE(H5Dread(dataset,
                    native_type(Number()),
                    H5S_ALL,
                    H5S_ALL,
                    H5P_DEFAULT,
                    result.values.data()),
            0);
  return result;
}



inline std::string
read_attribute(const std::filesystem::path &path,
               const std::string           &object,
               const std::string           &name)
{
  using talus::Hdf5Handle;
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT),
                        H5Fclose);
  const Hdf5Handle attribute(H5Aopen_by_name(file,
                                             object.c_str(),
                                             name.c_str(),
                                             H5P_DEFAULT,
                                             H5P_DEFAULT),
                             H5Aclose);
  const Hdf5Handle type(H5Aget_type(attribute), H5Tclose);
  EXPECT_TRUE(type.is_valid()) << object << ": " << name;
  if (!type.is_valid())
    return "";
  std::string text(H5Tget_size(type), ' ');
  EXPECT_GE(H5Aread(attribute, type, text.data()), 0);
  return text;
}



inline std::vector<std::string>
files_in(const std::filesystem::path &folder)
{
  std::vector<std::string> names;
  for (const auto &entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

#endif
