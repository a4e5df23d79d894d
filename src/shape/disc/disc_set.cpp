#include "shape/disc/disc_set.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace dymsum::shape {

namespace {

constexpr double kHalfTurn = std::numbers::pi;

double heading_at(const DiscPiece& piece, bool at_end) {
  if (piece.of == DiscPiece::Of::edge) return piece.heading;
  return piece.from_angle + (at_end ? piece.sweep : 0) + std::copysign(kHalfTurn / 2, piece.sweep);
}

/// In a half-open turn whose middle is where corners can turn to: one that turns right back is not mistaken.
double corner_turn(double angle, Corners corners) {
  const double middle = corners == Corners::clockwise ? -kHalfTurn / 2 : kHalfTurn / 2;
  return middle + std::remainder(angle - middle, 2 * kHalfTurn);
}

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
    piece.sweep = -piece.sweep;
    if (piece.of == DiscPiece::Of::edge) piece.heading += piece.heading > 0 ? -kHalfTurn : kHalfTurn;
    ring.pieces.push_back(piece);
  }
  return ring;
}

bool is_outer(const DiscRing& ring, Corners corners) {
  double turn = 0;
  for (std::size_t i = 0; i < ring.pieces.size(); ++i) {
    const DiscPiece &piece = ring.pieces[i], &next = ring.pieces[(i + 1) % ring.pieces.size()];
    turn += piece.sweep;
    if (piece.from.kind == DiscCorner::Kind::none) break;
    turn += corner_turn(heading_at(next, false) - heading_at(piece, true), corners);
  }
  return turn > 0;
}

std::vector<DiscPart> parts_of(std::vector<OwnedRing> rings, Corners corners) {
  std::map<std::uint32_t, std::size_t> part_of;
  std::vector<DiscPart> parts;
  for (OwnedRing& ring : rings) {
    if (!is_outer(ring.ring, corners)) continue;
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
