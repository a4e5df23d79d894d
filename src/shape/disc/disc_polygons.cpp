// Chords and tangents in place of arcs.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "dymsum/growing_disc.h"

namespace dymsum {

namespace {

constexpr double kMostChords = 1e7;

/// Replaces arcs by polygons that leave them by at most `error`.
class ArcPolygons {
 public:
  /// Vertices as near to each other as `together` in both coordinates are one.
  ArcPolygons(double radius, double error, double together, DiscBound bound)
      : radius_(radius), together_(together), bound_(bound) {
    // Half of the angle of a chord whose middle is `error` off, of a tangent whose end is.
    chord_half_ = error >= radius ? std::numbers::pi / 2 : std::acos(1 - error / radius);
    tangent_half_ = std::acos(radius / (radius + error));
  }

  Ring ring(const DiscRing& ring) {
    Ring made;
    for (const DiscPiece& piece : ring.pieces) {
      if (piece.from.kind != DiscCorner::Kind::none) add(made, piece.from.at);
      if (piece.of != DiscPiece::Of::edge) arc(made, piece);
    }
    while (made.size() > 1 && are_together(made.front(), made.back())) made.pop_back();
    return made;
  }

  /// How many chords the arcs of a set take, before they are made.
  double chords(const DiscPiece& piece) const { return std::ceil(std::abs(piece.sweep) / (2 * half(piece))); }
  std::size_t made() const { return chords_; }

 private:
  bool chord(const DiscPiece& piece) const {
    return bound_ == DiscBound::nearest || (piece.sweep > 0) == (bound_ == DiscBound::inside);
  }
  double half(const DiscPiece& piece) const {
    // Three at least for a whole circle.
    return std::min(chord(piece) ? chord_half_ : tangent_half_, std::numbers::pi / 3);
  }

  bool are_together(Point a, Point b) const {
    return std::abs(a.x - b.x) <= together_ && std::abs(a.y - b.y) <= together_;
  }
  void add(Ring& ring, Point p) {
    if (ring.empty() || !are_together(ring.back(), p)) ring.push_back(p);
  }

  void arc(Ring& ring, const DiscPiece& piece) {
    const double count = std::max(1.0, chords(piece)), step = piece.sweep / count;
    const bool whole = piece.from.kind == DiscCorner::Kind::none, chord_here = chord(piece);
    const double radius = chord_here ? radius_ : radius_ / std::cos(step / 2);
    chords_ += static_cast<std::size_t>(count);
    for (double i = chord_here ? (whole ? 0 : 1) : 0.5; i < count; ++i) {
      const double angle = piece.from_angle + i * step;
      add(ring, {piece.centre.x + radius * std::cos(angle), piece.centre.y + radius * std::sin(angle)});
    }
  }

  double radius_, together_, chord_half_ = 0, tangent_half_ = 0;
  DiscBound bound_;
  std::size_t chords_ = 0;
};

Error changed(Error error) {
  error.message =
      "polygons of this error are no valid region, as parts of the boundary are closer (" + error.message + ")";
  error.code = ErrorCode::rounding_changed_topology;
  return error;
}

Error bad_error(const std::string& what) { return {ErrorCode::out_of_range, what, {}}; }

template <class Use>
void for_each_piece(const DiscSet& set, const Use& use) {
  const auto see = [&](const DiscRing& ring) { std::for_each(ring.pieces.begin(), ring.pieces.end(), use); };
  for (const DiscPart& part : set.parts) {
    see(part.outer);
    for (const DiscRing& hole : part.holes) see(hole);
  }
}

double length_of(const Ring& ring) {
  double length = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()];
    length += std::hypot(b.x - a.x, b.y - a.y);
  }
  return length;
}
/// From a vertex of it: differences keep the digits of what is small and far from the origin.
double area_of(const Ring& ring) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    twice +=
        (ring[i].x - ring[0].x) * (ring[i + 1].y - ring[0].y) - (ring[i + 1].x - ring[0].x) * (ring[i].y - ring[0].y);
  return twice / 2;
}

