#include "spatial/gauss/polytope.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

#include "exact/grid.h"
#include "exact/rounding_bound.h"
#include "spatial/mesh/vec3.h"
#include "spatial/mesh/wide_sum.h"

namespace dymsum::spatial {
namespace {

using exact::Big;

constexpr std::uint32_t kNone = ~std::uint32_t{0};

/// The half-edges of a mesh's faces as they stand.
struct Soup {
  std::vector<std::uint32_t> origin, face, next, twin;
};

Soup half_edges(const std::vector<Face>& faces) {
  Soup s;
  std::unordered_map<std::uint64_t, std::uint32_t> seen;
  for (std::uint32_t f = 0; f < faces.size(); ++f) {
    const Face& face = faces[f];
    const auto first = static_cast<std::uint32_t>(s.origin.size());
    for (std::size_t i = 0; i < face.size(); ++i) {
      s.origin.push_back(face[i]);
      s.face.push_back(f);
      s.next.push_back(i + 1 < face.size() ? first + static_cast<std::uint32_t>(i) + 1 : first);
      seen[(std::uint64_t{face[i]} << 32) | face[(i + 1) % face.size()]] = first + static_cast<std::uint32_t>(i);
    }
  }
  s.twin.resize(s.origin.size());
  for (std::uint32_t h = 0; h < s.origin.size(); ++h)
    s.twin[h] = seen.at((std::uint64_t{s.origin[s.next[h]]} << 32) | s.origin[h]);
  return s;
}

/// A vertex of a face at which its boundary turns: collinear ones give no plane.
template <class C>
std::uint32_t corner(const GridPositions& p, const Soup& s, std::uint32_t h) {
  for (std::uint32_t k = h;; k = s.next[k]) {
    const auto a = p.position<C>(s.origin[k]), b = p.position<C>(s.origin[s.next[k]]),
               c = p.position<C>(s.origin[s.next[s.next[k]]]);
    if (exact::leading_sign(exact::cross(b - a, c - b)) != 0) return k;
    if (s.next[k] == h) return k;
  }
}

/// Faces in the same plane get the same group: neighbours are compared, as a convex solid's coplanar faces are
/// connected.
std::vector<std::uint32_t> coplanar_groups(const GridPositions& p, const Soup& s, std::size_t faces, bool merge) {
  std::vector<std::uint32_t> group(faces), corner_of(faces, kNone);
  std::iota(group.begin(), group.end(), 0);
  if (!merge) return group;
  const auto find = [&](std::uint32_t f) {
    while (group[f] != f) f = group[f] = group[group[f]];
    return f;
  };
  with_coordinates(p, [&](auto c) {
    using C = decltype(c);
    for (std::uint32_t h = 0; h < s.origin.size(); ++h)
      if (corner_of[s.face[h]] == kNone) corner_of[s.face[h]] = corner<C>(p, s, h);
    for (std::uint32_t h = 0; h < s.origin.size(); ++h) {
      if (h > s.twin[h]) continue;
      const std::uint32_t k = corner_of[s.face[h]];
      const auto a = p.position<C>(s.origin[k]), b = p.position<C>(s.origin[s.next[k]]),
                 d = p.position<C>(s.origin[s.next[s.next[k]]]);
      const auto n = exact::cross(b - a, d - b);
      bool flat = true;  // all of the neighbour's vertices lie in the plane
      std::uint32_t q = s.twin[h];
      do {
        flat = sign(exact::dot(n, p.position<C>(s.origin[q]) - a)) == 0;
        q = s.next[q];
      } while (flat && q != s.twin[h]);
      if (!flat) continue;
      const std::uint32_t f = find(s.face[h]), g = find(s.face[s.twin[h]]);
      group[std::max(f, g)] = std::min(f, g);
    }
    return 0;
  });
  for (std::uint32_t f = 0; f < faces; ++f) group[f] = find(f);
  return group;
}

/// Half-edges between different groups whose origins are true vertices, joined over flat vertices.
class Merging {
 public:
  Merging(const Soup& soup, const std::vector<std::uint32_t>& group, std::size_t vertices)
      : s_(soup), group_(group), degree_(vertices, 0) {
    for (std::uint32_t h = 0; h < s_.origin.size(); ++h)
      if (facet_edge(h)) ++degree_[s_.origin[h]];
  }
  bool is_vertex(std::uint32_t v) const { return degree_[v] >= 3; }
  /// Facet edges that leave a true vertex start the edges of the merged solid.
  bool starts(std::uint32_t h) const { return facet_edge(h) && is_vertex(s_.origin[h]); }
  /// The next edge of the same group, after h.
  std::uint32_t following(std::uint32_t h) const {
    h = s_.next[h];
    while (!facet_edge(h)) h = s_.next[s_.twin[h]];
    return h;
  }
  /// The last edge of the straight edge that h starts.
  std::uint32_t end(std::uint32_t h) const {
    for (std::uint32_t k = following(h); !is_vertex(s_.origin[k]); k = following(k)) h = k;
    return h;
  }

