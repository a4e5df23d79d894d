#include "shape/disc/disc_set.h"

#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace dymsum::shape {

namespace {

DiscRing ring_of(const Ring& vertices, std::uint32_t first) {
  DiscRing ring;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Point a = vertices[i], b = vertices[(i + 1) % vertices.size()];
    DiscPiece piece;
    piece.index = first + static_cast<std::uint32_t>(i);
    piece.heading = std::atan2(b.y - a.y, b.x - a.x);
    piece.from.kind = DiscCorner::Kind::vertex;
    piece.from.vertex = piece.index;
    piece.from.at = a;
    ring.pieces.push_back(piece);
  }
  return ring;
}

DiscCorner vertex_of_region(std::uint32_t vertex, Point at) {
  DiscCorner corner;
  corner.kind = DiscCorner::Kind::vertex;
  corner.vertex = vertex;
  corner.at = at;
  return corner;
}

}  // namespace

DiscRing reversed(std::vector<DiscPiece> pieces) {
  DiscRing ring;
  std::vector<DiscCorner> corners;
  for (const DiscPiece& piece : pieces) corners.push_back(piece.from);
  for (std::size_t i = pieces.size(); i-- > 0;) {
    DiscPiece piece = pieces[i];
    piece.from = corners[(i + 1) % corners.size()];
    piece.from_angle += piece.sweep;
    piece.sweep = 0 - piece.sweep;  // no -0
    if (piece.of == DiscPiece::Of::edge) piece.heading += piece.heading > 0 ? -std::numbers::pi : std::numbers::pi;
    ring.pieces.push_back(piece);
  }
  return ring;
}

std::vector<DiscPart> parts_of(std::vector<OwnedRing> rings) {
  std::map<std::uint32_t, std::size_t> part_of;
  std::vector<DiscPart> parts;
  for (OwnedRing& ring : rings) {
    if (!ring.outer) continue;
    if (!part_of.try_emplace(ring.owner, parts.size()).second)
      throw std::logic_error("a part of a disc's sum has two outer rings");
    parts.push_back({std::move(ring.ring), {}});
    ring.ring.pieces.clear();
  }
  for (OwnedRing& ring : rings)
    if (!ring.ring.pieces.empty()) parts[part_of.at(ring.owner)].holes.push_back(std::move(ring.ring));
  return parts;
}

DiscSet set_of(const Region& region) {
  DiscSet set;
  std::uint32_t vertex = 0;
  for (const Part& part : region.parts()) {
    DiscPart& made = set.parts.emplace_back();
    made.outer = ring_of(part.outer, vertex);
    vertex += static_cast<std::uint32_t>(part.outer.size());
    for (const Ring& hole : part.holes) {
      made.holes.push_back(ring_of(hole, vertex));
      vertex += static_cast<std::uint32_t>(hole.size());
    }
  }
  for (const Polyline& line : region.polylines()) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      set.segments.push_back({vertex_of_region(vertex + static_cast<std::uint32_t>(i), line[i]),
                              vertex_of_region(vertex + static_cast<std::uint32_t>(i) + 1, line[i + 1])});
    vertex += static_cast<std::uint32_t>(line.size());
  }
  for (const Point& point : region.points()) set.points.push_back(vertex_of_region(vertex++, point));
  set.radius_exact = "0";
  return set;
}

}  // namespace dymsum::shape
