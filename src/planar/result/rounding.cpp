#include "planar/result/rounding.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "base/double_text.h"
#include "exact/orient.h"
#include "planar/region/snapped_rings.h"
#include "planar/result/result_region.h"

namespace dymsum::planar {

namespace {

using VertexOnEdge = SumSkeleton::VertexOnEdge;

/// The edges after rounding: edge e runs through path[first[e]], ..., path[first[e + 1] - 1], vertices of the skeleton.
struct BentEdges {
  std::vector<std::uint32_t> path;
  std::vector<std::size_t> first;
  bool any = false;
};

Error changed(const SumSkeleton& skeleton, std::string what, std::uint32_t vertex, std::uint32_t other) {
  Error error{ErrorCode::rounding_changed_topology, "rounding to doubles " + std::move(what), {}};
  const auto chain_of = [&](std::uint32_t v) {
    return *std::find_if(skeleton.chains.begin(), skeleton.chains.end(),
                         [v](const SumSkeleton::Chain& c) { return v < c.first + c.count; });
  };
  const SumSkeleton::Chain a = chain_of(vertex), b = chain_of(other);
  error.evidence.part = a.part;
  error.evidence.ring = a.ring;
  if (a.part) error.evidence.vertex = vertex - a.first;
  error.evidence.other_part = b.part;
  error.evidence.other_ring = b.ring;
  if (b.part) error.evidence.other_vertex = other - b.first;
  error.evidence.x = skeleton.nearest[vertex].x;
  error.evidence.y = skeleton.nearest[vertex].y;
  return error;
}

std::optional<Error> check_finite_positions(const SumSkeleton& skeleton) {
  for (const std::uint32_t v : skeleton.positions) {
    const Point p = skeleton.nearest[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return changed(skeleton, "leaves the range of doubles", v, v);
  }
  return std::nullopt;
}

/// Bends every edge that a contact of its own leaves: through all its contacts, in their order along it.
BentEdges bend_edges(const SumSkeleton& skeleton, const std::vector<VertexOnEdge>& contacts) {
  BentEdges bent;
  auto next = contacts.begin();
  for (std::uint32_t e = 0; e < skeleton.edges.size(); ++e) {
    const SumSkeleton::Edge& edge = skeleton.edges[e];
    const Point a = skeleton.nearest[edge.from], b = skeleton.nearest[edge.to];
    const auto end = std::find_if(next, contacts.end(), [e](const VertexOnEdge& c) { return c.edge != e; });
    const bool leaves = std::any_of(
        next, end, [&](const VertexOnEdge& c) { return exact::orient_sign(a, b, skeleton.nearest[c.vertex]) != 0; });
    bent.first.push_back(bent.path.size());
    bent.path.push_back(edge.from);
    if (leaves)
      for (auto c = next; c != end; ++c) bent.path.push_back(c->vertex);
    bent.path.push_back(edge.to);
    bent.any = bent.any || leaves;
    next = end;
  }
  bent.first.push_back(bent.path.size());
  return bent;
}

/// A vertex on an edge now that was not on it before. (In the box of an edge and on its line is on the edge.)
std::optional<Error> check_no_new_contact(const SumSkeleton& skeleton, const std::vector<VertexOnEdge>& contacts,
                                          const BentEdges& bent) {
  std::optional<Error> error;
  for (std::uint32_t e = 0; e < skeleton.edges.size() && !error; ++e) {
    const auto known = std::equal_range(contacts.begin(), contacts.end(), VertexOnEdge{e, 0},
                                        [](const VertexOnEdge& a, const VertexOnEdge& b) { return a.edge < b.edge; });
    for (std::size_t i = bent.first[e]; i + 1 < bent.first[e + 1]; ++i) {
      const std::uint32_t from = skeleton.position[bent.path[i]], to = skeleton.position[bent.path[i + 1]];
      const Point a = skeleton.nearest[from], b = skeleton.nearest[to];
      skeleton.visit_positions_in_box(a, b, [&](std::uint32_t v) {
        if (v == from || v == to || exact::orient_sign(a, b, skeleton.nearest[v]) != 0) return;
        if (std::find(known.first, known.second, VertexOnEdge{e, v}) != known.second) return;
        error = changed(skeleton, "moves a vertex onto an edge", v, skeleton.edges[e].from);
      });
    }
  }
  return error;
}

bool cross_properly(Point a, Point b, Point c, Point d) {
  if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) ||
      std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y))
    return false;
  return exact::orient_sign(a, b, c) * exact::orient_sign(a, b, d) < 0 &&
         exact::orient_sign(c, d, a) * exact::orient_sign(c, d, b) < 0;
}

