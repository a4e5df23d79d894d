#include "shape/disc/nested_rings.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace dymsum::shape {

namespace {

/// The nearest corner of a ring, squared.
double clearance(const DiscRing& ring, Point z) {
  double least = std::numeric_limits<double>::infinity();
  for (const DiscPiece& piece : ring.pieces)
    least = std::min(least, std::hypot(piece.from.at.x - z.x, piece.from.at.y - z.y));
  return least;
}

/// A corner of the hole as far from those of the ring as there is: they may touch.
Point corner_away_from(const DiscRing& hole, const DiscRing& ring) {
  Point best = hole.pieces.front().from.at;
  double most = -1;
  for (const DiscPiece& piece : hole.pieces) {
    const double d = clearance(ring, piece.from.at);
    if (d > most) most = d, best = piece.from.at;
  }
  return best;
}

/// Between an arc and its chord lies nothing of the set, as the arc bends into it: chords wind as often.
bool winds_about(const DiscRing& ring, Point z) {
  double angle = 0;
  for (std::size_t i = 0; i < ring.pieces.size(); ++i) {
    const Point a = ring.pieces[i].from.at, b = ring.pieces[(i + 1) % ring.pieces.size()].from.at;
    const double ax = a.x - z.x, ay = a.y - z.y, bx = b.x - z.x, by = b.y - z.y;
    angle += std::atan2(ax * by - ay * bx, ax * bx + ay * by);
  }
  return std::abs(angle) > std::numbers::pi;
}

}  // namespace

std::vector<DiscPart> nested(std::vector<DiscRing> rings, Corners corners) {
  std::vector<DiscPart> parts;
  std::vector<DiscRing> holes;
  for (DiscRing& ring : rings) {
    if (is_outer(ring, corners)) parts.push_back({std::move(ring), {}});
    else holes.push_back(std::move(ring));
  }
  for (DiscRing& hole : holes) {
    std::size_t innermost = parts.size();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts.size() > 1 && !winds_about(parts[i].outer, corner_away_from(hole, parts[i].outer))) continue;
      // Of two rings around the hole, which do not cross, one lies within the other.
      if (innermost == parts.size() ||
          winds_about(parts[innermost].outer, corner_away_from(parts[i].outer, parts[innermost].outer)))
        innermost = i;
    }
    if (innermost == parts.size()) throw std::logic_error("a hole lies in no part");
    parts[innermost].holes.push_back(std::move(hole));
  }
  return parts;
}

}  // namespace dymsum::shape
