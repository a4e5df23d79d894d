#include "cspace/events/walked_rings.h"

#include <algorithm>
#include <vector>

#include "exact/orient.h"

namespace dymsum::planar {
namespace {

struct RingEdge {
  Point from, to;  // by x, then y
  bool of_line;
};

bool before(const Point& a, const Point& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

std::vector<RingEdge> sorted_edges(const Region& r) {
  std::vector<RingEdge> edges;
  const auto add = [&](Point a, Point b, bool of_line) {
    edges.push_back(before(a, b) ? RingEdge{a, b, of_line} : RingEdge{b, a, of_line});
  };
  const auto add_ring = [&](const Ring& ring) {
    for (std::size_t k = 0; k < ring.size(); ++k) add(ring[k], ring[(k + 1) % ring.size()], false);
  };
  for (const Part& part : r.parts()) {
    add_ring(part.outer);
    for (const Ring& hole : part.holes) add_ring(hole);
  }
  for (const Polyline& line : r.polylines())
    for (std::size_t k = 0; k + 1 < line.size(); ++k) add(line[k], line[k + 1], true);
  std::sort(edges.begin(), edges.end(), [](const RingEdge& a, const RingEdge& b) {
    return a.from != b.from ? before(a.from, b.from) : before(a.to, b.to);
  });
  return edges;
}

}  // namespace

// On one line, an edge that begins after another one's end has no interval of it.
std::optional<Point> overlapping_polylines(const Region& r) {
  if (r.polylines().empty()) return std::nullopt;
  const std::vector<RingEdge> edges = sorted_edges(r);
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t j = i + 1; j < edges.size() && before(edges[j].from, edges[i].to); ++j) {
      const RingEdge &e = edges[i], &f = edges[j];
      if (!e.of_line && !f.of_line) continue;
      if (exact::orient_sign(e.from, e.to, f.from) == 0 && exact::orient_sign(e.from, e.to, f.to) == 0) return f.from;
    }
  return std::nullopt;
}

}  // namespace dymsum::planar
