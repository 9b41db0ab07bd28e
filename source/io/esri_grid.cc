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
#include <map>
#include <set>
#include <sstream>
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


    /// Text of an Esri ASCII grid, line by line. Each function throws ExcUser.
    class EsriText
    {
    public:
      EsriText(const std::string &file,
               const unsigned int n_columns,
               const unsigned int n_rows)
        : name_("The raster '" + file + "'")
        , n_columns_(n_columns)
        , n_rows_(n_rows)
      {}

      /// Check the next line. Like GDAL, take the lines before the first one
      /// without a letter for the head.
      void
      check_line(std::string &line)
      {
        ++line_;
        if (line_ == 1 && line.rfind("\xef\xbb\xbf", 0) == 0)
          line.erase(0, 3); // byte order mark of UTF-8
        const auto words = words_of(line);
        if (words.empty())
          return;
        if (row_ == 0 && std::isalpha(static_cast<unsigned char>(line[0])))
          check_head(line, words);
        else
          check_row(words);
      }

      void
      check_end() const
      {
        check(row_ == n_rows_,
              " has ",
              row_,
              " rows of values, where ",
              n_rows_,
              " (nrows) was expected. The file may be cut off: fetch or make "
              "it anew.");
        const auto has = [this](const std::string &place) {
          return keywords_.count("xll" + place) +
                 keywords_.count("yll" + place);
        };
        check(
          has("corner") + has("center") == 2 && has("corner") != 1,
          " has no place on the map, which an Esri ASCII grid needs: either "
          "the lines 'xllcorner' and 'yllcorner', or 'xllcenter' and "
          "'yllcenter'. Correct the head.");
      }

    private:
      template <typename... Words>
      void
      check(const bool success, const Words &...words) const
      {
        AssertThrow(success, ExcUser(text(name_, words...)));
      }

      void
      check_head(const std::string                   &line,
                 const std::vector<std::string_view> &words)
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
        const auto keyword = boost::to_lower_copy(std::string(words[0]));
        check(words.size() == 2 && known.count(keyword) > 0 &&
                is_number(words[1]) && keywords_.insert(keyword).second,
              ", line ",
              line_,
              ": '",
              line.substr(0, 60),
              "' was found, where a keyword (ncols, nrows, xllcorner, "
              "yllcorner, xllcenter, yllcenter, cellsize, dx, dy, "
              "nodata_value; each once) and a number were expected, or a row "
              "that begins with digits. Correct it.");
      }

      void
      check_row(const std::vector<std::string_view> &words)
      {
        check(++row_ <= n_rows_,
              ", line ",
              line_,
              ": there is one more row of values, but nrows is ",
              n_rows_,
              ". Correct nrows or remove the row.");
        check(words.size() == n_columns_,
              ", line ",
              line_,
              ": row ",
              row_,
              " has ",
              words.size(),
              " values, but ncols is ",
              n_columns_,
              ". Give one line for each row, with one value for each column, "
              "separated by blanks.");
        for (std::size_t c = 0; c < words.size(); ++c)
          check(is_number(words[c]),
                ", line ",
                line_,
                ": '",
                words[c],
                "' was found in column ",
                c + 1,
                ", where a number was expected. Correct it.");
      }

      const std::string     name_;
      const unsigned int    n_columns_, n_rows_;
      std::set<std::string> keywords_;
      unsigned int          line_ = 0, row_ = 0; ///< checked so far
    };
  } // namespace



  // GDAL takes a text that is no number for 0, and reads numbers without regard
  // to lines: a missing number would shift all later ones.
  void
  check_esri_grid(std::istream      &in,
                  const std::string &file,
                  const unsigned int n_columns,
                  const unsigned int n_rows)
  {
    EsriText content(file, n_columns, n_rows);
    for (std::string line; std::getline(in, line);)
      content.check_line(line);
    content.check_end();
  }



  std::string
  geoclaw_as_esri_grid(const std::filesystem::path &file)
  {
    static const std::map<std::string, std::string> keywords = {
      {"mx", "ncols"},
      {"my", "nrows"},
      {"xlower", "xllcenter"},
      {"ylower", "yllcenter"},
      {"nodatavalue", "nodata_value"}};
    std::ifstream in(file, std::ios::binary);
    std::string   line, head;
    while (std::getline(in, line))
      {
        std::istringstream words(line);
        std::string        number, keyword, dy;
        if (!(words >> number >> keyword) || !is_number(number))
          break;
        if (is_number(keyword)) // dx, dy and the word cellsize
          {
            dy = keyword;
            words >> keyword;
          }
        if (!std::isalpha(keyword[0]))
          break;
        boost::to_lower(keyword);
        const auto known = keywords.find(keyword);
        head += dy.empty()
                  ? (known == keywords.end() ? keyword : known->second) + " " +
                      number + "\n"
                  : "dx " + number + "\ndy " + dy + "\n";
      }
    if (head.empty())
      return head;
    std::ostringstream rest;
    rest << in.rdbuf();
    return head + line + "\n" + rest.str();
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
