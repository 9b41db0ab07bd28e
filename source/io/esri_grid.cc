// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/esri_grid.h>
#include <talus/io/files.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Line of the file, for messages.
    struct Line
    {
      const std::filesystem::path &file;
      unsigned int                 number;
      std::string                  content;

      std::string
      place() const
      {
        return text("The raster '", file.string(), "', line ", number, ": ");
      }
    };



    std::string
    lower_case(std::string_view word)
    {
      std::string result(word);
      std::transform(result.begin(),
                     result.end(),
                     result.begin(),
                     [](const unsigned char c) { return std::tolower(c); });
      return result;
    }



    /// Split a line at blanks, semicolons and the additional @p separators.
    std::vector<std::string_view>
    split(const std::string_view line, const std::string &separators)
    {
      const std::string             blanks = " \t\r;" + separators;
      std::vector<std::string_view> parts;
      for (std::size_t end = 0;;)
        {
          const std::size_t begin = line.find_first_not_of(blanks, end);
          if (begin == std::string_view::npos)
            return parts;
          end = std::min(line.find_first_of(blanks, begin), line.size());
          parts.push_back(line.substr(begin, end - begin));
        }
    }



    /// Parse a number, independently of the locale. Returns nothing for a text
    /// without a number; nan is a number.
    std::optional<double>
    number(std::string_view word)
    {
      std::string with_point(word);
      std::replace(with_point.begin(), with_point.end(), ',', '.');
      word = with_point;
      if (!word.empty() && word[0] == '+')
        word.remove_prefix(1);
      double     result = 0.;
      const auto end    = word.data() + word.size();
      const auto parsed = std::from_chars(word.data(), end, result);
      if (parsed.ec != std::errc() || parsed.ptr != end || std::isinf(result))
        return {};
      return result;
    }



    /// Numbers of the lines before the values, by keyword.
    using Header = std::map<std::string, double>;

    /// Return a common name of the keyword for all dialects; empty if unknown.
    std::string
    keyword(const std::string_view word)
    {
      static const std::map<std::string, std::string> names = {
        {"ncols", "ncols"},
        {"nrows", "nrows"},
        {"xllcorner", "xllcorner"},
        {"yllcorner", "yllcorner"},
        {"xllcenter", "xllcenter"},
        {"yllcenter", "yllcenter"},
        {"xllcentre", "xllcenter"},
        {"yllcentre", "yllcenter"},
        {"cellsize", "cellsize"},
        {"dx", "dx"},
        {"dy", "dy"},
        {"nodata_value", "nodata"},
        {"nodata", "nodata"}};
      const auto found = names.find(lower_case(word));
      return found == names.end() ? "" : found->second;
    }



    /// Add the line to the header, or return false if the line does not belong
    /// to the header. The values begin at the first line with only numbers.
    bool
    read_header_line(const Line &line, Header &header)
    {
      auto words = split(line.content, ",");
      if (!words.empty() && std::all_of(words.begin(), words.end(), [](auto w) {
            return number(w).has_value();
          }))
        return false;
      words = split(line.content, "=:");
      // A comma after the keyword is a separator, in the number a decimal
      // point.
      for (auto &word : words)
        while (!word.empty() && word.back() == ',')
          word.remove_suffix(1);
      if (words.size() == 1)
        words = split(line.content, ",");
      // Some dialects have the number first.
      if (words.size() == 2 && keyword(words[0]).empty())
        std::swap(words[0], words[1]);
      const std::string name = words.empty() ? "" : keyword(words[0]);
      const auto        value =
        words.size() == 2 ? number(words[1]) : std::optional<double>();
      AssertThrow(!name.empty() && value.has_value(),
                  ExcUser(text(line.place(),
                               "'",
                               line.content,
                               "' was found, where a keyword and a number were "
                               "expected (ncols, nrows, xllcorner, yllcorner, "
                               "xllcenter, yllcenter, cellsize, dx, dy, "
                               "nodata_value) or a row of numbers. Correct "
                               "it.")));
      AssertThrow(header.emplace(name, *value).second,
                  ExcUser(text(line.place(),
                               "the keyword '",
                               name,
                               "' is there twice. Remove one of the two.")));
      return true;
    }



    /// Return the value of the first of @p names that the header contains.
    double
    required(const std::filesystem::path    &file,
             const Header                   &header,
             const std::vector<std::string> &names)
    {
      for (const std::string &name : names)
        if (const auto found = header.find(name); found != header.end())
          return found->second;
      AssertThrow(
        false,
        ExcUser(
          text("The raster '",
               file.string(),
               "' has no line with '",
               names[0],
               "', which an Esri ASCII grid needs. Add the line, or "
               "convert the raster: gdal_translate -of AAIGrid IN OUT.asc.")));
      return 0.;
    }



    unsigned int
    count(const std::filesystem::path &file,
          const Header                &header,
          const std::string           &name)
    {
      const double n = required(file, header, {name});
      AssertThrow(n >= 1. && n == std::floor(n) && n < 1e6,
                  ExcUser(text("The raster '",
                               file.string(),
                               "' has ",
                               name,
                               " = ",
                               n,
                               ", where a whole number from 1 to a million was "
                               "expected. Correct it.")));
      return static_cast<unsigned int>(n);
    }



    /// Coordinate of the western or southern edge of the raster: as given, or
    /// half a cell before the centre of the first cell.
    double
    edge(const std::filesystem::path &file,
         const Header                &header,
         const std::string           &axis,
         const double                 cell)
    {
      const auto centre = header.find(axis + "llcenter");
      if (centre != header.end())
        return centre->second - 0.5 * cell;
      return required(file, header, {axis + "llcorner"});
    }



    double
    cell_size(const std::filesystem::path &file,
              const Header                &header,
              const std::string           &name)
    {
      const double size = required(file, header, {name, "cellsize"});
      AssertThrow(size > 0.,
                  ExcUser(text("The raster '",
                               file.string(),
                               "' has cells of ",
                               size,
                               ", where a positive size was expected. Correct "
                               "it.")));
      return size;
    }



    /// Build the raster without values.
    Raster
    georeference(const std::filesystem::path &file, const Header &header)
    {
      Raster raster;
      raster.n_columns = count(file, header, "ncols");
      raster.n_rows    = count(file, header, "nrows");
      raster.dx        = cell_size(file, header, "dx");
      raster.dy        = cell_size(file, header, "dy");
      raster.west      = edge(file, header, "x", raster.dx);
      raster.south     = edge(file, header, "y", raster.dy);
      if (const auto found = header.find("nodata"); found != header.end())
        raster.nodata = found->second;
      return raster;
    }



    /// Read row number @p row of the raster @p whole, and append the values of
    /// cells in @p part. Commas are decimal points if blanks separate as many
    /// entries as there are columns, otherwise separators.
    void
    read_row(const Line       &line,
             const std::size_t row,
             const Raster     &whole,
             Raster           &part)
    {
      auto words = split(line.content, "");
      if (words.size() != whole.n_columns ||
          std::any_of(words.begin(), words.end(), [](const auto word) {
            return word.back() == ',';
          }))
        words = split(line.content, ",");
      AssertThrow(words.size() == whole.n_columns,
                  ExcUser(text(line.place(),
                               "row ",
                               row + 1,
                               " has ",
                               words.size(),
                               " values, but ncols is ",
                               whole.n_columns,
                               ". Give one line for each row, with one value "
                               "for each column.")));
      AssertThrow(row < whole.n_rows,
                  ExcUser(text(line.place(),
                               "there is one more row of values, but nrows is ",
                               whole.n_rows,
                               ". Correct nrows or remove the row.")));
      const double y = whole.y(row);
      if (y < part.south || y > part.north())
        return;
      const std::size_t first =
        std::lround((part.west - whole.west) / whole.dx);
      for (std::size_t c = first; c < first + part.n_columns; ++c)
        {
          const auto value = number(words[c]);
          AssertThrow(value.has_value(),
                      ExcUser(text(line.place(),
                                   "'",
                                   words[c],
                                   "' was found in column ",
                                   c + 1,
                                   ", where a number was expected. Correct "
                                   "it.")));
          // A GIS keeps the mark in single precision, and writes 15 digits of
          // the mark in the head and 17 in the rows.
          part.values.push_back(float(*value) == float(part.nodata)
                                  ? std::numeric_limits<double>::quiet_NaN()
                                  : *value);
        }
    }
  } // namespace



  bool
  is_esri_grid(const std::filesystem::path &file)
  {
    // A device may have no end, and opening a pipe waits for a writer.
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error))
      return false;
    std::ifstream in(file, std::ios::binary);
    std::string   head(1024, '\0');
    in.read(head.data(), head.size());
    head.resize(in.gcount());
    const std::string no_words = "\xef\xbb\xbf \t\r\n"; // with UTF-8's mark
    const std::size_t begin    = head.find_first_not_of(no_words);
    if (begin == std::string::npos)
      return false;
    const auto words =
      split(std::string_view(head).substr(begin,
                                          head.find('\n', begin) - begin),
            "=:,");
    return std::any_of(words.begin(),
                       words.begin() + std::min<std::size_t>(2, words.size()),
                       [](const std::string_view word) {
                         return !keyword(word).empty();
                       });
  }



  // Line by line, not number by number: a missing value in a row must not shift
  // all later values, since the total number may be right by accident.
  Raster
  read_esri_grid(const std::filesystem::path &file, const RasterPart &part)
  {
    std::ifstream in(file, std::ios::binary);
    Line          line{file, 0, ""};
    Header        header;
    Raster        whole, result;
    std::size_t   n_rows = 0;
    while (std::getline(in, line.content))
      {
        ++line.number;
        if (line.number == 1 && line.content.rfind("\xef\xbb\xbf", 0) == 0)
          line.content.erase(0, 3); // byte order mark of UTF-8
        if (line.content.find_first_not_of(" \t\r") == std::string::npos)
          continue;
        if (whole.n_columns == 0)
          {
            if (read_header_line(line, header))
              continue;
            whole  = georeference(file, header);
            result = part(whole);
          }
        read_row(line, n_rows++, whole, result);
      }
    AssertThrow(n_rows > 0 && n_rows == whole.n_rows,
                ExcUser(text("The raster '",
                             file.string(),
                             "' has ",
                             n_rows,
                             " rows of values, where ",
                             whole.n_columns == 0
                               ? "an Esri ASCII grid"
                               : text(whole.n_rows, " (nrows)"),
                             " was expected. The file may be cut off: fetch "
                             "or make it anew.")));
    return result;
  }



  std::string
  shortest(const double value)
  {
    char       digits[32];
    const auto written = std::to_chars(digits, digits + sizeof(digits), value);
    return std::string(digits, written.ptr);
  }



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
      for (unsigned int r = 0; r < raster.n_rows; ++r)
        for (unsigned int c = 0; c < raster.n_columns; ++c)
          {
            const double value = raster.value(c, r);
            out << (std::isnan(value) ? nodata : shortest(value))
                << (c + 1 < raster.n_columns ? ' ' : '\n');
          }
    });
  }
} // namespace talus
