// Stands for database.cpp, read_gpkg.cpp and write_gpkg.cpp where SQLite is not linked.
#include <stdexcept>

#include "io/region/gpkg.h"

namespace dymsum::io {

bool has_geopackage() { return false; }

std::vector<NamedShape> read_gpkg(const Source& source, const std::optional<std::string>&) {
  source.fail_in_bytes(ErrorCode::unsupported_format,
                       "GeoPackages are read and written by SQLite, which this dymsum was compiled without");
}

std::string layers_of(const std::vector<NamedShape>&) { return {}; }

std::optional<Error> unfinished_database(const std::string&, std::string_view) { return std::nullopt; }

std::string write_gpkg(const RegionData&) {
  throw std::invalid_argument("GeoPackages are not written by this dymsum, which was compiled without SQLite");
}

}  // namespace dymsum::io
