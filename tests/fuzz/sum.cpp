// A fuzz target for planar sums: bytes to a tiny pair of operands, every engine against the sum by definition. Prints
// the pair and aborts when something is wrong.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "oracles/pair_text.h"
#include "oracles/verdict.h"

namespace {

using namespace dymsum;

/// Takes bytes; zeros when they run out.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
  int next() { return at_ == end_ ? 0 : *at_++; }
  bool empty() const { return at_ == end_; }

 private:
  const std::uint8_t *at_, *end_;
};

/// Coordinates 0 .. 7 from a byte's two halves.
std::vector<Point> take_points(Bytes& bytes, int count) {
  std::vector<Point> out;
  for (int i = 0; i < count; ++i) {
    const int byte = bytes.next();
    out.push_back({static_cast<double>(byte >> 4 & 7), static_cast<double>(byte & 7)});
  }
  return out;
}

double doubled_area(const Ring& ring) {
  double total = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i], &b = ring[(i + 1) % ring.size()];
    total += a.x * b.y - a.y * b.x;
  }
  return total;
}

/// One to three pieces, each a head byte (two bits for the kind: part, hole of the last part, polyline, point; three
/// for the number of vertices) and its vertices.
RegionData take_region(Bytes& bytes) {
  RegionData out;
  const int pieces = 1 + bytes.next() % 3;
  for (int i = 0; i < pieces; ++i) {
    const int head = bytes.next(), kind = head & 3, count = head >> 2 & 7;
    std::vector<Point> points = take_points(bytes, kind == 3 ? 1 : kind == 2 ? 2 + count % 3 : 3 + count % 5);
    if (kind == 2) out.polylines.push_back(points);
    if (kind == 3) out.points.push_back(points[0]);
    if (kind > 1) continue;
    const bool is_hole = kind == 1 && !out.parts.empty();
    if ((doubled_area(points) < 0) != is_hole) std::reverse(points.begin(), points.end());
    if (is_hole) {
      out.parts.back().holes.push_back(points);
    } else {
      out.parts.push_back({points, {}});
    }
  }
  return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const RegionData p = take_region(bytes), q = take_region(bytes);
  const std::string wrong = oracles::verdict(p, q);
  if (wrong.empty() || oracles::refused(wrong)) return 0;
  std::fprintf(stderr, "%s\n", oracles::failure_report(p, q, wrong).c_str());
  std::abort();
}
