// A rounded sum with its tight features, as text.
#include <cstddef>
#include <string>

#include "dymsum/region_io.h"
#include "io/region/readers.h"
#include "io/region/tight_data.h"

namespace dymsum {

namespace {

std::string feature(const std::string& name, const std::string& properties, const RegionData& data) {
  return R"({"type":"Feature","id":")" + name + R"(","properties":{)" + properties + R"(},"geometry":)" +
         io::geojson_geometry(data) + "}";
}

}  // namespace

std::string format_sum(const PlanarSum& sum, const Region& rounded, RegionFormat format) {
  if (sum.tight_segments.empty() && sum.tight_points.empty()) return format_region(rounded, format);
  if (format == RegionFormat::geojson)
    return R"({"type":"FeatureCollection","features":[)" + feature("sum", R"("tight":false)", rounded.data()) + ",\n" +
           feature("tight", R"("tight":true)", io::tight_data(sum)) + "]}\n";
  const RegionData all = io::with_tight(rounded.data(), io::tight_data(sum));
  const std::size_t polylines = rounded.polylines().size(), points = rounded.points().size();
  std::string text = io::format_region_data(all, format);
  if (format != RegionFormat::poly) return text;
  return "# tight features: the last " + std::to_string(all.polylines.size() - polylines) + " polylines and " +
         std::to_string(all.points.size() - points) + " points\n" + text;
}

}  // namespace dymsum
