// Well-known binary.
#pragma once

#include <string>

#include "dymsum/region.h"

namespace dymsum::io {

/// Appends one geometry, little-endian, coordinates as they are (+0 for both zeros): POLYGON or MULTIPOLYGON,
/// LINESTRING or MULTILINESTRING, POINT or MULTIPOINT; a GEOMETRYCOLLECTION where there are several kinds, or nothing.
/// Requires fewer than 2^32 vertices.
void append_wkb(std::string& out, const RegionData& data);

}  // namespace dymsum::io
