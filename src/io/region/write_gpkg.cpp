// GeoPackage 1.2, https://www.geopackage.org/spec120: the tables that it requires, and one layer.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>

#include "io/bytes.h"
#include "io/region/database.h"
#include "io/region/gpkg.h"
#include "io/region/write_wkb.h"

namespace dymsum::io {

namespace {

constexpr std::int32_t kPlane = -1;  ///< the coordinate system without one: undefined, Cartesian

// Pages of one size, and a date that is the same always: equal regions are equal files. The application is "GPKG".
constexpr const char* kTables = R"(
PRAGMA page_size = 4096;
PRAGMA application_id = 0x47504B47;
PRAGMA user_version = 10200;
CREATE TABLE gpkg_spatial_ref_sys (srs_name TEXT NOT NULL, srs_id INTEGER NOT NULL PRIMARY KEY,
  organization TEXT NOT NULL, organization_coordsys_id INTEGER NOT NULL, definition TEXT NOT NULL, description TEXT);
INSERT INTO gpkg_spatial_ref_sys VALUES
  ('Undefined Cartesian', -1, 'NONE', -1, 'undefined', 'undefined Cartesian coordinate reference system'),
  ('Undefined geographic', 0, 'NONE', 0, 'undefined', 'undefined geographic coordinate reference system'),
  ('WGS 84 geodetic', 4326, 'EPSG', 4326, 'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,AUTHORITY["EPSG","7030"]],AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]],AUTHORITY["EPSG","4326"]]', 'longitude and latitude in degrees');
CREATE TABLE gpkg_contents (table_name TEXT NOT NULL PRIMARY KEY, data_type TEXT NOT NULL, identifier TEXT UNIQUE,
  description TEXT DEFAULT '', last_change DATETIME NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')),
  min_x DOUBLE, min_y DOUBLE, max_x DOUBLE, max_y DOUBLE, srs_id INTEGER,
  CONSTRAINT fk_gc_r_srs_id FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys(srs_id));
CREATE TABLE gpkg_geometry_columns (table_name TEXT NOT NULL, column_name TEXT NOT NULL,
  geometry_type_name TEXT NOT NULL, srs_id INTEGER NOT NULL, z TINYINT NOT NULL, m TINYINT NOT NULL,
  CONSTRAINT pk_geom_cols PRIMARY KEY (table_name, column_name), CONSTRAINT uk_gc_table_name UNIQUE (table_name),
  CONSTRAINT fk_gc_tn FOREIGN KEY (table_name) REFERENCES gpkg_contents(table_name),
  CONSTRAINT fk_gc_srs FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys (srs_id));
CREATE TABLE region (fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, geom GEOMETRY);
)";

struct Box {
  double min_x = std::numeric_limits<double>::infinity(), min_y = min_x, max_x = -min_x, max_y = -min_x;

  void add(const std::vector<Point>& points) {
    for (const Point p : points) {
      min_x = std::min(min_x, p.x);
      min_y = std::min(min_y, p.y);
      max_x = std::max(max_x, p.x);
      max_y = std::max(max_y, p.y);
    }
  }
};

/// Nothing of an empty region.
std::optional<Box> box_of(const RegionData& data) {
  Box box;
  for (const Part& part : data.parts) box.add(part.outer);
  for (const Polyline& line : data.polylines) box.add(line);
  box.add(data.points);
  if (box.min_x > box.max_x) return std::nullopt;
  return box;
}

/// What append_wkb makes of it.
std::string geometry_type(const RegionData& data) {
  const auto of = [](std::size_t count, const char* kind) { return (count > 1 ? "MULTI" : "") + std::string(kind); };
  if (data.polylines.empty() && data.points.empty() && !data.parts.empty()) return of(data.parts.size(), "POLYGON");
  if (data.parts.empty() && data.points.empty() && !data.polylines.empty())
    return of(data.polylines.size(), "LINESTRING");
  if (data.parts.empty() && data.polylines.empty() && !data.points.empty()) return of(data.points.size(), "POINT");
  return "GEOMETRYCOLLECTION";
}

std::string geometry_blob(const RegionData& data, const std::optional<Box>& box) {
  constexpr unsigned char kLittleEndian = 1, kBoxOfPlane = 2, kEmpty = 16;
  std::string blob = "GP";
  append_bytes(blob, std::uint8_t{0});  // the version
  append_bytes(blob, static_cast<std::uint8_t>(kLittleEndian | (box ? kBoxOfPlane : kEmpty)));
  append_bytes(blob, kPlane);
  if (box)
    for (const double side : {box->min_x, box->max_x, box->min_y, box->max_y}) append_bytes(blob, side + 0.0);
  append_wkb(blob, data);
  return blob;
}

void fill_tables(Database& database, const RegionData& data) {
  const std::optional<Box> box = box_of(data);
  const auto side = [&](double Box::*of) { return box ? std::optional((*box).*of + 0.0) : std::nullopt; };
  Query(database,
        "INSERT INTO gpkg_contents VALUES ('region', 'features', 'region', '', '1970-01-01T00:00:00.000Z', ?, ?, ?, ?, "
        "-1)")
      .bind_number(1, side(&Box::min_x))
      .bind_number(2, side(&Box::min_y))
      .bind_number(3, side(&Box::max_x))
      .bind_number(4, side(&Box::max_y))
      .next();
  const std::string type = geometry_type(data), blob = geometry_blob(data, box);
  Query(database, "INSERT INTO gpkg_geometry_columns VALUES ('region', 'geom', ?, -1, 0, 0)").bind_text(1, type).next();
  Query(database, "INSERT INTO region (geom) VALUES (?)").bind_blob(1, blob).next();
}

}  // namespace

std::string write_gpkg(const RegionData& data) try {
  Database database;
  database.run("PRAGMA journal_mode = OFF");
  database.run(kTables);
  fill_tables(database, data);
  return database.bytes();
} catch (const DatabaseFailure& failure) {
  throw std::invalid_argument("GeoPackage: " + failure.message);
}

}  // namespace dymsum::io
