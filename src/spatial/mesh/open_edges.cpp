#include "spatial/mesh/open_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

#include "base/doubles.h"
#include "exact/int.h"
#include "exact/orient.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/triangulate.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {
namespace {

using exact::Big;

constexpr int kNarrow = 13;  // edges are 2^kNarrow times as long as vertices may be off them

/// The position of w beside the edge from u to v, on a grid of the three.
struct Beside {
  Big along, whole;  ///< the product of w - u and of v - u with v - u
  Big off_squared;   ///< the square of the product of w - u and v - u across
};

Beside beside(const Point3& u, const Point3& v, const Point3& w) {
  const GridPositions positions = grid_positions(std::array{u, v, w});
  const exact::Vector3<Big> edge = positions.position<Big>(1) - positions.position<Big>(0),
                            to = positions.position<Big>(2) - positions.position<Big>(0), off = exact::cross(edge, to);
  return {exact::dot(to, edge), exact::dot(edge, edge), exact::dot(off, off)};
}

/// Determined by doubles: a sign that they cannot tell is left to `beside`.
bool clearly_far(const Point3& u, const Point3& v, const Point3& w) {
  const Vec3 edge{v.x - u.x, v.y - u.y, v.z - u.z}, to{w.x - u.x, w.y - u.y, w.z - u.z}, off = cross(edge, to);
  const double whole = dot(edge, edge), off_squared = dot(off, off);
  // The roundings of the products are below 2^-48 of |edge| |to|, and |to| is below 2 |edge| where it is near.
  constexpr double kSlack = 4;
  return std::isfinite(off_squared) && std::isfinite(whole * whole) && whole > 1e-140 &&
         std::ldexp(off_squared, 2 * kNarrow) > kSlack * whole * whole;
}

bool between(const Beside& b) { return sign(b.along) > 0 && b.along < b.whole; }

/// Whether w is within the box of u and v, and neither of them.
bool in_box(const Point3& u, const Point3& v, const Point3& w) {
  const auto within = [](double a, double b, double x) { return std::min(a, b) <= x && x <= std::max(a, b); };
  return within(u.x, v.x, w.x) && within(u.y, v.y, w.y) && within(u.z, v.z, w.z) && w != u && w != v;
}

/// The distance of w from the line through u and v.
double gap(const Point3& u, const Point3& v, const Point3& w) {
  if (exact::collinear(u, v, w)) return 0;
  const Beside b = beside(u, v, w);
  const double squared = exact::round_to_double(exact::ratio(b.off_squared, b.whole * b.whole));
  return std::sqrt(squared) * base::hypot3(v.x - u.x, v.y - u.y, v.z - u.z);
}

class OpenEdges {
 public:
  OpenEdges(const std::vector<Point3>& vertices, const std::vector<Face>& faces)
      : vertices_(vertices), edges_(half_edges_without_twins(faces)) {
    const std::vector<EdgeSide> sides = edge_sides(edges_);
    for_each_edge(sides, [&](const EdgeSide* first, const EdgeSide* last) {
      // Segments and points are faces of both their sides.
      const auto bounds = [&](const EdgeSide& s) { return faces[edges_.face[s.half_edge]].size() >= 3; };
      if (std::count_if(first, last, bounds) == 1) open_.push_back(std::find_if(first, last, bounds)->half_edge);
    });
    std::vector<std::uint32_t> ends;
    for (const std::uint32_t h : open_) {
      for (const std::uint32_t v : {edges_.origin[h], edges_.target(h)}) ends.push_back(v);
      leads_to_.emplace(edges_.origin[h], edges_.target(h));
      leads_to_.emplace(edges_.target(h), edges_.origin[h]);
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    std::vector<Box> boxes(ends.size());
    for (std::size_t k = 0; k < ends.size(); ++k) boxes[k].add(as_vector(at(ends[k])));
    corners_ = std::move(ends);
    tree_ = BoxTree(std::move(boxes));
    std::sort(open_.begin(), open_.end());
  }

  /// The open half-edges in the order of faces, and those of each face in its order.
  const std::vector<std::uint32_t>& open() const { return open_; }
  const HalfEdges& edges() const { return edges_; }

  /// The vertices that an open edge is to be split at, in its direction.
  std::vector<std::uint32_t> vertices_along(std::uint32_t h) {
    const std::uint32_t from = edges_.origin[h], to = edges_.target(h);
    std::vector<std::uint32_t> on, near;
    if (tests_ > kMostTests) return {};
    tree_.for_each(box_around(h), [&](std::uint32_t k) {
      const std::uint32_t w = corners_[k];
      ++tests_;
      if (w == from || w == to || clearly_far(at(from), at(to), at(w))) return;
      tests_ += kExactTest;
      if (tests_ > kMostTests) return;
      const bool exact = exact::collinear(at(from), at(to), at(w));
      if (exact && in_box(at(from), at(to), at(w))) on.push_back(w);
      if (exact ? !on.empty() && on.back() == w : is_near_edge(at(from), at(to), at(w))) near.push_back(w);
    });
    if (near.empty()) return {};
    std::sort(near.begin(), near.end());
    if (std::vector<std::uint32_t> chain = chain_of(from, to, near); !chain.empty()) return chain;
    std::sort(on.begin(), on.end(), [&](std::uint32_t a, std::uint32_t b) { return order(a, b, from, to); });
    return on;
  }

 private:
  static constexpr std::uint64_t kMostTests = 50'000'000, kExactTest = 20;  // in comparisons of doubles

  static Vec3 as_vector(const Point3& p) { return {p.x, p.y, p.z}; }
  const Point3& at(std::uint32_t v) const { return vertices_[v]; }

  Box box_around(std::uint32_t h) const {
    Box box;
    for (const std::uint32_t v : {edges_.origin[h], edges_.target(h)}) box.add(as_vector(at(v)));
    box.grow(std::ldexp(box.size(), -kNarrow));  // the sum of its sides is no less than the edge
    return box;
  }

  /// The order of positions on one line.
  bool order(std::uint32_t a, std::uint32_t b, std::uint32_t from, std::uint32_t to) const {
    const auto key = [&](std::uint32_t v) { return std::tie(at(v).x, at(v).y, at(v).z); };
    return key(from) < key(to) ? key(a) < key(b) : key(b) < key(a);
  }

  /// The vertices between `from` and `to` on the one way along open edges over `near` ones; none where there is none,
  /// or where it forks.
  std::vector<std::uint32_t> chain_of(std::uint32_t from, std::uint32_t to,
                                      const std::vector<std::uint32_t>& near) const {
    std::vector<std::uint32_t> chain;
    std::uint32_t last = from, before = to;
    while (true) {
      const std::optional<std::uint32_t> next = next_on(last, before, to, near);
      if (!next || chain.size() > near.size()) return {};
      if (*next == to) return chain;
      chain.push_back(*next);
      before = std::exchange(last, *next);
    }
  }
  std::optional<std::uint32_t> next_on(std::uint32_t last, std::uint32_t before, std::uint32_t to,
                                       const std::vector<std::uint32_t>& near) const {
    std::optional<std::uint32_t> next;
    const auto [first, end] = leads_to_.equal_range(last);
    for (auto it = first; it != end; ++it) {
      const std::uint32_t v = it->second;
      if (v == before || (v != to && !std::binary_search(near.begin(), near.end(), v))) continue;
      if (next) return std::nullopt;
      next = v;
    }
    return next;
  }

  const std::vector<Point3>& vertices_;
  HalfEdges edges_;
  std::vector<std::uint32_t> open_;     ///< half-edges
  std::vector<std::uint32_t> corners_;  ///< their ends
  BoxTree tree_;                        ///< of these
  std::multimap<std::uint32_t, std::uint32_t> leads_to_;
  std::uint64_t tests_ = 0;
};

}  // namespace

bool is_near_edge(const Point3& u, const Point3& v, const Point3& w) {
  if (clearly_far(u, v, w)) return false;
  const Beside b = beside(u, v, w);
  return between(b) && exact::shift_left<2 * kNarrow>(b.off_squared) <= b.whole * b.whole;
}

bool is_needle(const std::vector<Point3>& vertices, const Face& face) {
  if (face.size() != 3) return false;
  const Point3 &a = vertices[face[0]], &b = vertices[face[1]], &c = vertices[face[2]];
  return is_near_edge(a, b, c) || is_near_edge(b, c, a) || is_near_edge(c, a, b);
}

EdgeSplits split_open_edges(const std::vector<Point3>& vertices, std::vector<Face>& faces) {
  OpenEdges found(vertices, faces);
  EdgeSplits splits;
  const HalfEdges& edges = found.edges();
  const std::vector<std::uint32_t>& open = found.open();
  // Where all closes, each part of an edge is one of another face: there are no more parts than edges.
  std::size_t left = open.size();
  for (std::size_t i = 0; i < open.size();) {
    const std::uint32_t f = edges.face[open[i]];
    Face known = faces[f], made;
    std::sort(known.begin(), known.end());
    const auto has = [&](std::uint32_t w) { return std::binary_search(known.begin(), known.end(), w); };
    for (std::uint32_t h = edges.face_begin[f]; h < edges.face_begin[f + 1]; ++h) {
      made.push_back(edges.origin[h]);
      if (i == open.size() || open[i] != h) continue;
      ++i;
      std::vector<std::uint32_t> along = found.vertices_along(h);
      std::erase_if(along, has);
      if (along.size() > left) along.clear();
      left -= along.size();
      if (!along.empty()) splits.at.push_back(along.front());
      for (const std::uint32_t w : along)
        splits.largest_gap =
            std::max(splits.largest_gap, gap(vertices[edges.origin[h]], vertices[edges.target(h)], vertices[w]));
      made.insert(made.end(), along.begin(), along.end());
    }
    faces[f] = std::move(made);
  }
  return splits;
}

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
