// GeoPackage: what its layers hold, by SQLite. A layer is a row of gpkg_contents and of gpkg_geometry_columns, which
// name a table or a view and its column of geometries. A geometry is a header, which is checked, and WKB.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>

#include "io/bytes.h"
#include "io/read_file.h"
#include "io/region/database.h"
#include "io/region/gpkg.h"
#include "io/region/read_wkb.h"

namespace dymsum::io {

namespace {

/// The WKB of a geometry in a GeoPackage, after its header: "GP", a version, flags, a coordinate system, a box.
std::string_view wkb_of(std::string_view blob) {
  constexpr std::size_t kFixed = 8;
  constexpr std::size_t kBoxes[] = {0, 32, 48, 48, 64};  // bytes of each kind of box
  if (blob.size() < kFixed)
    throw WkbFailure{ErrorCode::truncated,
                     "the geometry has " + std::to_string(blob.size()) + " bytes, and its header 8"};
  if (!blob.starts_with("GP")) throw WkbFailure{ErrorCode::malformed, "the geometry does not begin with GP"};
  if (blob[2] != 0)
    throw WkbFailure{ErrorCode::malformed, "the geometry has the version " +
                                               std::to_string(static_cast<unsigned char>(blob[2])) +
                                               " of its format, and 0 is known"};
  const auto flags = static_cast<unsigned char>(blob[3]);
  if ((flags & 0x20) != 0) throw WkbFailure{ErrorCode::malformed, "the geometry is of an extension of GeoPackage"};
  const unsigned box = flags >> 1 & 7;
  if (box >= std::size(kBoxes))
    throw WkbFailure{ErrorCode::malformed,
                     "the box of the geometry is of the kind " + std::to_string(box) + ", and 0 to 4 are known"};
  if (blob.size() < kFixed + kBoxes[box])
    throw WkbFailure{ErrorCode::truncated, "the geometry ends before its box does"};
  return blob.substr(kFixed + kBoxes[box]);
}

/// Names for a message, which lists the first of them: they are a stranger's.
class NameList {
 public:
  void add(const std::string& name, const std::string& note = "") {
    constexpr std::size_t kMost = 20, kLongest = 64;
    if (++count_ > kMost) return;
    if (count_ > 1) text_ += ", ";
    for (const char c : name.substr(0, kLongest)) text_ += static_cast<unsigned char>(c) < ' ' || c == 127 ? '?' : c;
    text_ += note;
    listed_ = count_;
  }
  std::string text() const {
    return count_ == listed_ ? text_ : text_ + " and " + std::to_string(count_ - listed_) + " more";
  }

 private:
  std::string text_;
  std::size_t count_ = 0, listed_ = 0;
};

class GpkgReader {
 public:
  GpkgReader(const Source& source, const std::optional<std::string>& selected)
      : source_(source), selected_(selected), database_(source.text) {}

  std::vector<NamedShape> read() {
    const std::vector<Layer> layers = read_layers();
    const auto there = [&](const Layer& layer) -> const Layer& {
      if (layer.kind == Layer::Kind::missing)
        fail("the layer " + in_quotes(layer.table) + " names a table that is not there");
      return layer;
    };
    if (selected_) {
      for (const Layer& layer : layers)
        if (layer.table == *selected_) return {merged(there(layer))};
      const Layer* longest = nullptr;  // of "a" and "a/b", for "a/b/3"
      for (const Layer& layer : layers)
        if (selected_->starts_with(layer.table + "/") && (!longest || layer.table.size() > longest->table.size()))
          longest = &layer;
      if (longest) return {row_of(there(*longest))};
      if (selected_->find_first_not_of("0123456789") != std::string::npos || selected_->empty())
        fail("no layer " + in_quotes(*selected_) + ": there are " + names_of_all(layers));
    }
    // A registered layer without a table, as deleting tables leaves it, has no rows; alone it is a fault.
    const auto missing = [](const Layer& layer) { return layer.kind == Layer::Kind::missing; };
    if (std::all_of(layers.begin(), layers.end(), missing)) there(layers.front());
    std::vector<NamedShape> shapes;
    for (const Layer& layer : layers)
      if (!missing(layer))
        for (NamedShape& shape : rows_of(layer)) shapes.push_back(std::move(shape));
    return shapes;
  }

