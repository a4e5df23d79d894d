// A rounded sum with its tight features, as text.
#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "dymsum/region_io.h"
#include "io/region/readers.h"
#include "planar/position/nearest_point.h"

namespace dymsum {

namespace {

/// Tight features of a sum, rounded.
class TightData {
 public:
  explicit TightData(const PlanarSum& sum) : nearest_(*exact_source(sum)) {
    for (const SumSegment& s : sum.tight_segments) add(nearest_(s.from), nearest_(s.to));
    for (const SumVertex& v : sum.tight_points) add(nearest_(v));
  }
  const RegionData& data() const { return data_; }

 private:
  void add(Point at) { data_.points.push_back(at); }
  /// A segment that rounding makes a point is one.
  void add(Point from, Point to) {
    if (from == to) return add(from);
    data_.polylines.push_back({from, to});
  }

  planar::NearestPoint nearest_;
  RegionData data_;
};

bool before(Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }
bool before(const std::vector<Point>& a, const std::vector<Point>& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                      [](Point p, Point q) { return before(p, q); });
}

/// In their order, without those that are there already.
template <class T>
void append_new(std::vector<T>& to, const std::vector<T>& items) {
  const auto less = [](const T& a, const T& b) { return before(a, b); };
  std::set<T, decltype(less)> known(to.begin(), to.end(), less);
  for (const T& item : items)
    if (known.insert(item).second) to.push_back(item);
}

std::string feature(const std::string& name, const std::string& properties, const RegionData& data) {
  return R"({"type":"Feature","id":")" + name + R"(","properties":{)" + properties + R"(},"geometry":)" +
         io::geojson_geometry(data) + "}";
}

}  // namespace

std::string format_sum(const PlanarSum& sum, const Region& rounded, RegionFormat format) {
  if (sum.tight_segments.empty() && sum.tight_points.empty()) return format_region(rounded, format);
  const TightData tight(sum);
  if (format == RegionFormat::geojson)
    return R"({"type":"FeatureCollection","features":[)" + feature("sum", R"("tight":false)", rounded.data()) + ",\n" +
           feature("tight", R"("tight":true)", tight.data()) + "]}\n";
  RegionData all = rounded.data();
  const std::size_t polylines = all.polylines.size(), points = all.points.size();
  append_new(all.polylines, tight.data().polylines);
  append_new(all.points, tight.data().points);
  std::string text = io::format_region_data(all, format);
  if (format != RegionFormat::poly) return text;
  return "# tight features: the last " + std::to_string(all.polylines.size() - polylines) + " polylines and " +
         std::to_string(all.points.size() - points) + " points\n" + text;
}

}  // namespace dymsum
