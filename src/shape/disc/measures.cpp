// Sizes of sets with arcs, with bounds of what doubles err by.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dymsum/growing_disc.h"

namespace dymsum {

namespace {

// Of a term: its products and sums, the sine and the sum over all terms, which err by a few units each.
constexpr double kTermError = 0x1p-45;
// Of the angle an arc covers: two angles of vectors that are within 2^-47 of theirs.
constexpr double kAngleError = 0x1p-44;

template <class Use>
void for_each_ring(const DiscSet& set, const Use& use) {
  for (const DiscPart& part : set.parts) {
    use(part.outer);
    for (const DiscRing& hole : part.holes) use(hole);
  }
}

double turned(double angle, double by) { return std::remainder(angle + by, 2 * std::numbers::pi); }

/// The box of an arc beyond its ends: the four furthest points of its circle that it covers.
template <class See>
void see_arc(const DiscPiece& arc, double r, const See& see) {
  constexpr double kQuarter = std::numbers::pi / 2;
  for (int i = 0; i < 4; ++i) {
    const double direction = i * kQuarter;
    double from_start = turned(direction, -arc.from_angle) * (arc.sweep < 0 ? -1 : 1);
    if (from_start < 0) from_start += 2 * std::numbers::pi;
    if (from_start > std::abs(arc.sweep)) continue;
    const double dx[] = {r, 0, -r, 0}, dy[] = {0, r, 0, -r};
    see(Point{arc.centre.x + dx[i], arc.centre.y + dy[i]});
  }
}

}  // namespace

std::size_t DiscSet::hole_count() const {
  std::size_t count = 0;
  for (const DiscPart& part : parts) count += part.holes.size();
  return count;
}

std::size_t DiscSet::piece_count() const {
  std::size_t count = 0;
  for_each_ring(*this, [&](const DiscRing& ring) { count += ring.pieces.size(); });
  return count;
}

Measured area(const DiscSet& set) {
  Measured made;
  const double r = set.radius, moved = 2 * set.at_error;
  for_each_ring(set, [&](const DiscRing& ring) {
    // From the ring's own corner: far from the origin products would lose digits.
    const Point origin = ring.pieces.front().from.at;
    for (std::size_t i = 0; i < ring.pieces.size(); ++i) {
      const DiscPiece& piece = ring.pieces[i];
      const Point a = piece.from.at, b = ring.pieces[(i + 1) % ring.pieces.size()].from.at;
      const double ax = a.x - origin.x, ay = a.y - origin.y, bx = b.x - origin.x, by = b.y - origin.y;
      const double arc = r * r / 2 * (piece.sweep - std::sin(piece.sweep));
      made.value += (ax * by - ay * bx) / 2 + arc;
      made.error += moved * (std::hypot(bx - ax, by - ay) + moved) +
                    kTermError * (std::abs(ax * by) + std::abs(ay * bx) + r * r * std::abs(piece.sweep)) +
                    kAngleError * (piece.sweep != 0 ? r * r : 0);
    }
  });
  return made;
}

Measured perimeter(const DiscSet& set) {
  Measured made;
  for_each_ring(set, [&](const DiscRing& ring) {
    for (std::size_t i = 0; i < ring.pieces.size(); ++i) {
      const DiscPiece& piece = ring.pieces[i];
      const Point a = piece.from.at, b = ring.pieces[(i + 1) % ring.pieces.size()].from.at;
      const bool arc = piece.of != DiscPiece::Of::edge;
      const double length = arc ? set.radius * std::abs(piece.sweep) : std::hypot(b.x - a.x, b.y - a.y);
      made.value += length;
      made.error += kTermError * length + (arc ? kAngleError * set.radius : 4 * set.at_error);
    }
  });
  return made;
}

std::array<double, 4> bounds(const DiscSet& set) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::array<double, 4> box{kFar, kFar, -kFar, -kFar};
  const auto see = [&](Point p) {
    box = {std::min(box[0], p.x), std::min(box[1], p.y), std::max(box[2], p.x), std::max(box[3], p.y)};
  };
  for_each_ring(set, [&](const DiscRing& ring) {
    for (const DiscPiece& piece : ring.pieces) {
      if (piece.from.kind != DiscCorner::Kind::none) see(piece.from.at);
      if (piece.of != DiscPiece::Of::edge) see_arc(piece, set.radius, see);
    }
  });
  for (const DiscSegment& segment : set.segments) see(segment.from.at), see(segment.to.at);
  for (const DiscCorner& point : set.points) see(point.at);
  return box[0] <= box[2] ? box : std::array<double, 4>{};
}

}  // namespace dymsum
