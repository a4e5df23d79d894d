// Chords and tangents in place of arcs.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "dymsum/growing_disc.h"
#include "dymsum/planar_sum.h"
#include "dymsum/region.h"
#include "dymsum/snap_rounding.h"

namespace dymsum::shape {
namespace {

// Polygons of which parts of the boundary are nearer to each other than their vertices are known.

struct MergedPolygons {
  RegionData data;
  std::size_t merged = 0;  ///< intervals of boundary along which two sides are one, and rings that are one point
  double moved = 0;        ///< no point of the boundary is further than this from what it was
};

using Indices = std::vector<std::uint32_t>;

/// Positions that stand for all vertices near them.
class Positions {
 public:
  explicit Positions(double near) : near_(near) {}

  std::uint32_t of(Point p) {
    const Cell here = cell(p);
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const auto found = cells_.find({here.first + dx, here.second + dy});
        if (found == cells_.end()) continue;
        for (const std::uint32_t i : found->second)
          if (std::abs(at_[i].x - p.x) <= near_ && std::abs(at_[i].y - p.y) <= near_) return i;
      }
    at_.push_back(p);
    cells_[here].push_back(std::uint32_t(at_.size() - 1));
    return std::uint32_t(at_.size() - 1);
  }

  Point at(std::uint32_t i) const { return at_[i]; }

  /// Once all are known.
  void sort() {
    for (std::uint32_t i = 0; i < at_.size(); ++i) by_x_.push_back(i);
    std::sort(by_x_.begin(), by_x_.end(), [&](std::uint32_t i, std::uint32_t j) { return at_[i].x < at_[j].x; });
  }
  /// Those near a segment, and not its ends, in its order.
  Indices along(std::uint32_t from, std::uint32_t to) const {
    const Point a = at_[from], b = at_[to];
    const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    std::vector<std::pair<double, std::uint32_t>> found;
    const auto first = std::partition_point(by_x_.begin(), by_x_.end(),
                                            [&](std::uint32_t i) { return at_[i].x < std::min(a.x, b.x) - near_; });
    for (auto k = first; k != by_x_.end() && at_[*k].x <= std::max(a.x, b.x) + near_; ++k) {
      const double px = at_[*k].x - a.x, py = at_[*k].y - a.y;
      const double t = (px * dx + py * dy) / length, off = (px * dy - py * dx) / length;
      if (*k != from && *k != to && t > 0 && t < length && std::abs(off) <= near_) found.push_back({t, *k});
    }
    std::sort(found.begin(), found.end());
    Indices made;
    for (const auto& [t, i] : found) made.push_back(i);
    return made;
  }

 private:
  using Cell = std::pair<std::int64_t, std::int64_t>;
  Cell cell(Point p) const { return {std::int64_t(std::floor(p.x / near_)), std::int64_t(std::floor(p.y / near_))}; }

  double near_;
  std::vector<Point> at_;
  std::map<Cell, Indices> cells_;
  Indices by_x_;
};

double area_of(const Ring& ring) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    twice +=
        (ring[i].x - ring[0].x) * (ring[i + 1].y - ring[0].y) - (ring[i + 1].x - ring[0].x) * (ring[i].y - ring[0].y);
  return twice / 2;
}

/// Whether a ray towards +x crosses the ring an odd number of times.
bool is_around(const Ring& ring, Point p) {
  bool odd = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
  }
  return odd;
}

class Merger {
 public:
  Merger(const RegionData& data, double near) : positions_(near) {
    made_.data.polylines = data.polylines, made_.data.points = data.points;
    std::vector<Indices> rings;
    const auto see = [&](const Ring& ring) {
      Indices positions;
      for (const Point& p : ring)
        if (const std::uint32_t i = positions_.of(p); positions.empty() || positions.back() != i)
          positions.push_back(i);
      while (positions.size() > 1 && positions.front() == positions.back()) positions.pop_back();
      rings.push_back(std::move(positions));
    };
    for (const Part& part : data.parts) {
      see(part.outer);
      for (const Ring& hole : part.holes) see(hole);
    }
    positions_.sort();
    // A vertex is moved once, and an edge with every position that it is bent to: bends of bends are not followed.
    made_.moved = 4 * near;
    for (const Indices& ring : rings) add(ring);
  }