 private:
  struct Layer {
    enum class Kind { table, view, missing };
    std::string table, column;
    Kind kind = Kind::table;
  };
  using Geometry = std::optional<std::string_view>;  ///< nothing in a row without one

  [[noreturn]] void fail(const std::string& message, ErrorCode code = ErrorCode::malformed) const {
    source_.fail_in_bytes(code, message);
  }

  std::vector<Layer> read_layers() {
    Query tables(database_,
                 "SELECT count(*) FROM sqlite_master WHERE name IN ('gpkg_contents', 'gpkg_geometry_columns')");
    if (!tables.next() || tables.integer(0) < 2)
      fail("a database without the tables gpkg_contents and gpkg_geometry_columns is no GeoPackage with layers");
    Query query(database_,
                "SELECT g.table_name, g.column_name, s.type FROM gpkg_geometry_columns AS g JOIN gpkg_contents AS c ON "
                "lower(c.table_name) = lower(g.table_name) LEFT JOIN sqlite_master AS s ON lower(s.name) = "
                "lower(g.table_name) AND s.type IN ('table', 'view') WHERE c.data_type = 'features' ORDER BY "
                "g.table_name");
    std::vector<Layer> layers;
    while (query.next()) {
      const auto kind = query.is_null(2)          ? Layer::Kind::missing
                        : query.text(2) == "view" ? Layer::Kind::view
                                                  : Layer::Kind::table;
      layers.push_back({query.text(0), query.text(1), kind});
    }
    if (layers.empty()) fail("the file has no layer of geometries");
    return layers;
  }

  static std::string names_of_all(const std::vector<Layer>& layers) {
    NameList names;
    for (const Layer& layer : layers)
      names.add(layer.table, layer.kind == Layer::Kind::missing ? " (whose table is not there)" : "");
    return names.text();
  }

  /// Views and tables WITHOUT ROWID number no rows.
  bool numbers_rows(const Layer& layer) {
    if (layer.kind == Layer::Kind::view) return false;
    try {
      Query(database_, "SELECT rowid FROM " + quoted_name(layer.table) + " LIMIT 0");
      return true;
    } catch (const DatabaseFailure&) {
      return false;  // the query of its rows reports anything else that is wrong with the table
    }
  }

  /// Calls visit(row, geometry) for the rows of a layer: by their numbers, or counted from 1 where they have none. What
  /// is wrong is said with layer and row.
  template <class Visit>
  void each_row(const Layer& layer, Visit visit) {
    const std::string geometry = "t." + quoted_name(layer.column), table = quoted_name(layer.table);
    const bool numbered = numbers_rows(layer);
    Query query(database_, numbered ? "SELECT t.rowid, " + geometry + " FROM " + table + " AS t ORDER BY t.rowid"
                                    : "SELECT NULL, " + geometry + " FROM " + table + " AS t");
    for (std::int64_t count = 1; query.next(); ++count) {
      const std::string row = std::to_string(numbered ? query.integer(0) : count);
      try {
        if (!query.is_null(1) && !query.is_blob(1)) throw WkbFailure{ErrorCode::malformed, "the geometry is no blob"};
        visit(row, query.is_null(1) ? std::nullopt : std::optional(query.blob(1)));
      } catch (const WkbFailure& failure) {
        fail("layer " + in_quotes(layer.table) + ", row " + row + ": " + failure.message, failure.code);
      }
    }
  }