bool is_valid(Part part) { return Region::create({{std::move(part)}, {}, {}}).ok(); }

/// Polygons of parts that are no wider than `off`, as lines: their rings go there and back. Holes as small are left
/// out. Returns how many of both.
std::size_t collapse(RegionData& data, double off) {
  std::size_t collapsed = 0;
  std::vector<Part> parts;
  for (Part& part : data.parts) {
    if (is_valid(part)) {
      parts.push_back(std::move(part));
      continue;
    }
    collapsed += std::erase_if(part.holes, [&](Ring hole) {
      const bool small = std::abs(area_of(hole)) <= 2 * off * length_of(hole);
      std::reverse(hole.begin(), hole.end());
      return small && !is_valid({std::move(hole), {}});
    });
    double inside = area_of(part.outer), around = length_of(part.outer);
    for (const Ring& hole : part.holes) inside += area_of(hole), around += length_of(hole);
    if (is_valid(part) || std::abs(inside) > 2 * off * around) {
      parts.push_back(std::move(part));
      continue;
    }
    ++collapsed;
    part.holes.push_back(std::move(part.outer));
    for (Ring& ring : part.holes) {
      if (ring.size() == 1) {
        data.points.push_back(ring[0]);
        continue;
      }
      if (ring.size() > 2) ring.push_back(ring[0]);
      data.polylines.push_back(std::move(ring));
    }
  }
  data.parts = std::move(parts);
  return collapsed;
}

Result<DiscPolygons> made_with(const DiscSet& set, ArcPolygons polygons, double error, double rounded,
                               std::optional<double> collapse_within = std::nullopt) {
  RegionData data;
  for (const DiscPart& part : set.parts) {
    Part& made = data.parts.emplace_back();
    made.outer = polygons.ring(part.outer);
    for (const DiscRing& hole : part.holes) made.holes.push_back(polygons.ring(hole));
  }
  for (const DiscSegment& segment : set.segments) data.polylines.push_back({segment.from.at, segment.to.at});
  for (const DiscCorner& point : set.points) data.points.push_back(point.at);
  const std::size_t collapsed = collapse_within ? collapse(data, *collapse_within) : 0;
  auto region = Region::create(std::move(data));
  if (!region) return region.error();
  return DiscPolygons{*std::move(region), polygons.made() == 0 ? rounded : error, rounded, polygons.made(), collapsed};
}

}  // namespace

Result<DiscPolygons> to_region(const DiscSet& set, double error, DiscBound bound) {
  // A vertex is a position, or one at an angle from a centre that is: a few roundings more. Or it is another one's, as
  // far away as a position may be off, in each coordinate.
  const double off = set.radius > 0 ? set.at_error : 0, rounded = 4 * off;
  if (!(error > 0) || !std::isfinite(error)) return bad_error("the error of polygons is a positive number");
  if (error < 2 * rounded)
    return bad_error("the error of polygons is below what doubles keep of positions so far from the origin");
  double chords = 0;
  const ArcPolygons counting(set.radius, error - rounded, 0, bound);
  for_each_piece(set, [&](const DiscPiece& piece) {
    if (piece.of != DiscPiece::Of::edge) chords += counting.chords(piece);
  });
  if (chords > kMostChords) return bad_error("polygons of so small an error have more than ten million vertices");
  // Positions that rounding exchanges make rings that cross. They are some units in the last place apart, or as far as
  // positions may be off at most; where nothing crosses, all are kept.
  std::optional<Error> first;
  for (const double together : {0.0, off / 256, off}) {
    Result<DiscPolygons> made = made_with(set, {set.radius, error - rounded, together, bound}, error, rounded);
    if (made) return made;
    if (!first) first = made.error();
  }
  if (bound == DiscBound::nearest && off > 0) {
    Result<DiscPolygons> made = made_with(set, {set.radius, error - rounded, off, bound}, error, rounded, off);
    if (made) return made;
  }
  return changed(*std::move(first));
}

}  // namespace dymsum