 private:
  bool facet_edge(std::uint32_t h) const { return group_[s_.face[h]] != group_[s_.face[s_.twin[h]]]; }
  const Soup& s_;
  const std::vector<std::uint32_t>& group_;
  std::vector<std::uint32_t> degree_;
};

struct Numbering {
  std::vector<std::uint32_t> vertex, half_edge, face;  // of the soup, kNone where dropped
};

Numbering number(Polytope& p, const Soup& s, const Merging& merging, const std::vector<std::uint32_t>& group,
                 const GridPositions& all, std::uint32_t vertices) {
  Numbering to{std::vector<std::uint32_t>(vertices, kNone), std::vector<std::uint32_t>(s.origin.size(), kNone),
               std::vector<std::uint32_t>(group.size(), kNone)};
  for (std::uint32_t v = 0; v < vertices; ++v) {
    if (!merging.is_vertex(v)) continue;
    to.vertex[v] = p.vertex_count();
    if (all.big.empty()) {
      p.grid.push_back(all.grid[v]);
    } else {
      p.big.push_back(all.big[v]);
    }
    p.source_vertex.push_back(v);
  }
  for (std::uint32_t f = 0; f < group.size(); ++f) {
    if (group[f] != f) continue;
    to.face[f] = static_cast<std::uint32_t>(p.source_face.size());
    p.source_face.push_back(f);
  }
  HalfEdge made = 0;
  for (std::uint32_t h = 0; h < s.origin.size(); ++h) {
    if (!merging.starts(h) || to.half_edge[h] != kNone) continue;
    to.half_edge[h] = made;
    to.half_edge[s.twin[merging.end(h)]] = made + 1;
    made += 2;
  }
  return to;
}

void link(Polytope& p, const Soup& s, const Merging& merging, const std::vector<std::uint32_t>& group,
          const Numbering& to, std::uint32_t edges) {
  p.origin.resize(2 * edges);
  p.face.resize(2 * edges);
  p.next.resize(2 * edges);
  p.first.assign(p.source_face.size(), kNone);
  for (std::uint32_t h = 0; h < s.origin.size(); ++h) {
    const HalfEdge k = to.half_edge[h];
    if (k == kNone) continue;
    p.origin[k] = to.vertex[s.origin[h]];
    p.face[k] = to.face[group[s.face[h]]];
    p.next[k] = to.half_edge[merging.following(merging.end(h))];
    if (p.first[p.face[k]] == kNone) p.first[p.face[k]] = k;
  }
}

void make_rings(Polytope& p) {
  std::vector<HalfEdge> previous(p.next.size());
  for (HalfEdge h = 0; h < p.next.size(); ++h) previous[p.next[h]] = h;
  std::vector<HalfEdge> some(p.vertex_count(), kNone);
  for (HalfEdge h = 0; h < p.next.size(); ++h)
    if (some[p.origin[h]] == kNone) some[p.origin[h]] = h;
  for (std::uint32_t v = 0; v < p.vertex_count(); ++v) {
    p.ring_start.push_back(static_cast<std::uint32_t>(p.ring.size()));
    HalfEdge h = some[v];
    do {
      p.ring.push_back(h);
      h = twin(previous[h]);
    } while (h != some[v]);
  }
  p.ring_start.push_back(static_cast<std::uint32_t>(p.ring.size()));
}

void make_units(Polytope& p, std::uint32_t edges) {
  with_coordinates(p, [&](auto c) {
    using C = decltype(c);
    p.direction.resize(edges);
    for (std::uint32_t e = 0; e < edges; ++e) p.direction[e] = unit(p.edge_vector<C>(2 * e));
    p.normal.resize(p.first.size());
    for (std::uint32_t f = 0; f < p.first.size(); ++f) p.normal[f] = unit(p.normal_vector<C>(f));
    return 0;
  });
  for (const HalfEdge h : p.ring) {
    p.ring_direction.push_back(p.along(h));
    p.ring_face.push_back(p.face[h]);
    p.ring_normal.push_back(p.normal[p.face[h]]);
  }
  for (std::uint32_t e = 0; e < edges; ++e) {
    const Vec3 left = p.normal[p.face[2 * e]], right = p.normal[p.face[2 * e + 1]];
    p.sides.push_back({left.x, right.x, left.y, right.y, left.z, right.z});
  }
}

void make_eights(Polytope& p) {
  constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  for (std::uint32_t v = 0; v < p.vertex_count(); ++v) {
    const std::uint32_t begin = p.ring_start[v], last = p.ring_start[v + 1] - 1;
    RingOfEight& eight = p.eight.emplace_back();
    for (std::uint32_t k = 0; k < 8; ++k) {
      const std::uint32_t slot = std::min(begin + k, last);
      const Vec3 n = last - begin < 8 ? p.ring_normal[slot] : Vec3{kNoNumber, kNoNumber, kNoNumber};
      eight.x[k] = static_cast<float>(n.x);
      eight.y[k] = static_cast<float>(n.y);
      eight.z[k] = static_cast<float>(n.z);
      eight.edge[k] = p.ring[slot];
    }
  }
}

void make_bounds(Polytope& p) {
  const auto edges = [&](std::uint32_t v) { return p.ring_start[v + 1] - p.ring_start[v]; };
  for (std::uint32_t v = 0; v < p.vertex_count(); ++v) {
    if (edges(v) < RingBounds::kManyEdges) continue;
    p.direction_bounds.resize(p.vertex_count());
    p.normal_bounds.resize(p.vertex_count());
    p.direction_bounds[v] = RingBounds(std::span(p.ring_direction).subspan(p.ring_start[v], edges(v)));
    p.normal_bounds[v] = RingBounds(std::span(p.ring_normal).subspan(p.ring_start[v], edges(v)));
  }
}

/// The triangles of a face's fan, seen from a corner, all turn the same way, and seen from a vertex all are in front of
/// it: nothing that is added cancels.
template <class C>
void measure_as(Polytope& p) {
  const exact::Vector3<C> centre = p.position<C>(0);
  for (std::uint32_t v = 0; v < p.vertex_count(); ++v) p.size = std::max(p.size, bit_length(p.position<C>(v) - centre));
  for (std::uint32_t v = 0; v < p.vertex_count(); ++v)
    p.from_first.push_back(rounded(p.position<C>(v) - centre, -p.size));
  CompensatedSum volume, area;
  using Six = decltype(exact::dot(exact::cross(centre - centre, centre - centre), centre - centre));
  WideSum<Six> six;
  for (std::uint32_t f = 0; f < p.face_count(); ++f) {
    const auto a = p.position<C>(p.origin[p.first[f]]);
    std::array<CompensatedSum, 3> twice;
    for (HalfEdge h = p.next[p.first[f]]; p.next[h] != p.first[f]; h = p.next[h]) {
      const auto n = exact::cross(p.position<C>(p.origin[h]) - a, p.position<C>(p.target(h)) - a);
      const Vec3 rounded_n = rounded(n, -2 * p.size);
      twice[0].add(rounded_n.x);
      twice[1].add(rounded_n.y);
      twice[2].add(rounded_n.z);
      const Six tetrahedron = exact::dot(n, a - centre);
      volume.add(rounded(tetrahedron, -3 * p.size));
      six.add(tetrahedron);
    }
    p.area.push_back(0.5 * Vec3{twice[0].value(), twice[1].value(), twice[2].value()});
    area.add(length(p.area.back()));
  }
  p.volume = volume.value() / 6;
  p.six_volume = exact::to_big(six.value());
  p.total_area = area.value() * exact::kOutwards;
  p.size += p.exponent;
}

void measure(Polytope& p) {
  with_coordinates(p, [&](auto c) {
    measure_as<decltype(c)>(p);
    return 0;
  });
}

Polytope make(const GridPositions& all, std::size_t vertices, const std::vector<Face>& faces, bool merge) {
  const Soup soup = half_edges(faces);
  const std::vector<std::uint32_t> group = coplanar_groups(all, soup, faces.size(), merge);
  const Merging merging(soup, group, vertices);

  Polytope p;
  p.bits = all.bits;
  p.exponent = all.exponent;
  p.has_flat_edges = !merge;
  const Numbering to = number(p, soup, merging, group, all, static_cast<std::uint32_t>(vertices));
  const auto edges = static_cast<std::uint32_t>(
      std::count_if(to.half_edge.begin(), to.half_edge.end(), [](std::uint32_t h) { return h != kNone; }) / 2);
  link(p, soup, merging, group, to, edges);
  make_rings(p);
  make_units(p, edges);
  make_eights(p);
  make_bounds(p);
  measure(p);
  return p;
}

}  // namespace

std::size_t Polytope::bytes() const {
  const auto of = [](const auto&... v) { return (std::size_t{0} + ... + (v.capacity() * sizeof(v[0]))); };
  std::size_t bounds = 0;
  for (const std::vector<RingBounds>* all : {&direction_bounds, &normal_bounds})
    for (const RingBounds& b : *all) bounds += sizeof(b) + b.bytes();
  return sizeof(*this) + bounds +
         of(from_first, grid, big, source_vertex, ring_start, ring, ring_direction, ring_face, ring_normal, eight,
            sides, origin, face, next, direction, normal, area, first, source_face);
}

Result<Polytope> make_polytope(const Mesh& mesh, bool merge) {
  if (std::optional<Error> error = convexity_error(mesh)) return std::move(*error);
  const MeshData& data = mesh.data();
  if (!merge && !std::all_of(data.faces.begin(), data.faces.end(), [](const Face& f) { return f.size() == 3; }))
    return Error{ErrorCode::unsupported_operand, "without merging, all faces have to be triangles", {}};
  return make(grid_positions(data.vertices), data.vertices.size(), data.faces, merge);
}

Polytope make_polytope(const ExactSolid& solid) {
  return make(grid_positions(solid.vertices, solid.exponent), solid.vertices.size(), solid.faces, true);
}

}  // namespace dymsum::spatial
