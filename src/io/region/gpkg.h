// GeoPackages: databases of layers, which are tables with a column of geometries.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/region_io.h"
#include "io/source.h"

namespace dymsum::io {

/// Whether this library was compiled with SQLite, which reads and writes them.
bool has_geopackage();

inline bool is_sqlite(std::string_view bytes) { return bytes.starts_with(std::string_view("SQLite format 3\0", 16)); }

/// The rows of all layers, each a shape named "layer/row" by the number that the row has there, in the order of the
/// layers' names and of these numbers; a row without geometry is an empty shape. Where a layer or a row is selected,
/// only that is read: all of a layer is one shape. Digits alone are left to the caller, where they name no layer.
std::vector<NamedShape> read_gpkg(const Source& source, const std::optional<std::string>& selected = std::nullopt);

/// "roads (12), towns (300)": the layers of shapes that read_gpkg named, with the number of their rows.
std::string layers_of(const std::vector<NamedShape>& shapes);

/// What a database has in a second file beside it, of changes that are not in its own yet: the error that says so.
std::optional<Error> unfinished_database(const std::string& path, std::string_view bytes);

/// The bytes of a GeoPackage 1.2 with one layer "region" of one row, coordinates bit for bit (+0 for both zeros),
/// without a coordinate system: those of the plane. Requires: has_geopackage(), less than 10^9 bytes.
std::string write_gpkg(const RegionData& data);

}  // namespace dymsum::io
