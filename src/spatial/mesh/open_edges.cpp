#include "spatial/mesh/open_edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/doubles.h"
#include "exact/orient.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::spatial {

namespace {

constexpr double kCrack = 0x1p-20, kHole = 0.5;  // of the diagonal
constexpr std::size_t kMostEdges = 64, kMostEdgesOfGiven = 4096;

double apart(const Point3& a, const Point3& b) { return base::hypot3(a.x - b.x, a.y - b.y, a.z - b.z); }

/// The diagonal of the box around all vertices that faces use.
double diagonal(const std::vector<Point3>& vertices, const std::vector<Face>& faces) {
  bool any = false;
  Point3 low, high;
  for (const Face& face : faces) {
    for (const std::uint32_t v : face) {
      const Point3& p = vertices[v];
      if (!std::exchange(any, true)) low = high = p;
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  }
  return apart(low, high);
}

std::vector<std::uint32_t> open_half_edges(const HalfEdges& edges) {
  std::vector<std::uint32_t> open;
  const std::vector<EdgeSide> sides = edge_sides(edges);
  for_each_edge(sides, [&](const EdgeSide* first, const EdgeSide* last) {
    if (last - first == 1) open.push_back(first->half_edge);
  });
  std::sort(open.begin(), open.end());
  return open;
}

/// Pairs of vertices that have a face in common, sorted.
std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_in_faces(const std::vector<Face>& faces,
                                                                    const std::vector<bool>& counts) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const Face& face : faces) {
    Face some;
    std::copy_if(face.begin(), face.end(), std::back_inserter(some), [&](std::uint32_t v) { return counts[v]; });
    if (some.size() > kMostEdges) continue;
    for (const std::uint32_t a : some)
      for (const std::uint32_t b : some)
        if (a < b) pairs.emplace_back(a, b);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

ClosedCracks close_cracks(const std::vector<Point3>& vertices, std::vector<Face>& faces, std::optional<double> width) {
  ClosedCracks closed;
  const HalfEdges edges = half_edges_without_twins(faces);
  std::vector<bool> is_open(vertices.size());
  for (const std::uint32_t h : open_half_edges(edges)) is_open[edges.origin[h]] = is_open[edges.target(h)] = true;
  std::vector<std::uint32_t> order;
  for (std::uint32_t v = 0; v < vertices.size(); ++v)
    if (is_open[v]) order.push_back(v);
  if (order.empty()) return closed;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(vertices[a].x, vertices[a].y, vertices[a].z, a) <
           std::tie(vertices[b].x, vertices[b].y, vertices[b].z, b);
  });
  const auto neighbours = pairs_in_faces(faces, is_open);
  const double near = width ? *width : kCrack * diagonal(vertices, faces);
  std::vector<std::uint32_t> name(vertices.size());
  std::iota(name.begin(), name.end(), 0u);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::uint32_t a = order[i];
    if (name[a] != a) continue;
    for (std::size_t j = i + 1; j < order.size() && vertices[order[j]].x - vertices[a].x <= near; ++j) {
      const std::uint32_t b = order[j];
      const double distance = apart(vertices[a], vertices[b]);
      if (name[b] != b || !(distance <= near) ||
          std::binary_search(neighbours.begin(), neighbours.end(), std::pair(std::min(a, b), std::max(a, b))))
        continue;
      name[b] = a;
      closed.merged.push_back(b);
      closed.furthest = std::max(closed.furthest, distance);
    }
  }
  for (Face& face : faces)
    for (std::uint32_t& v : face) v = name[v];
  return closed;
}

FilledHoles fill_holes(const std::vector<Point3>& vertices, std::vector<Face>& faces, std::optional<double> length) {
  FilledHoles filled;
  const HalfEdges edges = half_edges_without_twins(faces);
  const std::vector<std::uint32_t> open = open_half_edges(edges);
  if (open.empty()) return filled;
  constexpr std::uint32_t kSeveral = HalfEdges::kNone - 1;
  std::vector<std::uint32_t> leaving(vertices.size(), HalfEdges::kNone);
  for (const std::uint32_t h : open) {
    std::uint32_t& there = leaving[edges.origin[h]];
    there = there == HalfEdges::kNone ? h : kSeveral;
  }
  const double longest = length ? *length : kHole * diagonal(vertices, faces);
  const std::size_t most = length ? kMostEdgesOfGiven : kMostEdges;
  std::vector<bool> seen(edges.size());
  for (const std::uint32_t start : open) {
    if (seen[start]) continue;
    Face loop;
    double around = 0;
    std::uint32_t h = start;
    bool simple = true;
    while (simple && !seen[h]) {
      seen[h] = true;
      loop.push_back(edges.origin[h]);
      around += apart(vertices[edges.origin[h]], vertices[edges.target(h)]);
      const std::uint32_t next = leaving[edges.target(h)];
      simple = next < kSeveral && loop.size() <= most;
      if (simple) h = next;
    }
    if (!simple || h != start || loop.size() < 3 || !(around <= longest)) continue;
    std::reverse(loop.begin(), loop.end());
    const std::vector<Triangle> triangles = triangulated(vertices, loop, average_view(vertices, loop));
    const bool sound = std::none_of(triangles.begin(), triangles.end(), [&](const Triangle& t) {
      return exact::collinear(vertices[t[0]], vertices[t[1]], vertices[t[2]]);
    });
    if (!sound) continue;
    filled.at.push_back(edges.origin[start]);
    filled.longest = std::max(filled.longest, around);
    for (const Triangle& t : triangles) {
      faces.emplace_back(t.begin(), t.end());
      filled.beside.push_back(edges.face[start]);
    }
  }
  return filled;
}

}  // namespace dymsum::spatial
