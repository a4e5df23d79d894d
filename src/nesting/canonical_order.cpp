#include "nesting/canonical_order.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dymsum::nesting {
namespace {

bool less(Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

bool less(const std::vector<Point>& a, const std::vector<Point>& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                      [](Point p, Point q) { return less(p, q); });
}

bool less(const Part& a, const Part& b) {
  if (a.outer != b.outer) return less(a.outer, b.outer);
  return std::lexicographical_compare(a.holes.begin(), a.holes.end(), b.holes.begin(), b.holes.end(),
                                      [](const Ring& p, const Ring& q) { return less(p, q); });
}

template <class T>
void sort(std::vector<T>& items) {
  std::sort(items.begin(), items.end(), [](const T& a, const T& b) { return less(a, b); });
}

void drop_negative_zeros(std::vector<Point>& points) {
  for (Point& p : points) p = {p.x + 0.0, p.y + 0.0};
}

void begin_smallest(Ring& ring) {
  drop_negative_zeros(ring);
  const auto smallest = std::min_element(ring.begin(), ring.end(), [](Point a, Point b) { return less(a, b); });
  const Point first = *smallest;
  std::rotate(ring.begin(), smallest, ring.end());
  // A ring that touches itself there begins in several ways.
  Ring best = ring;
  for (std::size_t k = 1; k < ring.size(); ++k) {
    if (ring[k] != first) continue;
    Ring other(ring.begin() + static_cast<std::ptrdiff_t>(k), ring.end());
    other.insert(other.end(), ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(k));
    if (less(other, best)) best = std::move(other);
  }
  ring = std::move(best);
}

}  // namespace

void put_in_order(RegionData& data) {
  for (Part& part : data.parts) {
    begin_smallest(part.outer);
    for (Ring& hole : part.holes) begin_smallest(hole);
    sort(part.holes);
  }
  sort(data.parts);
  for (Polyline& line : data.polylines) {
    drop_negative_zeros(line);
    if (less(line.back(), line.front())) std::reverse(line.begin(), line.end());
  }
  sort(data.polylines);
  drop_negative_zeros(data.points);
  sort(data.points);
}

}  // namespace dymsum::nesting
