// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/hdf5_errors.h>
#include <talus/io/hdf5_handle.h>
#include <talus/io/netcdf_raster.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// An HDF5 file that this rank reads alone: what netCDF puts into one, no
    /// more. Calls of the library that fail are said as one sentence.
    class NetcdfFile
    {
    public:
      explicit NetcdfFile(const std::filesystem::path &path)
        : path_(path)
        , file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose)
      {
        check(file_.is_valid());
      }

      /// Of the arrays in the file, those with this many dimensions.
      std::vector<std::string>
      names(unsigned int n_dimensions) const;

      std::vector<hsize_t>
      shape(const std::string &name) const;

      /// As doubles, whatever numbers they are in the file.
      std::vector<double>
      values(const std::string &name) const;

      /// Nothing if there is no such attribute, or if it is a text.
      std::optional<double>
      number(const std::string &name, const std::string &attribute) const;

      /// Empty if there is none, or if it is no text.
      std::string
      text_of(const std::string &name, const std::string &attribute) const;

      std::string
      place() const
      {
        return text("The netCDF file '", path_.string(), "' ");
      }

    private:
      void
      check(const bool success) const
      {
        AssertThrow(success,
                    ExcUser(text(place(),
                                 "cannot be read (",
                                 errors_.reason(),
                                 "). It may be cut off, or no netCDF-4: fetch "
                                 "it anew.")));
      }

      Hdf5Handle
      open(const std::string &name) const
      {
        Hdf5Handle array(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
        check(array.is_valid());
        return array;
      }

      Hdf5Handle
      open_attribute(const std::string &name,
                     const std::string &attribute) const;

      const std::filesystem::path path_;
      const Hdf5Errors            errors_;
      Hdf5Handle                  file_;
    };



    std::vector<std::string>
    NetcdfFile::names(const unsigned int n_dimensions) const
    {
      std::vector<std::string> all, result;
      const auto               append =
        [](hid_t, const char *name, const H5L_info_t *, void *to) {
          static_cast<std::vector<std::string> *>(to)->emplace_back(name);
          return herr_t(0);
        };
      check(
        H5Literate(file_, H5_INDEX_NAME, H5_ITER_INC, nullptr, append, &all) >=
        0);
      for (const std::string &name : all)
        {
          const Hdf5Handle object(H5Oopen(file_, name.c_str(), H5P_DEFAULT),
                                  H5Oclose);
          check(object.is_valid());
          if (H5Iget_type(object) == H5I_DATASET &&
              shape(name).size() == n_dimensions)
            result.push_back(name);
        }
      return result;
    }



    std::vector<hsize_t>
    NetcdfFile::shape(const std::string &name) const
    {
      const Hdf5Handle array = open(name);
      const Hdf5Handle space(H5Dget_space(array), H5Sclose);
      const int        n = H5Sget_simple_extent_ndims(space);
      check(n >= 0);
      std::vector<hsize_t> result(n);
      if (n > 0)
        H5Sget_simple_extent_dims(space, result.data(), nullptr);
      return result;
    }



    std::vector<double>
    NetcdfFile::values(const std::string &name) const
    {
      const Hdf5Handle array = open(name);
      std::size_t      size  = 1;
      for (const hsize_t n : shape(name))
        size *= n;
      AssertThrow(size > 0 && size < 1000000000,
                  ExcUser(text(place(),
                               "has ",
                               size,
                               " values in '",
                               name,
                               "', where up to a thousand millions can be "
                               "read. Cut out the part you need: gdalwarp -te "
                               "WEST SOUTH EAST NORTH.")));
      std::vector<double> result(size);
      check(H5Dread(array,
                    H5T_NATIVE_DOUBLE,
                    H5S_ALL,
                    H5S_ALL,
                    H5P_DEFAULT,
                    result.data()) >= 0);
      return result;
    }



    Hdf5Handle
    NetcdfFile::open_attribute(const std::string &name,
                               const std::string &attribute) const
    {
      const Hdf5Handle array = open(name);
      if (H5Aexists(array, attribute.c_str()) <= 0)
        return {};
      return Hdf5Handle(H5Aopen(array, attribute.c_str(), H5P_DEFAULT),
                        H5Aclose);
    }



    std::optional<double>
    NetcdfFile::number(const std::string &name,
                       const std::string &attribute) const
    {
      const Hdf5Handle handle = open_attribute(name, attribute);
      if (!handle.is_valid())
        return {};
      const Hdf5Handle type(H5Aget_type(handle), H5Tclose);
      const auto       kind = H5Tget_class(type);
      const Hdf5Handle space(H5Aget_space(handle), H5Sclose);
      double           result = 0.;
      if ((kind != H5T_INTEGER && kind != H5T_FLOAT) ||
          H5Sget_simple_extent_npoints(space) != 1)
        return {};
      check(H5Aread(handle, H5T_NATIVE_DOUBLE, &result) >= 0);
      return result;
    }



    // Of fixed length as the netCDF library writes them, or of variable length
    // as scripts do.
    std::string
    NetcdfFile::text_of(const std::string &name,
                        const std::string &attribute) const
    {
      const Hdf5Handle handle = open_attribute(name, attribute);
      if (!handle.is_valid())
        return "";
      const Hdf5Handle type(H5Aget_type(handle), H5Tclose);
      const Hdf5Handle space(H5Aget_space(handle), H5Sclose);
      if (H5Tget_class(type) != H5T_STRING ||
          H5Sget_simple_extent_npoints(space) != 1)
        return "";
      if (H5Tis_variable_str(type) > 0)
        {
          char *words = nullptr;
          check(H5Aread(handle, type, &words) >= 0);
          const std::string result = (words == nullptr ? "" : words);
          H5free_memory(words);
          return result;
        }
      std::string result(H5Tget_size(type), '\0');
      check(H5Aread(handle, type, result.data()) >= 0);
      return result.c_str(); // up to the zero that it may end with
    }



    /// The coordinates along one axis.
    struct Axis
    {
      std::string  name;
      unsigned int n;
      double       first;   ///< the least one
      double       spacing; ///< positive
      bool         ascends; ///< in the file
    };



    /// The first of @p names that there is.
    Axis
    read_axis(const NetcdfFile &file, const std::vector<std::string> &names)
    {
      Axis       axis;
      const auto known = file.names(1);
      for (const std::string &name : names)
        if (axis.name.empty() &&
            std::find(known.begin(), known.end(), name) != known.end())
          axis.name = name;
      AssertThrow(!axis.name.empty(),
                  ExcUser(text(file.place(),
                               "has no coordinates named ",
                               boost::algorithm::join(names, " or "),
                               "; its lists are: ",
                               boost::algorithm::join(known, ", "),
                               ". Give a raster as GEBCO or GMT write it.")));
      const auto x = file.values(axis.name);
      axis.n       = x.size();
      AssertThrow(axis.n >= 2,
                  ExcUser(text(file.place(),
                               "has one value of '",
                               axis.name,
                               "', where at least two were expected. Give a "
                               "larger part of the map.")));
      const double step = (x.back() - x.front()) / (axis.n - 1);
      axis.ascends      = step > 0.;
      axis.spacing      = std::abs(step);
      axis.first        = std::min(x.front(), x.back());
      for (unsigned int i = 0; i < axis.n; ++i)
        AssertThrow(std::abs(x[i] - (x[0] + i * step)) <= 1e-3 * axis.spacing,
                    ExcUser(text(file.place(),
                                 "has values of '",
                                 axis.name,
                                 "' that are not evenly spaced (",
                                 x[i],
                                 " at place ",
                                 i + 1,
                                 "). Bring it to an even raster with "
                                 "gdalwarp.")));
      return axis;
    }



    /// The array of the heights: of that shape, and with the name that the
    /// common writers give it if there are several.
    std::string
    name_of_values(const NetcdfFile &file, const Axis &x, const Axis &y)
    {
      std::vector<std::string> fitting;
      for (const std::string &name : file.names(2))
        if (file.shape(name) == std::vector<hsize_t>{y.n, x.n})
          fitting.push_back(name);
      if (fitting.size() == 1)
        return fitting.front();
      for (const std::string name : {"elevation", "z", "Band1"})
        if (std::find(fitting.begin(), fitting.end(), name) != fitting.end())
          return name;
      AssertThrow(false,
                  ExcUser(text(file.place(),
                               "has ",
                               fitting.size(),
                               " arrays over '",
                               y.name,
                               "' and '",
                               x.name,
                               "' (",
                               boost::algorithm::join(fitting, ", "),
                               "), where one was expected, or one named "
                               "elevation, z or Band1. Copy it to a file of "
                               "its own.")));
      return "";
    }



    /// Packed numbers become what they stand for, fill values NaN.
    void
    unpack(const NetcdfFile    &file,
           const std::string   &name,
           std::vector<double> &values)
    {
      const double scale  = file.number(name, "scale_factor").value_or(1.);
      const double offset = file.number(name, "add_offset").value_or(0.);
      for (const std::string attribute : {"_FillValue", "missing_value"})
        if (const auto fill = file.number(name, attribute))
          std::replace(values.begin(),
                       values.end(),
                       *fill,
                       std::numeric_limits<double>::quiet_NaN());
      if (scale != 1. || offset != 0.)
        for (double &value : values)
          value = scale * value + offset;
    }
  } // namespace



  std::pair<Raster, std::string>
  read_netcdf_raster(const std::filesystem::path &path)
  {
    const NetcdfFile  file(path);
    const Axis        x = read_axis(file, {"lon", "longitude", "x", "easting"});
    const Axis        y = read_axis(file, {"lat", "latitude", "y", "northing"});
    const std::string name   = name_of_values(file, x, y);
    auto              values = file.values(name);
    AssertThrow(file.text_of(name, "positive") != "down",
                ExcUser(text(file.place(),
                             "has depths in '",
                             name,
                             "', positive downwards, where heights were "
                             "expected. Turn the sign: gmt grdmath in.nc NEG = "
                             "out.nc.")));
    unpack(file, name, values);
    Raster raster;
    raster.n_columns = x.n;
    raster.n_rows    = y.n;
    raster.dx        = x.spacing;
    raster.dy        = y.spacing;
    raster.west      = x.first - 0.5 * x.spacing;
    raster.south     = y.first - 0.5 * y.spacing;
    raster.values.reserve(values.size());
    for (unsigned int r = 0; r < y.n; ++r)
      for (unsigned int c = 0; c < x.n; ++c)
        {
          const std::size_t row    = y.ascends ? y.n - 1 - r : r;
          const std::size_t column = x.ascends ? c : x.n - 1 - c;
          raster.values.push_back(values[row * x.n + column]);
        }
    return {raster, file.text_of(x.name, "units")};
  }
} // namespace talus
