// Planar regions: the one planar set type. A region is the union of closed polygonal parts with holes, polylines and
// points; it may be empty.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "dymsum/result.h"

namespace dymsum {

namespace planar {
class PreparedRegion;
struct RegionInternals;
}  // namespace planar

struct Point {
  double x = 0, y = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

/// A closed polygon boundary; the last vertex is joined to the first and not repeated.
using Ring = std::vector<Point>;
/// An open chain of segments through its vertices; closed when the last vertex equals the first.
using Polyline = std::vector<Point>;

/// A connected piece of the plane: inside `outer` (counter-clockwise), outside every hole (clockwise).
struct Part {
  Ring outer;
  std::vector<Ring> holes;
  friend bool operator==(const Part&, const Part&) = default;
};

/// The plain lists a region is made from, not yet validated.
struct RegionData {
  std::vector<Part> parts;
  std::vector<Polyline> polylines;
  std::vector<Point> points;
  friend bool operator==(const RegionData&, const RegionData&) = default;
};

/// A valid region. Coordinates are doubles taken at face value: no snapping, no tolerance.
///
/// Valid means, exactly: all coordinates finite; rings have at least three vertices, no two consecutive ones equal,
/// enclose area, and do not cross or run along themselves or each other (touching at single points is allowed); outer
/// rings run counter-clockwise, holes clockwise and inside their outer ring; parts share no interior points. Collinear
/// vertices are allowed. Polylines have at least two vertices, no two consecutive ones equal; they and points may lie
/// anywhere.
///
/// Vertices have indices through the whole region: part by part, outer ring then holes, then polylines, then points.
/// The edge that starts at a vertex has that vertex's index (the last vertex of a polyline and a point start none).
class Region {
 public:
  Region() = default;  ///< the empty region

  /// Validates `data`. Errors: not_finite, too_few_vertices, repeated_vertex, no_area, wrong_orientation,
  /// self_crossing, rings_cross, hole_outside, parts_overlap, each with part, ring, vertex (and the other ones) and a
  /// position. Cost: O(n log n) for n vertices in practice.
  static Result<Region> create(RegionData data);

  const RegionData& data() const { return data_; }
  const std::vector<Part>& parts() const { return data_.parts; }
  const std::vector<Polyline>& polylines() const { return data_.polylines; }
  const std::vector<Point>& points() const { return data_.points; }

  /// Points at which rings touch themselves or each other, sorted; usually none.
  const std::vector<Point>& touching_points() const { return touching_points_; }

  bool empty() const;
  std::size_t vertex_count() const;
  std::size_t hole_count() const;

  /// The same set written in the one canonical way: collinear vertices dropped, every ring and closed polyline starting
  /// at its lexicographically smallest vertex, open polylines at the smaller end, everything sorted, duplicates of
  /// polylines and points dropped. Rings of touching parts keep the cut they were given with.
  Region canonical() const;

  /// Equality of canonical forms.
  friend bool operator==(const Region& a, const Region& b);

 private:
  friend struct planar::RegionInternals;
  RegionData data_;
  std::vector<Point> touching_points_;
  std::shared_ptr<planar::PreparedRegion> prepared_;  // what sums keep of it; shared by copies
};

/// What repair changed, as counts and in words.
struct RepairReport {
  std::size_t duplicate_vertices = 0;   ///< consecutive equal vertices merged, closing vertices dropped
  std::size_t collinear_vertices = 0;   ///< vertices inside straight lines, and spikes, dropped
  std::size_t reversed_rings = 0;       ///< outer rings made counter-clockwise, holes made clockwise
  std::size_t dropped_rings = 0;        ///< rings that enclosed nothing
  std::size_t polylines_to_points = 0;  ///< polylines that are one point, made points
  bool changed() const {
    return duplicate_vertices + collinear_vertices + reversed_rings + dropped_rings + polylines_to_points > 0;
  }
  std::string to_string() const;
};

struct Repaired {
  Region region;
  RepairReport report;
};

/// The named repair: merges duplicate vertices, drops collinear vertices, spikes and empty rings, fixes orientation,
/// and reports what it changed. Polylines lose duplicate vertices and vertices inside straight lines, but not
/// their folds. Crossings and misplaced holes are not repaired: they come back as the errors of Region::create, with
/// the indices of `data`.
Result<Repaired> repair(RegionData data);

/// The area for reports: the exact sum of products of coordinates, rounded once. (Not quite exact are only products
/// 2^900 times smaller than the product of the largest |x| and the largest |y|.) Infinite past the double range.
double area(const Region& region);

/// The root of the mean square distance of the parts' points from the origin: the natural length per radian of a region
/// that turns about it. Within 2^-50 of itself, however thin the parts; 0 without parts. O(n) operations with integers
/// as long as its coordinates together.
double radius_of_gyration(const Region& region);

/// Smallest and largest coordinates {min x, min y, max x, max y}; zeros for the empty region.
std::array<double, 4> bounds(const Region& region);

/// -region: the reflection through the origin. Exact.
Region negated(const Region& region);

/// region + (dx, dy), each coordinate rounded to the nearest double. Errors as Region::create when rounding spoils
/// validity.
Result<Region> translated(const Region& region, double dx, double dy);

/// diag(sx, sy) region, each coordinate rounded to the nearest double (exact for powers of two); a reflecting scale
/// keeps orientation valid. Errors: unsupported_operand for zero or non-finite factors, then as Region::create.
Result<Region> scaled(const Region& region, double sx, double sy);

}  // namespace dymsum
