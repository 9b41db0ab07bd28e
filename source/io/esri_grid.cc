// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/esri_grid.h>
#include <talus/io/files.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <set>
#include <string_view>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Return the words of a line, in which decimal commas become points.
    std::vector<std::string_view>
    words_of(std::string &line)
    {
      const char *const             blanks = " \t\r";
      std::vector<std::string_view> words;
      std::replace(line.begin(), line.end(), ',', '.');
      const std::string_view whole = line;
      for (std::size_t end = 0, begin;
           (begin = whole.find_first_not_of(blanks, end)) != whole.npos;)
        {
          end = std::min(whole.find_first_of(blanks, begin), whole.size());
          words.push_back(whole.substr(begin, end - begin));
        }
      return words;
    }



    /// Return whether GDAL reads the whole word as a number or as nan. The
    /// comma of "1.5, 2.5" is a point here.
    bool
    is_number(std::string_view word)
    {
      if (word[0] == '+')
        word.remove_prefix(1);
      double            value = 0.;
      const char *const end   = word.data() + word.size();
      const auto [at, error]  = std::from_chars(word.data(), end, value);
      return error == std::errc() && !std::isinf(value) &&
             (!std::isnan(value) || word.size() == 3) &&
             (at == end || (at + 1 == end && *at == '.'));
    }
  } // namespace



  // GDAL takes a text that is no number for 0, and reads numbers without regard
  // to lines: a missing number would shift all later ones. Like GDAL, the check
  // takes the lines before the first one without a letter for the head.
  void
  check_esri_grid(const std::filesystem::path &file,
                  const unsigned int           n_columns,
                  const unsigned int           n_rows)
  {
    static const std::set<std::string> known = {"ncols",
                                                "nrows",
                                                "xllcorner",
                                                "yllcorner",
                                                "xllcenter",
                                                "yllcenter",
                                                "cellsize",
                                                "dx",
                                                "dy",
                                                "nodata_value"};
    std::ifstream                      in(file, std::ios::binary);
    std::set<std::string>              keywords;
    unsigned int                       n_lines = 0, row = 0;
    const auto check = [&](const bool success, const auto &...words) {
      AssertThrow(success,
                  ExcUser(text("The raster '", file.string(), "'", words...)));
    };
    for (std::string line; std::getline(in, line);)
      {
        const std::string place = text(", line ", ++n_lines, ": ");
        if (n_lines == 1 && line.rfind("\xef\xbb\xbf", 0) == 0)
          line.erase(0, 3); // byte order mark of UTF-8
        const auto words = words_of(line);
        if (words.empty())
          continue;
        if (row == 0 && std::isalpha(static_cast<unsigned char>(line[0])))
          {
            const auto keyword = boost::to_lower_copy(std::string(words[0]));
            check(words.size() == 2 && known.count(keyword) > 0 &&
                    is_number(words[1]) && keywords.insert(keyword).second,
                  place,
                  "'",
                  line.substr(0, 60),
                  "' was found, where a keyword (ncols, nrows, xllcorner, "
                  "yllcorner, xllcenter, yllcenter, cellsize, dx, dy, "
                  "nodata_value; each once) and a number were expected, or a "
                  "row that begins with digits. Correct it.");
            continue;
          }
        check(++row <= n_rows,
              place,
              "there is one more row of values, but nrows is ",
              n_rows,
              ". Correct nrows or remove the row.");
        check(words.size() == n_columns,
              place,
              "row ",
              row,
              " has ",
              words.size(),
              " values, but ncols is ",
              n_columns,
              ". Give one line for each row, with one value for each column, "
              "separated by blanks.");
        for (std::size_t c = 0; c < words.size(); ++c)
          check(is_number(words[c]),
                place,
                "'",
                words[c],
                "' was found in column ",
                c + 1,
                ", where a number was expected. Correct it.");
      }
    check(row == n_rows,
          " has ",
          row,
          " rows of values, where ",
          n_rows,
          " (nrows) was expected. The file may be cut off: fetch or make it "
          "anew.");
    check(
      (keywords.count("xllcorner") > 0 && keywords.count("yllcorner") > 0) !=
        (keywords.count("xllcenter") > 0 && keywords.count("yllcenter") > 0),
      " has no place on the map, which an Esri ASCII grid needs: either "
      "the lines 'xllcorner' and 'yllcorner', or 'xllcenter' and "
      "'yllcenter'. Correct the head.");
  }



  std::string
  shortest(const double value)
  {
    char       digits[32];
    const auto written = std::to_chars(digits, digits + sizeof(digits), value);
    return std::string(digits, written.ptr);
  }



  // GDAL writes cell sizes with 12 decimals, and two decimals more than needed
  // or too few of each value.
  void
  write_esri_grid(const std::filesystem::path &file, const Raster &raster)
  {
    write_file(file, [&](std::ostream &out) {
      out << "ncols " << raster.n_columns << "\nnrows " << raster.n_rows
          << "\nxllcorner " << shortest(raster.west) << "\nyllcorner "
          << shortest(raster.south) << '\n';
      // Some readers do not know the dialect with two sizes.
      if (raster.dx == raster.dy)
        out << "cellsize " << shortest(raster.dx) << '\n';
      else
        out << "dx " << shortest(raster.dx) << "\ndy " << shortest(raster.dy)
            << '\n';
      const std::string nodata = shortest(raster.nodata);
      out << "nodata_value " << nodata << '\n';
      for (std::size_t i = 0; i < raster.values.size(); ++i)
        out << (std::isnan(raster.values[i]) ? nodata
                                             : shortest(raster.values[i]))
            << ((i + 1) % raster.n_columns == 0 ? '\n' : ' ');
    });
  }
} // namespace talus
