// The readers and writers behind region_io.h. Readers throw ReadFailure.
#pragma once

#include <string>
#include <vector>

#include "dymsum/region_io.h"
#include "io/source.h"

namespace dymsum::io {

/// Shapes as they stand in the file; a shape without a name of its own has an empty one.
std::vector<NamedShape> read_poly(const Source& source);
std::vector<NamedShape> read_wkt(const Source& source);
/// GeoJSON, a nesting instance or a footprint, distinguished by what is outermost.
std::vector<NamedShape> read_json(const Source& source);
std::vector<NamedShape> read_svg(const Source& source);
std::vector<NamedShape> read_dxf(const Source& source);

std::string write_poly(const RegionData& data);
std::string write_wkt(const RegionData& data);
std::string write_geojson(const RegionData& data);
/// The bare geometry, without the end of the line.
std::string geojson_geometry(const RegionData& data);
std::string write_nesting(const RegionData& data);
/// A shape of such an instance: its type and data.
void append_shape(std::string& out, const RegionData& data);
std::string write_svg(const RegionData& data);
std::string write_dxf(const RegionData& data);

/// format_region before validation: what the readers give, in a format.
std::string format_region_data(const RegionData& data, RegionFormat format);

}  // namespace dymsum::io
