// The one canonical way to write a region.
#include <algorithm>

#include "dymsum/region.h"
#include "exact/orient.h"
#include "planar/region/region_validate.h"

namespace dymsum {

namespace {

bool less(Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

bool less_chain(const std::vector<Point>& a, const std::vector<Point>& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), less);
}

// b lies strictly between its neighbours.
bool straight(Point a, Point b, Point c) { return exact::orient_sign(a, b, c) == 0 && exact::dot_sign(a, b, b, c) > 0; }

// Dropping a straight vertex changes no direction at others, so that all can be judged by the given neighbours.
std::vector<Point> without_straight_vertices(const std::vector<Point>& chain, bool closed) {
  std::vector<Point> kept;
  const std::size_t n = chain.size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool end = !closed && (i == 0 || i + 1 == n);
    if (!end && straight(chain[i == 0 ? n - 1 : i - 1], chain[i], chain[i + 1 == n ? 0 : i + 1])) continue;
    kept.push_back({chain[i].x + 0.0, chain[i].y + 0.0});  // no negative zeros
  }
  return kept;
}

// Rotates a cyclic sequence to its lexicographically least rotation, which starts at a smallest vertex. Linear: two
// candidate starts race, and the loser skips all that it shared with the winner.
void rotate_to_least(std::vector<Point>& ring) {
  const std::size_t n = ring.size();
  std::size_t i = 0, j = 1, same = 0;
  while (i < n && j < n && same < n) {
    const Point a = ring[(i + same) % n], b = ring[(j + same) % n];
    if (a == b) {
      ++same;
      continue;
    }
    (less(a, b) ? j : i) += same + 1;
    if (i == j) ++j;
    same = 0;
  }
  std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(std::min(i, j)), ring.end());
}

Ring canonical_ring(const Ring& ring) {
  Ring result = without_straight_vertices(ring, true);
  rotate_to_least(result);
  return result;
}

// Open: from the smaller end. Closed: the smaller one of its two directions, each from its least start.
Polyline canonical_polyline(const Polyline& line) {
  if (line.front() != line.back()) {
    Polyline result = without_straight_vertices(line, false);
    if (less(result.back(), result.front())) std::reverse(result.begin(), result.end());
    return result;
  }
  Polyline result = without_straight_vertices(Polyline(line.begin(), line.end() - 1), true);
  Polyline reversed(result.rbegin(), result.rend());
  rotate_to_least(result);
  rotate_to_least(reversed);
  if (less_chain(reversed, result)) result.swap(reversed);
  result.push_back(result.front());
  return result;
}

bool less_part(const Part& a, const Part& b) {
  if (a.outer != b.outer) return less_chain(a.outer, b.outer);
  return std::lexicographical_compare(a.holes.begin(), a.holes.end(), b.holes.begin(), b.holes.end(), less_chain);
}

}  // namespace

Region Region::canonical() const {
  RegionData result;
  for (const Part& part : data_.parts) {
    Part& made = result.parts.emplace_back();
    made.outer = canonical_ring(part.outer);
    for (const Ring& hole : part.holes) made.holes.push_back(canonical_ring(hole));
    std::sort(made.holes.begin(), made.holes.end(), less_chain);
  }
  std::sort(result.parts.begin(), result.parts.end(), less_part);
  for (const Polyline& line : data_.polylines) result.polylines.push_back(canonical_polyline(line));
  std::sort(result.polylines.begin(), result.polylines.end(), less_chain);
  result.polylines.erase(std::unique(result.polylines.begin(), result.polylines.end()), result.polylines.end());
  for (const Point p : data_.points) result.points.push_back({p.x + 0.0, p.y + 0.0});
  std::sort(result.points.begin(), result.points.end(), less);
  result.points.erase(std::unique(result.points.begin(), result.points.end()), result.points.end());
  return planar::trusted_region(std::move(result), touching_points_);
}

bool operator==(const Region& a, const Region& b) {
  return a.data_ == b.data_ || a.canonical().data_ == b.canonical().data_;
}

}  // namespace dymsum
