#include "io/region/tight_data.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "planar/position/exact_source.h"

namespace dymsum::io {
namespace {

class TightData {
 public:
  explicit TightData(const PlanarSum& sum) : nearest_(*exact_source(sum)) {
    for (const SumSegment& s : sum.tight_segments) add(nearest_(s.from), nearest_(s.to));
    for (const SumVertex& v : sum.tight_points) add(nearest_(v));
  }
  RegionData data() && { return std::move(data_); }

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

/// Appends items in their order, without those that are there already.
template <class T>
void append_new(std::vector<T>& to, const std::vector<T>& items) {
  const auto less = [](const T& a, const T& b) { return before(a, b); };
  std::set<T, decltype(less)> known(to.begin(), to.end(), less);
  for (const T& item : items)
    if (known.insert(item).second) to.push_back(item);
}

}  // namespace

RegionData tight_data(const PlanarSum& sum) {
  if (sum.tight_segments.empty() && sum.tight_points.empty()) return {};
  return TightData(sum).data();
}

RegionData with_tight(RegionData set, const RegionData& tight) {
  append_new(set.polylines, tight.polylines);
  append_new(set.points, tight.points);
  return set;
}

}  // namespace dymsum::io
