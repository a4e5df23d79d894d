#include "spatial/convex/facet_corners.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "spatial/convex/plane_sum.h"
#include "spatial/gauss/most_rise.h"

namespace dymsum::spatial {
namespace {

void append_edges(const Polytope& p, std::uint32_t f, std::vector<HalfEdge>& edges) {
  HalfEdge h = p.first[f];
  do {
    edges.push_back(h);
    h = p.next[h];
  } while (h != p.first[f]);
}

/// The edges at the extreme vertex of face f of operand op that are level, as positions in its ring: at most two, which
/// then are neighbours.
struct LevelEdges {
  std::uint32_t count = 0;
  std::array<std::size_t, 2> slot{};
};
LevelEdges level_edges(const Overlay& overlay, int op, std::uint32_t f) {
  const Polytope& other = overlay.poly(1 - op);
  const Signs& signs = overlay.signs();
  const std::uint32_t v = overlay.extreme(op, f);
  LevelEdges level;
  look_above(other, v, signs.row_now(op, f), -signs.error(op), [&](std::uint32_t k) {
    if (signs.true_sign(op, f, other.leaving(v)[k]) != 0) return;
    if (level.count == 2) throw std::logic_error("level_edges: three level edges at a vertex");
    level.slot[level.count++] = k;
  });
  return level;
}

// All edges at the extreme vertex fall or are level; level ones bound the extreme feature, and two level ones are
// neighbours in the ring: the face is on the left of the first of the two.
std::uint32_t level_face(const Overlay& overlay, int op, std::uint32_t f, const LevelEdges& level) {
  const Polytope& other = overlay.poly(1 - op);
  const std::size_t k = level.slot[1] == level.slot[0] + 1 ? level.slot[0] : level.slot[1];
  return other.face[other.leaving(overlay.extreme(op, f))[k]];
}

}  // namespace

SolidFeature vertex_feature(const Polytope& p, std::uint32_t v) {
  return {SolidFeature::Kind::vertex, p.source_vertex[v], 0};
}

SolidFeature edge_feature(const Polytope& p, std::uint32_t a, std::uint32_t b) {
  const std::uint32_t from = p.source_vertex[a], to = p.source_vertex[b];
  return {SolidFeature::Kind::edge, std::min(from, to), std::max(from, to)};
}

SolidFeature face_feature(const Polytope& p, std::uint32_t f) {
  return {SolidFeature::Kind::face, p.source_face[f], 0};
}

FacetFeatures append_face_and_vertex(const Overlay& overlay, int op, std::uint32_t f,
                                     std::vector<VertexPair>& corners) {
  const Polytope &mine = overlay.poly(op), &other = overlay.poly(1 - op);
  const std::uint32_t v = overlay.extreme(op, f);
  HalfEdge h = mine.first[f];
  do {
    corners.push_back(op == 0 ? VertexPair{mine.origin[h], v} : VertexPair{v, mine.origin[h]});
    h = mine.next[h];
  } while (h != mine.first[f]);
  const SolidFeature face = face_feature(mine, f), vertex = vertex_feature(other, v);
  return op == 0 ? FacetFeatures{face, vertex, kNoFace} : FacetFeatures{vertex, face, kNoFace};
}

FacetFeatures append_face(const Overlay& overlay, int op, std::uint32_t f, std::vector<VertexPair>& corners) {
  const LevelEdges edges = level_edges(overlay, op, f);
  if (edges.count == 0) return append_face_and_vertex(overlay, op, f, corners);
  const Polytope &mine = overlay.poly(op), &other = overlay.poly(1 - op);
  const std::uint32_t v = overlay.extreme(op, f), g = edges.count == 2 ? level_face(overlay, op, f, edges) : kNoFace;
  const HalfEdge level = other.leaving(v)[edges.slot[0]];
  const SolidFeature face = face_feature(mine, f),
                     beyond = g == kNoFace ? edge_feature(other, v, other.target(level)) : face_feature(other, g);
  const FacetFeatures features = op == 0 ? FacetFeatures{face, beyond, g} : FacetFeatures{beyond, face, g};
  if (op == 1 && g != kNoFace) return features;
  std::vector<HalfEdge> round;
  round.reserve(16);  // enough for most
  append_edges(mine, f, round);
  const std::size_t n = round.size(), first = corners.size();
  if (g == kNoFace) round.insert(round.end(), {level, twin(level)});
  else append_edges(other, g, round);
  const FlatFeature a{0, std::span(round).first(n)}, b{v, std::span(round).subspan(n)};
  append_plane_sum(overlay.signs(), op == 0 ? a : b, op == 0 ? b : a, op, f, corners);
  const auto begin = corners.begin() + static_cast<std::ptrdiff_t>(first);
  std::rotate(begin, std::min_element(begin, corners.end()), corners.end());
  return features;
}

FacetFeatures append_crossing(const Overlay& overlay, const Crossing& c, std::vector<VertexPair>& corners) {
  const Polytope &p = overlay.poly(0), &q = overlay.poly(1);
  // The arc of e has the cell of its second vertex on its left; h leaves the cell of its origin.
  const std::uint32_t a = p.origin[2 * c.p], b = p.target(2 * c.p), from = q.origin[c.q], to = q.target(c.q);
  corners.insert(corners.end(), {{a, to}, {b, to}, {b, from}, {a, from}});
  return {edge_feature(p, a, b), edge_feature(q, from, to), kNoFace};
}

bool crosses_properly(const Overlay& overlay, const Crossing& c) {
  const Signs& s = overlay.signs();
  const Polytope &p = overlay.poly(0), &q = overlay.poly(1);
  return s.true_sign(0, p.face[2 * c.p], c.q) != 0 && s.true_sign(0, p.face[2 * c.p + 1], c.q) != 0 &&
         s.true_sign(1, q.face[c.q], 2 * c.p) != 0 && s.true_sign(1, q.face[twin(c.q)], 2 * c.p) != 0;
}

}  // namespace dymsum::spatial
