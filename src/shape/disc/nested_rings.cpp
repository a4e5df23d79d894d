#include "shape/disc/nested_rings.h"

#include <map>
#include <stdexcept>
#include <utility>

namespace dymsum::shape {

namespace {

using exact::Interval;
using exact::RootExpression;

/// The exact corners of rings, relative to a position of the region.
class ExactCorners {
 public:
  ExactCorners(const DiscPositions& positions, Point origin) : positions_(positions), origin_(origin) {}

  LazyVector at(const PlacedRing& ring, std::size_t piece) const {
    const DiscCorner& corner = ring.ring.pieces[piece].from;
    if (corner.kind == DiscCorner::Kind::vertex) return vertex(corner.at);
    const double off = positions_.at_error();
    const Vector<Interval> near{Interval(corner.at.x - off, corner.at.x + off) - Interval(origin_.x),
                                Interval(corner.at.y - off, corner.at.y + off) - Interval(origin_.y)};
    if (corner.kind == DiscCorner::Kind::crossing) return {near, [this, corner] { return crossing_at(corner); }};
    const Site& site = positions_.complex().sites[ring.sites[piece]];
    return {near, [this, corner, &site] { return contact_at(corner, site); }};
  }
  LazyVector vertex(Point p) const {
    return {between<Interval>(origin_, p), [this, p] { return between<RootExpression>(origin_, p); }};
  }

 private:
  /// The position at which corner.disc is entered from corner.other, clockwise, or touched.
  Vector<RootExpression> crossing_at(const DiscCorner& corner) const {
    const auto c = positions_.exact_centre_from(corner.disc, origin_),
               d = positions_.exact_centre_from(corner.other, origin_);
    const auto between = minus(d, c);
    const RootExpression half(0.5),
        room = positions_.level().exact * positions_.level().exact - half * half * dot(between, between);
    if (exact::sign_of(room) == 0) return plus(c, {half * between.x, half * between.y});  // they touch
    return plus(c, crossing(between, positions_.level().exact, true));
  }
  Vector<RootExpression> contact_at(const DiscCorner& corner, const Site& edge) const {
    const auto n = long_normal<RootExpression>(edge);
    const RootExpression fraction = positions_.level().exact / sqrt(dot(n, n));
    return minus(positions_.exact_centre_from(corner.disc, origin_),
                 Vector<RootExpression>{n.x * fraction, n.y * fraction});
  }

  const DiscPositions& positions_;
  Point origin_;
};

LazyVector difference(const LazyVector& a, const LazyVector& b) {
  return {minus(a.near, b.near), [a, b] { return minus(a.exact(), b.exact()); }};
}

/// Whether a position of another ring, or a vertex in the part that this bounds, lies within a ring: by the edges that
/// a ray from it towards +x crosses. Between an arc and its chord lies nothing of the set, as the arc bends into it:
/// chords wind as often, and never meet the position.
bool winds_about(const DiscPositions& positions, const PlacedRing& ring, const PlacedRing& inner) {
  const Point origin = inner.anchor.value_or(positions.complex().sites.front().a);
  const ExactCorners corners(positions, origin);
  const LazyVector z = inner.anchor ? corners.vertex(origin) : corners.at(inner, 0);
  const std::size_t n = ring.ring.pieces.size();
  int winding = 0;
  LazyVector a = difference(corners.at(ring, n - 1), z);
  bool a_above = sign_of_y(a) > 0;
  for (std::size_t i = 0; i < n; ++i) {
    LazyVector b = difference(corners.at(ring, i), z);
    const bool b_above = sign_of_y(b) > 0;
    if (a_above != b_above && (sign_of_cross(a, b) > 0) == b_above) winding += b_above ? 1 : -1;
    a = std::move(b);
    a_above = b_above;
  }
  return winding != 0;
}

/// Of two rings around a hole, which do not cross, one lies within the other.
std::size_t innermost_around(const DiscPositions& positions, const std::vector<const PlacedRing*>& outer,
                             const PlacedRing& hole) {
  if (outer.size() == 1) return 0;
  std::optional<std::size_t> innermost;
  for (std::size_t i = 0; i < outer.size(); ++i)
    if (winds_about(positions, *outer[i], hole) &&
        (!innermost || winds_about(positions, *outer[*innermost], *outer[i])))
      innermost = i;
  if (!innermost) throw std::logic_error("a hole lies in no part");
  return *innermost;
}

}  // namespace

std::vector<DiscPart> nested(const DiscPositions& positions, std::vector<PlacedRing> rings) {
  std::vector<DiscPart> parts;
  std::vector<const PlacedRing*> outer;
  std::vector<PlacedRing*> holes;
  std::map<std::uint32_t, std::size_t> part_of;
  for (PlacedRing& ring : rings) {
    if (!ring.outer) {
      holes.push_back(&ring);
      continue;
    }
    if (ring.owner && !part_of.try_emplace(*ring.owner, parts.size()).second)
      throw std::logic_error("a part of a closing has two outer rings");
    outer.push_back(&ring);
    parts.push_back({ring.ring, {}});
  }
  for (PlacedRing* hole : holes) {
    const auto known = hole->owner ? part_of.find(*hole->owner) : part_of.end();
    const std::size_t part = known != part_of.end() ? known->second : innermost_around(positions, outer, *hole);
    parts[part].holes.push_back(std::move(hole->ring));
  }
  return parts;
}

}  // namespace dymsum::shape
