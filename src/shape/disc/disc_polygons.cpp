// Chords and tangents in place of arcs.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "dymsum/growing_disc.h"
#include "dymsum/planar_sum.h"
#include "dymsum/snap_rounding.h"
#include "shape/disc/merged_polygons.h"

namespace dymsum {

namespace {

constexpr double kMostChords = 1e7;

/// Replaces arcs by polygons that leave them by at most `error`.
class ArcPolygons {
 public:
  /// Vertices as near to each other as `together` in both coordinates are one.
  ArcPolygons(double radius, double error, double together, DiscBound bound)
      : radius_(radius), together_(together), bound_(bound) {
    // Half of the angle of a chord whose midpoint is `error` off, of a tangent whose end is.
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

RegionData polygons_of(const DiscSet& set, ArcPolygons& polygons) {
  RegionData data;
  for (const DiscPart& part : set.parts) {
    Part& made = data.parts.emplace_back();
    made.outer = polygons.ring(part.outer);
    for (const DiscRing& hole : part.holes) made.holes.push_back(polygons.ring(hole));
  }
  for (const DiscSegment& segment : set.segments) data.polylines.push_back({segment.from.at, segment.to.at});
  for (const DiscCorner& point : set.points) data.points.push_back(point.at);
  return data;
}

/// Polygons nearest to a set, as small an error as they need to be a region.
Result<DiscPolygons> nearest_polygons(const DiscSet& set, double error) {
  for (;; error /= 16) {
    Result<DiscPolygons> made = to_region(set, error, DiscBound::nearest);
    if (made || made.error().code != ErrorCode::rounding_changed_topology) return made;
  }
}

Region with_area_alone(const Region& region) { return Region::create({region.parts(), {}, {}}).value(); }

/// Polygons on one side of a set where chords and tangents are no region, by a margin from those nearest to it. What
/// of one of the two is not in the other lies within the error of both boundaries, or of polylines and points of the
/// polygons. So with a square of that size all about them they hold the set; and where such a square fits into them
/// they lie in it.
Result<DiscPolygons> by_margin(const DiscSet& set, double error, DiscBound bound) {
  const Result<DiscPolygons> nearest = nearest_polygons(set, error);
  if (!nearest) return nearest.error();
  const double margin = nearest->error * (1 + 0x1p-40);
  const Region square =
      Region::create({{{{{-margin, -margin}, {margin, -margin}, {margin, margin}, {-margin, margin}}, {}}}, {}, {}})
          .value();
  const bool grows = bound == DiscBound::outside;
  const Result<PlanarSum> sum =
      grows ? minkowski_sum(nearest->region, square) : erode(with_area_alone(nearest->region), square);
  if (!sum) return sum.error();
  const Result<SnapRounded> made = snap_rounded(*sum);
  if (!made) return made.error();
  DiscPolygons polygons = *nearest;
  polygons.region = made->region;
  polygons.rounded += made->rounding.moved;
  polygons.error += std::sqrt(2.0) * margin + made->rounding.moved;
  if (!grows) polygons.collapsed = std::max<std::size_t>(1, polygons.collapsed);
  return polygons;
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
    ArcPolygons polygons(set.radius, error - rounded, together, bound);
    Result<Region> region = Region::create(polygons_of(set, polygons));
    if (region)
      return DiscPolygons{*std::move(region), polygons.made() == 0 ? rounded : error, rounded, polygons.made(), 0};
    if (!first) first = region.error();
  }
  if (bound == DiscBound::nearest && off > 0) {
    ArcPolygons polygons(set.radius, error - rounded, 0, bound);
    shape::MergedPolygons merged = shape::merged_polygons(polygons_of(set, polygons), rounded);
    Result<Region> region = Region::create(std::move(merged.data));
    if (region)
      return DiscPolygons{*std::move(region), error + merged.moved, rounded + merged.moved, polygons.made(),
                          merged.merged};
  }
  if (bound == DiscBound::nearest || off == 0) return changed(*std::move(first));
  const Result<DiscPolygons> made = by_margin(set, std::max(error / 4, 2 * rounded), bound);
  return made ? made : changed(*std::move(first));
}

}  // namespace dymsum
