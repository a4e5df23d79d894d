#include "shape/disc/disc_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "dymsum/growing_disc.h"
#include "exact/big.h"
#include "exact/rounding_bound.h"

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

namespace dymsum {

// Sizes of sets with arcs, with bounds of what doubles err by.

namespace {

// The error of a term: its products and sums, the sine and the sum over all terms, which err by a few units each.
constexpr double kTermError = 0x1p-45;
// The error of the angle that an arc covers: its roundings. Besides, each of its ends may be at_error off.
constexpr double kAngleError = 0x1p-41;

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

namespace {

/// value * 2^exponent and its error: the unit is about the set's size, so that products stay within doubles.
struct ScaledArea {
  Measured in_units;
  int exponent = 0;
};

int unit_of(const DiscSet& set) {
  double size = set.radius;
  for_each_ring(set, [&](const DiscRing& ring) {
    const Point origin = ring.pieces.front().from.at;
    for (const DiscPiece& piece : ring.pieces)
      size = std::max({size, std::abs(piece.from.at.x - origin.x), std::abs(piece.from.at.y - origin.y)});
  });
  return size > 0 ? std::ilogb(size) : 0;
}

ScaledArea scaled_area(const DiscSet& set) {
  Measured made;
  const int unit = unit_of(set);
  const auto scaled = [unit](double v) { return std::scalbn(v, -unit); };
  const double r = scaled(set.radius), moved = 2 * scaled(set.at_error);
  const double arc_error = kAngleError * r * r + 2 * moved * r;
  for_each_ring(set, [&](const DiscRing& ring) {
    // Positions are taken from the ring's own corner: far from the origin products would lose digits.
    const Point origin = ring.pieces.front().from.at;
    for (std::size_t i = 0; i < ring.pieces.size(); ++i) {
      const DiscPiece& piece = ring.pieces[i];
      const Point a = piece.from.at, b = ring.pieces[(i + 1) % ring.pieces.size()].from.at;
      const double ax = scaled(a.x - origin.x), ay = scaled(a.y - origin.y), bx = scaled(b.x - origin.x),
                   by = scaled(b.y - origin.y);
      const double arc = r * r / 2 * (piece.sweep - std::sin(piece.sweep));
      made.value += (ax * by - ay * bx) / 2 + arc;
      made.error += moved * (std::hypot(bx - ax, by - ay) + moved) +
                    kTermError * (std::abs(ax * by) + std::abs(ay * bx) + r * r * std::abs(piece.sweep)) +
                    (piece.sweep != 0 ? arc_error : 0);
    }
  });
  return {made, 2 * unit};
}

std::string text_of(double v, int exponent) {
  constexpr int kDigits = 17;  // enough to distinguish any two doubles
  exact::BigRational exactly = exact::exact_value(v);
  const exact::BigInteger power = exact::BigInteger(1) << static_cast<unsigned>(std::abs(exponent));
  exactly *= exponent >= 0 ? exact::BigRational(power) : exact::BigRational(exact::BigInteger(1), power);
  return exact::decimal_text(exactly, kDigits);
}

}  // namespace

Measured area(const DiscSet& set) {
  const auto [made, exponent] = scaled_area(set);
  // What is below the range of doubles is rounded to one.
  return {std::scalbn(made.value, exponent),
          std::scalbn(made.error, exponent) + (exponent < 0 ? std::numeric_limits<double>::denorm_min() : 0)};
}

MeasuredText area_text(const DiscSet& set) {
  const auto [made, exponent] = scaled_area(set);
  return {text_of(made.value, exponent), text_of(made.error * exact::kOutwards, exponent)};
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
      made.error += kTermError * length + (arc ? kAngleError * set.radius : 0) + 4 * set.at_error;
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
