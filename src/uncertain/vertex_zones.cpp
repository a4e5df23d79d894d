// Regions whose vertices are not known exactly: the hulls of neighbouring zones hold the boundary of every variant.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "base/doubles.h"
#include "dymsum/planar_boolean.h"
#include "dymsum/uncertain.h"
#include "exact/orient.h"
#include "uncertain/disc_polygons.h"
#include "uncertain/steps_of_doubles.h"
#include "uncertain/uncertain_internals.h"

namespace dymsum {
namespace {

/// The corners of a convex set in which a vertex is.
using Zone = std::vector<Point>;

/// The convex hull, counter-clockwise, without collinear vertices: two points for a segment, one for a point.
Ring hull_of(std::vector<Point> points) {
  std::sort(points.begin(), points.end(), [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Ring hull;
  const auto chain = [&](auto begin, auto end) {
    const std::size_t first = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= first + 2 && exact::orient_sign(hull[hull.size() - 2], hull.back(), *p) <= 0)
        hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();  // the next chain begins there
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

/// The hulls of the zones of every edge's ends. Where all zones of it are points an edge has none.
class EdgeZones {
 public:
  void add_ring(const std::vector<Zone>& zones, std::size_t first, std::size_t count) {
    for (std::size_t k = 0; k < count; ++k) add_edge(zones[first + k], zones[first + (k + 1) % count], false);
  }
  void add_polyline(const std::vector<Zone>& zones, std::size_t first, std::size_t count) {
    for (std::size_t k = 0; k + 1 < count; ++k) add_edge(zones[first + k], zones[first + k + 1], true);
  }
  void add_point(const Zone& zone) { add_edge(zone, zone, true); }

  RegionData hulls;                 ///< as parts, which overlap
  std::vector<Polyline> polylines;  ///< of polylines and points: hulls without area
  std::vector<Point> points;

 private:
  void add_edge(const Zone& a, const Zone& b, bool thin) {
    if (!thin && a.size() == 1 && b.size() == 1) return;
    Zone both = a;
    both.insert(both.end(), b.begin(), b.end());
    Ring hull = hull_of(std::move(both));
    if (hull.size() >= 3) hulls.parts.push_back({std::move(hull), {}});
    // Of a ring's edge such a hull is a piece of the line that it moves along: it bounds nothing new.
    else if (thin && hull.size() == 2) polylines.push_back(hull);
    else if (thin) points.push_back(hull[0]);
  }
};

EdgeZones edge_zones(const Region& nominal, const std::vector<Zone>& zones) {
  EdgeZones made;
  std::size_t first = 0;
  const auto ring = [&](const Ring& r) {
    made.add_ring(zones, first, r.size());
    first += r.size();
  };
  for (const Part& part : nominal.parts()) {
    ring(part.outer);
    for (const Ring& hole : part.holes) ring(hole);
  }
  for (const Polyline& line : nominal.polylines()) {
    made.add_polyline(zones, first, line.size());
    first += line.size();
  }
  for (std::size_t k = 0; k < nominal.points().size(); ++k) made.add_point(zones[first + k]);
  return made;
}

// The lemma of docs/design/uncertain.md: off the hulls, nothing changes sides.
Result<Uncertain> of_zones(const Region& nominal, const std::vector<Zone>& zones, double error) {
  if (std::all_of(zones.begin(), zones.end(), [](const Zone& z) { return z.size() == 1; }))
    return Uncertain::known(nominal);
  const EdgeZones edges = edge_zones(nominal, zones);
  RegionData rings = edges.hulls;
  rings.parts.insert(rings.parts.end(), nominal.parts().begin(), nominal.parts().end());
  Result<PlanarSum> outer = filled(rings, Fill::nonzero);
  if (outer && !(edges.polylines.empty() && edges.points.empty())) {
    const Result<Region> thin = Region::create({{}, edges.polylines, edges.points});
    if (!thin) return thin.error();
    outer = united(*outer, *thin);
  }
  if (!outer) return outer.error();
  const Result<PlanarSum> hulls = filled(edges.hulls, Fill::nonzero);
  if (!hulls) return hulls.error();
  SumOptions regular;
  regular.semantics = Semantics::regular;
  Result<PlanarSum> inner = difference(uncertain::parts_of(nominal), *hulls, regular);
  if (!inner) return inner.error();
  return UncertainInternals::pair(*std::move(inner), *std::move(outer), error);
}

/// All vertices, by index.
std::vector<Point> vertices_of(const Region& region) {
  std::vector<Point> all;
  const auto add = [&](const std::vector<Point>& chain) { all.insert(all.end(), chain.begin(), chain.end()); };
  for (const Part& part : region.parts()) {
    add(part.outer);
    for (const Ring& hole : part.holes) add(hole);
  }
  for (const Polyline& line : region.polylines()) add(line);
  add(region.points());
  return all;
}

Error zone_error(const std::string& message, std::size_t vertex) {
  Error error{ErrorCode::out_of_range, message, {}};
  error.evidence.vertex = static_cast<std::int64_t>(vertex);
  return error;
}

std::optional<Error> count_error(std::size_t zones, std::size_t vertices, const char* what) {
  if (zones == vertices) return std::nullopt;
  return Error{ErrorCode::out_of_range,
               "there are " + std::to_string(zones) + " " + what + " for " + std::to_string(vertices) + " vertices",
               {}};
}

}  // namespace

Result<Uncertain> Uncertain::of_boxes(const Region& nominal, std::span<const std::array<double, 4>> boxes) {
  const std::vector<Point> vertices = vertices_of(nominal);
  if (std::optional<Error> error = count_error(boxes.size(), vertices.size(), "boxes")) return *std::move(error);
  std::vector<Zone> zones;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    const auto [x0, y0, x1, y1] = boxes[k];
    if (!(x0 <= vertices[k].x && vertices[k].x <= x1 && y0 <= vertices[k].y && vertices[k].y <= y1) ||
        !std::isfinite(x1 - x0) || !std::isfinite(y1 - y0))
      return zone_error("the box is not around its vertex", k);
    zones.push_back(hull_of({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}));
  }
  return of_zones(nominal, zones, 0);
}

Result<Uncertain> Uncertain::of_discs(const Region& nominal, std::span<const double> radii, int sides) {
  const std::vector<Point> vertices = vertices_of(nominal);
  if (std::optional<Error> error = count_error(radii.size(), vertices.size(), "radii")) return *std::move(error);
  std::vector<Zone> zones;
  double largest = 0;
  for (std::size_t k = 0; k < radii.size(); ++k) {
    if (const Result<void> checked = uncertain::check_disc(radii[k], sides); !checked)
      return zone_error(checked.error().message, k);
    const Point at = vertices[k];
    zones.push_back({at});
    if (radii[k] == 0) continue;
    Zone zone;
    const Region disc = uncertain::polygon_around(radii[k], sides);
    for (const Point& p : disc.parts()[0].outer)
      zone.push_back({uncertain::sum_outwards(at.x, p.x), uncertain::sum_outwards(at.y, p.y)});
    zones.back() = hull_of(std::move(zone));
    largest = std::max(
        largest, uncertain::polygon_error(radii[k], sides) + 0x1p-51 * (std::abs(at.x) + std::abs(at.y) + radii[k]));
  }
  return of_zones(nominal, zones, largest);
}

Result<Uncertain> Uncertain::of_rounding(const Region& nominal, std::int64_t ulps) {
  if (ulps < 0 || ulps > std::int64_t{1} << 40)
    return Error{
        ErrorCode::out_of_range, "units in the last place are from 0 to 2^40, not " + std::to_string(ulps), {}};
  std::vector<std::array<double, 4>> boxes;
  for (const Point& v : vertices_of(nominal)) {
    boxes.push_back({uncertain::steps_from(v.x, -ulps), uncertain::steps_from(v.y, -ulps),
                     uncertain::steps_from(v.x, ulps), uncertain::steps_from(v.y, ulps)});
    for (const double c : boxes.back())
      if (!std::isfinite(c)) return zone_error("a coordinate may be infinite", boxes.size() - 1);
  }
  return of_boxes(nominal, boxes);
}

}  // namespace dymsum