int count_crossings(const SumSkeleton& skeleton, const BentEdges& bent, std::uint32_t e, std::uint32_t f) {
  const auto at = [&](std::size_t i) { return skeleton.nearest[bent.path[i]]; };
  int count = 0;
  for (std::size_t i = bent.first[e]; i + 1 < bent.first[e + 1]; ++i)
    for (std::size_t j = bent.first[f]; j + 1 < bent.first[f + 1]; ++j)
      count += cross_properly(at(i), at(i + 1), at(j), at(j + 1));
  return count;
}

/// True when some vertex lies inside both edges: there they stay joined.
bool share_contact(const std::vector<VertexOnEdge>& contacts, std::uint32_t e, std::uint32_t f) {
  return std::any_of(contacts.begin(), contacts.end(), [&](const VertexOnEdge& c) {
    return c.edge == e && std::find(contacts.begin(), contacts.end(), VertexOnEdge{f, c.vertex}) != contacts.end();
  });
}

/// Region::create looks at rings only: the crossings of segments with everything before them in the list.
std::optional<Error> check_segment_crossings(const SumSkeleton& skeleton, const std::vector<VertexOnEdge>& contacts,
                                             const BentEdges& bent) {
  for (std::uint32_t s = 0; s < skeleton.edges.size(); ++s) {
    if (skeleton.chains[skeleton.edges[s].chain].closed) continue;
    const Spot& a = skeleton.spot(skeleton.edges[s].from);
    const Spot& b = skeleton.spot(skeleton.edges[s].to);
    for (std::uint32_t e = 0; e < s; ++e) {
      const SumSkeleton::Edge& edge = skeleton.edges[e];
      const bool before = cross_properly(a, b, skeleton.spot(edge.from), skeleton.spot(edge.to));
      const int after = count_crossings(skeleton, bent, s, e);
      if (after != (before ? 1 : 0) && !(before && after == 0 && share_contact(contacts, s, e)))
        return changed(skeleton, "makes or loses a crossing of a segment", skeleton.edges[s].from, edge.from);
    }
  }
  return std::nullopt;
}

RegionData region_data(const SumSkeleton& skeleton, const BentEdges& bent) {
  RegionData data;
  std::size_t edge = 0;
  for (const SumSkeleton::Chain& chain : skeleton.chains) {
    const std::size_t edge_count = chain.closed ? chain.count : chain.count - 1;
    std::vector<Point> points;
    for (const std::size_t end = edge + edge_count; edge < end; ++edge)
      for (std::size_t i = bent.first[edge]; i + 1 < bent.first[edge + 1]; ++i)
        points.push_back(skeleton.nearest[bent.path[i]]);
    if (!chain.closed) points.push_back(skeleton.nearest[chain.first + chain.count - 1]);
    if (!chain.closed && chain.count == 1) data.points.push_back(points.front());
    else if (!chain.closed) data.polylines.push_back(std::move(points));
    else if (*chain.ring == 0) data.parts.push_back({std::move(points), {}});
    else data.parts.back().holes.push_back(std::move(points));
  }
  return data;
}

/// An error about rounded data, in the sum's terms. Bent edges have vertices that the sum does not number.
Error spoiled(Error error, bool bent) {
  error.code = ErrorCode::rounding_changed_topology;
  error.message = "rounding to doubles makes an invalid region: " + error.message;
  if (bent) error.evidence.vertex = error.evidence.other_vertex = std::nullopt;
  return error;
}