  MergedPolygons run() {
    take_twins_out();
    collect();
    keep_thin();
    return std::move(made_);
  }

 private:
  struct Half {
    std::uint32_t from, to, next, previous;
    bool gone = false;
  };

  void add(const Indices& ring) {
    if (ring.size() == 1) {
      made_.data.points.push_back(positions_.at(ring[0]));
      ++made_.merged;
      return;
    }
    Indices bent;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      bent.push_back(ring[i]);
      const Indices between = positions_.along(ring[i], ring[(i + 1) % ring.size()]);
      bent.insert(bent.end(), between.begin(), between.end());
    }
    const auto first = std::uint32_t(halves_.size()), count = std::uint32_t(bent.size());
    for (std::uint32_t k = 0; k < count; ++k)
      halves_.push_back({bent[k], bent[(k + 1) % count], first + (k + 1) % count, first + (k + count - 1) % count});
  }

  void take_twins_out() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, Indices> open;
    for (std::uint32_t h = 0; h < halves_.size(); ++h) {
      const auto twin = open.find({halves_[h].to, halves_[h].from});
      if (twin == open.end() || twin->second.empty()) {
        open[{halves_[h].from, halves_[h].to}].push_back(h);
        continue;
      }
      const std::uint32_t g = twin->second.back();
      twin->second.pop_back();
      thin_.push_back({halves_[h].from, halves_[h].to});
      const Half there = halves_[h], back = halves_[g];
      halves_[h].gone = halves_[g].gone = true;
      if (there.previous != g) link(there.previous, back.next);
      if (back.previous != h) link(back.previous, there.next);
    }
  }
  void link(std::uint32_t first, std::uint32_t second) {
    halves_[first].next = second;
    halves_[second].previous = first;
  }

  void collect() {
    std::vector<Ring> holes;
    std::vector<std::uint8_t> done(halves_.size(), 0);
    for (std::uint32_t start = 0; start < halves_.size(); ++start) {
      if (done[start] || halves_[start].gone) continue;
      Ring ring;
      for (std::uint32_t h = start; !done[h]; h = halves_[h].next) {
        done[h] = 1;
        ring.push_back(positions_.at(halves_[h].from));
      }
      if (area_of(ring) > 0) made_.data.parts.push_back({std::move(ring), {}});
      else holes.push_back(std::move(ring));
    }
    for (Ring& hole : holes) {
      // The middle of an edge: rings touch at vertices.
      const Point at{(hole[0].x + hole[1].x) / 2, (hole[0].y + hole[1].y) / 2};
      Part* around = nullptr;
      for (Part& part : made_.data.parts)
        if (is_around(part.outer, at) && (around == nullptr || area_of(part.outer) < area_of(around->outer)))
          around = &part;
      if (around != nullptr) around->holes.push_back(std::move(hole));
    }
  }

  /// What lies inside of a part on both sides is none of its boundary any more.
  void keep_thin() {
    for (const auto& [a, b] : thin_) {
      const Point from = positions_.at(a), to = positions_.at(b), at{(from.x + to.x) / 2, (from.y + to.y) / 2};
      const bool inside = std::any_of(made_.data.parts.begin(), made_.data.parts.end(), [&](const Part& part) {
        return is_around(part.outer, at) && std::none_of(part.holes.begin(), part.holes.end(),
                                                         [&](const Ring& hole) { return is_around(hole, at); });
      });
      ++made_.merged;
      if (!inside) made_.data.polylines.push_back({from, to});
    }
  }

  Positions positions_;
  std::vector<Half> halves_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> thin_;
  MergedPolygons made_;
};

/// Vertices within `near` of each other in both coordinates are one, and a vertex within `near` of an edge is on it.
/// Where two edges are then one, there and back, the set is as thin as that, and has a polyline there, or what is
/// beside it is, and both go; the other edges go on as the faces of a plane graph do where an edge is deleted. Holes
/// lie in the innermost ring around them. Nothing here is exact: Region::create judges. O(n log n) for rings of short
/// edges.
MergedPolygons merged_polygons(const RegionData& data, double near) { return Merger(data, near).run(); }

}  // namespace
}  // namespace dymsum::shape

namespace dymsum {

// Chords and tangents in place of arcs.

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
