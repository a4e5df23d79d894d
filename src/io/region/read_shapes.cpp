#include "io/region/read_shapes.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "io/read_file.h"
#include "io/region/gpkg.h"
#include "io/region/grid_map.h"
#include "io/source.h"

namespace dymsum {

// What leads from a path to shapes: format by extension, selection by "#", and the readers behind it.

namespace {

using io::extension;
using io::file_error;

struct Selection {
  std::string file;
  std::optional<std::string> shape;
};

/// "a.json#3" is shape 3 of a.json, unless there is a file of that very name.
Selection split_selection(const std::string& path) {
  std::string file = file_of_shape(path);
  if (file == path) return {std::move(file), std::nullopt};
  std::string shape = path.substr(file.size() + 1);
  return {std::move(file), std::move(shape)};
}

std::optional<RegionFormat> format_of_extension(std::string_view path) {
  const std::string text = extension(path);
  if (text == ".poly") return RegionFormat::poly;
  if (text == ".wkt") return RegionFormat::wkt;
  if (text == ".geojson") return RegionFormat::geojson;
  if (text == ".svg") return RegionFormat::svg;
  if (text == ".json") return RegionFormat::json;
  if (text == ".dxf") return RegionFormat::dxf;
  if (text == ".gpkg") return RegionFormat::gpkg;
  return std::nullopt;
}

/// The formats begin with different characters, but for .dxf: with the group of a section or of a comment.
Result<RegionFormat> format_of_text(std::string_view text, std::string_view file) {
  const std::size_t start = text.find_first_not_of(" \t\r\n\v\f\xEF\xBB\xBF");
  const char first = start == std::string_view::npos ? '\0' : text[start];
  if (first == '{') return RegionFormat::json;
  if (first == '<') return RegionFormat::svg;
  if (io::is_sqlite(text)) return RegionFormat::gpkg;
  if (begins_like_dxf(text)) return RegionFormat::dxf;
  if (first == '#' || io::is_digit(first)) return RegionFormat::poly;
  if (io::is_letter(first)) return RegionFormat::wkt;
  return file_error(ErrorCode::unsupported_format,
                    "the text begins like none of .poly, .wkt, .geojson, .svg, .json, .dxf, .gpkg", file);
}

std::vector<NamedShape> read_format(const io::Source& source, RegionFormat format) {
  switch (format) {
    case RegionFormat::poly:
      return io::read_poly(source);
    case RegionFormat::wkt:
      return io::read_wkt(source);
    case RegionFormat::svg:
      return io::read_svg(source);
    case RegionFormat::dxf:
      return io::read_dxf(source);
    case RegionFormat::gpkg:
      return io::read_gpkg(source);
    case RegionFormat::geojson:
    case RegionFormat::json:
      break;
  }
  return io::read_json(source);
}

std::string stem(std::string_view file) {
  const std::size_t slash = file.rfind('/');
  if (slash != std::string_view::npos) file.remove_prefix(slash + 1);
  const std::size_t dot = file.rfind('.');
  return std::string(dot == std::string_view::npos || dot == 0 ? file : file.substr(0, dot));
}

/// A shape without a name is called after its position, or after the file when it is the only one.
void name_shapes(std::vector<NamedShape>& shapes, std::string_view file) {
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (shapes[i].name.empty()) shapes[i].name = shapes.size() == 1 ? stem(file) : std::to_string(i);
  }
}

/// Selects by name, else by position.
Result<NamedShape> select(std::vector<NamedShape> shapes, const std::string& wanted, const std::string& file) {
  const auto named = [&](const NamedShape& shape) { return shape.name == wanted; };
  const auto count = std::count_if(shapes.begin(), shapes.end(), named);
  if (count > 1)
    return file_error(ErrorCode::malformed, std::to_string(count) + " shapes are named " + io::in_quotes(wanted), file);
  if (count == 1) return std::move(*std::find_if(shapes.begin(), shapes.end(), named));
  const io::ScannedCount position = io::scan_count(wanted);
  if (position.length > 0 && position.length == wanted.size() && position.value < shapes.size())
    return std::move(shapes[position.value]);
  return file_error(ErrorCode::malformed,
                    "no shape " + io::in_quotes(wanted) + " among " + std::to_string(shapes.size()), file);
}

/// A map is one shape: the set of cells that is selected.
Result<std::vector<NamedShape>> read_map(const Selection& selection) {
  const Result<std::string> text = io::read_file(selection.file);
  if (!text) return text.error();
  try {
    const io::PlainText plain(*text);
    const io::Source source{plain.view(), selection.file};
    const std::string set = selection.shape.value_or("");
    const io::GridSet cells = io::grid_set(source, set);
    const io::GridMap map = extension(selection.file) == ".map" ? io::read_movingai(source) : io::read_ros_map(source);
    return std::vector<NamedShape>{{set.empty() ? stem(selection.file) : set, io::grid_region(map, cells)}};
  } catch (io::ReadFailure& failure) {
    return std::move(failure.error);
  }
}

/// Of a GeoPackage only what is selected is read.
Result<std::vector<NamedShape>> read_database(std::string_view bytes, const Selection& selection,
                                              const ReadOptions& options) {
  if (std::optional<Error> error = io::unfinished_database(selection.file, bytes)) return *std::move(error);
  try {
    return io::read_gpkg({bytes, selection.file, options}, selection.shape);
  } catch (io::ReadFailure& failure) {
    return std::move(failure.error);
  }
}

/// The file holds several shapes, and none is selected.
Error error_of_several(const std::vector<NamedShape>& shapes, const std::string& path, bool database) {
  std::string message =
      "the file holds " + std::to_string(shapes.size()) + " shapes: select one as in " + path + "#" + shapes[0].name;
  if (database)
    message += ", or all of a layer as in " + path + "#" + shapes[0].name.substr(0, shapes[0].name.rfind('/')) +
               "; its layers, with their rows: " + io::layers_of(shapes);
  return file_error(ErrorCode::malformed, message, path);
}

}  // namespace

