// What must hold for every text a reader is given, whatever it contains.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <string>
#include <string_view>

#include "dymsum/region_io.h"
#include "fuzz/text_lines.h"

namespace dymsum::fuzz {

/// Empty when all is well: an error has a file, a line inside the text and a sentence; shapes that are valid regions
/// come back from every format as they were.
inline std::string check_reader(std::string_view text, RegionFormat format) {
  const auto shapes = parse_shapes(text, format, "fuzzed");
  if (!shapes) {
    const Error& error = shapes.error();
    if (error.evidence.file != "fuzzed" || error.message.empty()) return "an error without file or sentence";
    if (!error.evidence.line || *error.evidence.line < 1 || *error.evidence.line > most_lines(text))
      return "an error without a line of the file";
    if (error.code != ErrorCode::malformed && error.code != ErrorCode::truncated && error.code != ErrorCode::not_finite)
      return "an error of another room";
    return "";
  }
  for (const NamedShape& shape : *shapes) {
    const auto region = Region::create(shape.data);
    if (!region) continue;
    for (const RegionFormat other : {RegionFormat::poly, RegionFormat::wkt, RegionFormat::geojson, RegionFormat::svg,
                                     RegionFormat::json, RegionFormat::dxf}) {
      const auto again = parse_shapes(format_region(*region, other), other, "again");
      if (!again) return "our own text is refused: " + again.error().to_string();
      if (again->size() != 1 || again->front().data != region->data())
        return "a region changed on its way through a file";
    }
  }
  return "";
}

/// For fuzz targets: aborts with the problem on standard error.
inline int require_good_reader(const unsigned char* data, std::size_t size, RegionFormat format) {
  const std::string problem = check_reader({reinterpret_cast<const char*>(data), size}, format);
  if (problem.empty()) return 0;
  std::fprintf(stderr, "%s\n", problem.c_str());
  std::abort();
}

}  // namespace dymsum::fuzz