  void add(NamedShape& shape, const Geometry& blob) {
    if (!blob) return;  // a row without geometry
    // Views may show a row several times, and broken databases do.
    constexpr std::uint64_t kMostCopies = 16;
    bytes_read_ += blob->size();
    if (bytes_read_ / kMostCopies > source_.text.size())
      throw WkbFailure{ErrorCode::malformed, "the geometries are larger than the file that they are in"};
    read_wkb(wkb_of(*blob), source_.options, shape);
  }

  std::vector<NamedShape> rows_of(const Layer& layer) {
    std::vector<NamedShape> shapes;
    each_row(layer, [&](const std::string& row, const Geometry& blob) {
      shapes.push_back({layer.table + "/" + row, {}});
      add(shapes.back(), blob);
    });
    return shapes;
  }

  NamedShape merged(const Layer& layer) {
    NamedShape shape{layer.table, {}};
    each_row(layer, [&](const std::string&, const Geometry& blob) { add(shape, blob); });
    return shape;
  }

  NamedShape row_of(const Layer& layer) {
    NamedShape shape{*selected_, {}};
    const std::string wanted = selected_->substr(layer.table.size() + 1);
    bool found = false;
    each_row(layer, [&](const std::string& row, const Geometry& blob) {
      if (row != wanted) return;
      found = true;
      add(shape, blob);
    });
    if (!found) fail("the layer " + in_quotes(layer.table) + " has no row " + in_quotes(wanted));
    return shape;
  }

  const Source& source_;
  const std::optional<std::string>& selected_;
  Database database_;
  std::uint64_t bytes_read_ = 0;
};

/// The pages that the header announces are there.
void require_whole(const Source& source) {
  constexpr std::size_t kHeader = 100;
  const std::string_view bytes = source.text;
  if (!is_sqlite(bytes))
    source.fail_in_bytes(bytes.empty() ? ErrorCode::truncated : ErrorCode::malformed,
                         "a .gpkg file is an SQLite database, and this is none");
  if (bytes.size() < kHeader) source.fail_in_bytes(ErrorCode::truncated, "the file ends in the header of its database");
  const auto number = [&](std::size_t at) { return from_bytes<std::uint32_t>(bytes, at, std::endian::big); };
  const std::uint64_t size = from_bytes<std::uint16_t>(bytes, 16, std::endian::big), page = size == 1 ? 65536 : size;
  const bool counted = number(24) == number(92);  // else the count of pages is not kept
  if (counted && number(28) * page > bytes.size())
    source.fail_in_bytes(ErrorCode::truncated, "the file has " + std::to_string(bytes.size()) +
                                                   " bytes, and its header announces " +
                                                   std::to_string(number(28) * page));
}

}  // namespace

bool has_geopackage() { return true; }

std::vector<NamedShape> read_gpkg(const Source& source, const std::optional<std::string>& selected) try {
  require_whole(source);
  return GpkgReader(source, selected).read();
} catch (const DatabaseFailure& failure) {
  source.fail_in_bytes(ErrorCode::malformed, "the database cannot be read: " + failure.message);
}

std::string layers_of(const std::vector<NamedShape>& shapes) {
  NameList names;
  for (std::size_t i = 0, end = 0; i < shapes.size(); i = end) {
    const auto layer = [&](std::size_t k) { return shapes[k].name.substr(0, shapes[k].name.rfind('/')); };
    for (end = i; end < shapes.size() && layer(end) == layer(i);) ++end;
    names.add(layer(i), " (" + std::to_string(end - i) + ")");
  }
  return names.text();
}

std::optional<Error> unfinished_database(const std::string& path, std::string_view bytes) {
  if (!is_sqlite(bytes)) return std::nullopt;
  for (const char* more : {"-wal", "-journal"}) {
    std::error_code none;
    const auto size = std::filesystem::file_size(path + more, none);
    if (!none && size > 0)
      return file_error(ErrorCode::cannot_open,
                        "another program has not finished writing it, and " + path + more +
                            " holds changes: close that program, or run sqlite3 FILE 'PRAGMA wal_checkpoint(TRUNCATE)'",
                        path);
  }
  return std::nullopt;
}

}  // namespace dymsum::io