Result<RegionFormat> region_format(std::string_view path) {
  std::optional<RegionFormat> format = format_of_extension(path);
  for (std::size_t mark = path.rfind('#'); !format && mark != std::string_view::npos && mark > 0;) {
    format = format_of_extension(path.substr(0, mark));  // "#" may be in the name of a shape, too
    mark = path.rfind('#', mark - 1);
  }
  if (!format)
    return file_error(ErrorCode::unsupported_format,
                      "the extension is none of .poly, .wkt, .geojson, .svg, .json, .dxf, .gpkg", path);
  if (*format == RegionFormat::gpkg && !io::has_geopackage())
    return file_error(ErrorCode::unsupported_format,
                      "GeoPackages are read and written by SQLite, which this dymsum was compiled without", path);
  return *format;
}

Result<std::vector<NamedShape>> parse_shapes(std::string_view text, RegionFormat format,
                                             std::string_view name_for_errors, const ReadOptions& options) {
  const io::PlainText plain(text, format == RegionFormat::gpkg ? 0 : text.size());
  try {
    std::vector<NamedShape> shapes = read_format({plain.view(), name_for_errors, options}, format);
    name_shapes(shapes, name_for_errors);
    return shapes;
  } catch (io::ReadFailure& failure) {
    return std::move(failure.error);
  }
}

std::string file_of_shape(const std::string& path) {
  const auto exists = [](const std::string& file) {
    std::error_code ignored;
    return file == "-" || std::filesystem::exists(file, ignored);
  };
  if (path.find('#') == std::string::npos || exists(path)) return path;
  for (std::size_t mark = path.rfind('#'); mark != std::string::npos && mark > 0; mark = path.rfind('#', mark - 1))
    if (std::string file = path.substr(0, mark); exists(file)) return file;
  return path.substr(0, path.rfind('#'));
}

bool names_region(const std::string& path) {
  const std::string file = split_selection(path).file;
  return io::names_map(file) || format_of_extension(file);
}

Result<std::vector<NamedShape>> read_shapes(const std::string& path, const ReadOptions& options) {
  const Selection selection = split_selection(path);
  if (io::names_map(selection.file)) return read_map(selection);
  const std::optional<RegionFormat> known = format_of_extension(selection.file);
  if (selection.file != "-" && !known && !io::is_directory(selection.file))
    return file_error(ErrorCode::unsupported_format,
                      "the extension is none of .poly, .wkt, .geojson, .svg, .json, .dxf, .gpkg, .yaml, .map",
                      selection.file);
  const Result<std::string> text = io::read_file(selection.file);
  if (!text) return text.error();
  const Result<RegionFormat> format = known ? Result<RegionFormat>(*known) : format_of_text(*text, selection.file);
  if (!format) return format.error();
  Result<std::vector<NamedShape>> shapes = *format == RegionFormat::gpkg
                                               ? read_database(*text, selection, options)
                                               : parse_shapes(*text, *format, selection.file, options);
  if (!shapes || !selection.shape) return shapes;
  Result<NamedShape> shape = select(std::move(shapes).value(), *selection.shape, selection.file);
  if (!shape) return shape.error();
  return std::vector<NamedShape>{std::move(shape).value()};
}

Result<RegionData> read_region_data(const std::string& path, const ReadOptions& options) {
  Result<NamedShape> shape = read_shape(path, options);
  if (!shape) return shape.error();
  return std::move(shape).value().data;
}

Result<NamedShape> read_shape(const std::string& path, const ReadOptions& options) {
  Result<std::vector<NamedShape>> read = read_shapes(path, options);
  if (!read) return read.error();
  std::vector<NamedShape> shapes = std::move(read).value();
  if (shapes.size() == 1) return std::move(shapes[0]);
  if (shapes.empty()) return file_error(ErrorCode::malformed, "the file holds no shape", path);
  return error_of_several(shapes, path, format_of_extension(path) == RegionFormat::gpkg);
}

}  // namespace dymsum