/// Points that rounding made equal, once each.
std::size_t merge_equal_points(std::vector<Point>& points) {
  const std::size_t before = points.size();
  std::sort(points.begin(), points.end(), [](Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return before - points.size();
}

/// Requires finite positions.
Result<Region> nearest_region(const SumSkeleton& skeleton) {
  if (const auto pair = skeleton.first_collision())
    return changed(skeleton, "makes two vertices equal", pair->first, pair->second);
  const std::vector<VertexOnEdge> contacts = skeleton.contacts();
  const BentEdges bent = bend_edges(skeleton, contacts);
  if (auto error = check_no_new_contact(skeleton, contacts, bent)) return *std::move(error);
  if (auto error = check_segment_crossings(skeleton, contacts, bent)) return *std::move(error);
  Result<Region> region = Region::create(region_data(skeleton, bent));
  if (!region) return spoiled(region.error(), bent.any);
  return region;
}

double ulp_of(double largest) { return std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest; }

/// The largest |x| and the largest |y|.
Point largest_coordinates(const SumSkeleton& skeleton) {
  Point largest;
  for (const std::uint32_t v : skeleton.positions) {
    largest.x = std::max(largest.x, std::abs(skeleton.nearest[v].x));
    largest.y = std::max(largest.y, std::abs(skeleton.nearest[v].y));
  }
  return largest;
}

/// Positions with the doubles of another one: `positions` are sorted by these.
std::size_t merged_positions(const SumSkeleton& skeleton) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < skeleton.positions.size(); ++i)
    count += skeleton.nearest[skeleton.positions[i]] == skeleton.nearest[skeleton.positions[i - 1]];
  return count;
}

}  // namespace

Result<Region> rounded(const PlanarSum& sum) {
  const SumSkeleton skeleton(sum);
  if (auto error = check_finite_positions(skeleton)) return *std::move(error);
  return nearest_region(skeleton);
}

Result<SnapRounded> snap_rounded(const PlanarSum& sum) {
  const SumSkeleton skeleton(sum);
  if (auto error = check_finite_positions(skeleton)) return *std::move(error);
  Rounding rounding;
  const Point largest = largest_coordinates(skeleton);
  double moved = std::hypot(ulp_of(largest.x) / 2, ulp_of(largest.y) / 2);
  Result<Region> region = nearest_region(skeleton);
  if (!region) {
    SnappedRings snapped = snapped_rings(region_data(skeleton, bend_edges(skeleton, skeleton.contacts())));
    rounding = {.nearest = false,
                .merged_vertices = merged_positions(skeleton),
                .collapsed_edges = snapped.collapsed_edges,
                .bends = snapped.bends,
                .lines = snapped.lines,
                .points = snapped.points,
                .vanished_rings = snapped.vanished_rings};
    moved += snapped.moved;
    region = Region::create(std::move(snapped.data));
    if (!region) throw std::logic_error("snapped rings are no region: " + region.error().to_string());
  }
  if (skeleton.positions.empty()) moved = 0;
  rounding.moved = moved * (1 + 0x1p-50);  // of a few roundings
  rounding.moved_ulps = rounding.moved / ulp_of(std::max(largest.x, largest.y));
  return SnapRounded{std::move(region).value(), rounding};
}

Result<Repaired> rounded_with_repair(const PlanarSum& sum) {
  const SumSkeleton skeleton(sum);
  if (auto error = check_finite_positions(skeleton)) return *std::move(error);
  const BentEdges bent = bend_edges(skeleton, skeleton.contacts());
  RegionData data = region_data(skeleton, bent);
  const std::size_t merged = merge_equal_points(data.points);
  Result<Repaired> result = repair(std::move(data));
  if (!result) return spoiled(result.error(), bent.any);
  Repaired repaired = std::move(result).value();
  repaired.report.duplicate_vertices += merged;
  return repaired;
}

}  // namespace dymsum::planar

namespace dymsum {

std::string Rounding::to_string() const {
  if (nearest) return "nearest doubles";
  std::string text;
  const auto add = [&text](std::size_t count, const char* one, const char* many) {
    if (count > 0) text += std::to_string(count) + " " + (count == 1 ? one : many) + ", ";
  };
  add(merged_vertices, "vertex merged", "vertices merged");
  add(collapsed_edges, "edge collapsed", "edges collapsed");
  add(bends, "bend where edges meet", "bends where edges meet");
  add(lines, "line for what is thinner than doubles", "lines for what is thinner than doubles");
  add(points, "point for what is smaller", "points for what is smaller");
  add(vanished_rings, "ring vanished", "rings vanished");
  return text + "moved by at most " + base::general_text(moved, 2) + " (" + base::general_text(moved_ulps, 2) +
         " units in the last place of the largest coordinate)";
}

}  // namespace dymsum
