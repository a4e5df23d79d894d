// Well-known binary, read.
#pragma once

#include <string>
#include <string_view>

#include "dymsum/region_io.h"

namespace dymsum::io {

/// What is wrong with a geometry; who reads it knows of which file and row it is.
struct WkbFailure {
  ErrorCode code;
  std::string message;
};

/// Appends one geometry of OGC's or ISO's WKB to a shape, coordinates bit for bit: points, lines, polygons, curves,
/// which become chords, several of them, collections. Every geometry has its own byte order. Rings are closed there
/// (the closing vertex is dropped) and oriented here; what is empty appends nothing. Z and M are refused or left out,
/// as the options say. Throws WkbFailure: truncated, also where a count is more than the bytes that follow can hold;
/// malformed; not_finite. Memory is bounded by the size of `bytes`, whatever it announces.
void read_wkb(std::string_view bytes, const ReadOptions& options, NamedShape& shape);

}  // namespace dymsum::io
