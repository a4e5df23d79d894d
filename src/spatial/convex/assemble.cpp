#include "spatial/convex/assemble.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

#include "spatial/convex/plane_sum.h"

namespace dymsum::spatial {
namespace {

std::vector<std::uint32_t> face_vertices(const Polytope& p, std::uint32_t f) {
  std::vector<std::uint32_t> v;
  HalfEdge h = p.first[f];
  do {
    v.push_back(p.origin[h]);
    h = p.next[h];
  } while (h != p.first[f]);
  return v;
}

SolidFeature feature(const Polytope& p, const ExtremeFeature& x) {
  if (x.vertices.size() == 1) return vertex_feature(p, x.vertices[0]);
  if (x.vertices.size() == 2) return edge_feature(p, x.vertices[0], x.vertices[1]);
  return face_feature(p, x.face);
}

/// A facet whose vertices are still pairs of vertices of the polytopes.
struct Draft {
  std::size_t first;
  std::uint32_t count;
  bool changed;
  SolidFeature p, q;
};

/// The edges at the extreme vertex of face f of operand op that are level, as positions in its ring: at most two, which
/// then are neighbours.
struct LevelEdges {
  std::uint32_t count = 0;
  std::array<std::size_t, 2> slot{};
};
LevelEdges level_edges(const Overlay& overlay, int op, std::uint32_t f) {
  const std::span<const HalfEdge> ring = overlay.poly(1 - op).leaving(overlay.extreme(op, f));
  LevelEdges level;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    if (overlay.signs().true_sign(op, f, ring[k]) != 0) continue;
    if (level.count == 2) throw std::logic_error("extreme_feature: three level edges at a vertex");
    level.slot[level.count++] = k;
  }
  return level;
}

class Drafts {
 public:
  explicit Drafts(const Overlay& overlay) : o_(overlay) {
    for (int op = 0; op < 2; ++op) {
      changed_[op].assign(o_.poly(op).face_count(), false);
      for (const std::uint32_t f : o_.changes().faces[op]) changed_[op][f] = true;
    }
    const std::size_t facets = o_.poly(0).face_count() + o_.poly(1).face_count() + o_.crossing_count();
    drafts.reserve(facets);
    corners.reserve(5 * facets);
  }

  std::vector<Draft> drafts;
  std::vector<VertexPair> corners;  ///< of all drafts

  void add_faces() {
    for (int op = 0; op < 2; ++op)
      for (std::uint32_t f = 0; f < o_.poly(op).face_count(); ++f) {
        if (level_edges(o_, op, f).count == 0) add_with_vertex(op, f);
        else add_with_edge_or_face(op, f);
      }
  }

  void add_crossings() {
    std::vector<bool> is_new;
    for (const std::uint32_t id : o_.changes().crossings) {
      if (id >= is_new.size()) is_new.resize(id + 1);
      is_new[id] = true;
    }
    const Polytope &p = o_.poly(0), &q = o_.poly(1);
    for (std::uint32_t e = 0; e < p.edge_count(); ++e)
      for (std::uint32_t id = o_.first_crossing(0, e); id != kNoCrossing; id = o_.crossing(id).next[0]) {
        const Crossing& c = o_.crossing(id);
        if (!crosses_properly(o_, c)) continue;
        // The arc of e has the cell of its second vertex on its left; h leaves the cell of its origin.
        const std::uint32_t a = p.origin[2 * e], b = p.target(2 * e), from = q.origin[c.q], to = q.target(c.q);
        const std::size_t first = corners.size();
        corners.insert(corners.end(), {{a, to}, {b, to}, {b, from}, {a, from}});
        close(first, edge_feature(p, a, b), edge_feature(q, from, to), id < is_new.size() && is_new[id]);
      }
  }

 private:
  void close(std::size_t first, const SolidFeature& p, const SolidFeature& q, bool changed) {
    drafts.push_back({first, static_cast<std::uint32_t>(corners.size() - first), changed, p, q});
  }

  void add_with_vertex(int op, std::uint32_t f) {
    const Polytope &mine = o_.poly(op), &other = o_.poly(1 - op);
    const std::uint32_t v = o_.extreme(op, f);
    const std::size_t first = corners.size();
    HalfEdge h = mine.first[f];
    do {
      corners.push_back(op == 0 ? VertexPair{mine.origin[h], v} : VertexPair{v, mine.origin[h]});
      h = mine.next[h];
    } while (h != mine.first[f]);
    const SolidFeature face = face_feature(mine, f), vertex = vertex_feature(other, v);
    if (op == 0) close(first, face, vertex, changed_[0][f]);
    else close(first, vertex, face, changed_[1][f]);
  }

  void add_with_edge_or_face(int op, std::uint32_t f) {
    const ExtremeFeature mine{face_vertices(o_.poly(op), f), f}, other = extreme_feature(o_, op, f);
    const bool parallel = other.vertices.size() > 2;
    if (op == 1 && parallel) return;  // there already, as a face of P
    const ExtremeFeature &p = op == 0 ? mine : other, &q = op == 0 ? other : mine;
    const std::size_t first = corners.size();
    const std::vector<VertexPair> sum = plane_sum(o_.signs(), p.vertices, q.vertices, op, f);
    corners.insert(corners.end(), sum.begin(), sum.end());
    close(first, feature(o_.poly(0), p), feature(o_.poly(1), q),
          changed_[op][f] || (parallel && changed_[1][other.face]));
  }

  const Overlay& o_;
  std::array<std::vector<bool>, 2> changed_;
};

/// The vertices of all corners, sorted by the meshes' indices, and the index of each corner's.
class Numbering {
 public:
  Numbering(const Overlay& overlay, const std::vector<VertexPair>& corners, SolidSum& sum) {
    const Polytope &p = overlay.poly(0), &q = overlay.poly(1);
    const std::uint32_t sources = 1 + *std::max_element(p.source_vertex.begin(), p.source_vertex.end());
    begin_.assign(sources + 1, 0);
    for (const VertexPair& c : corners) ++begin_[p.source_vertex[c.p] + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::uint32_t> with(corners.size());  // by P's vertex, those of Q
    std::vector<std::uint32_t> at(begin_.begin(), begin_.end() - 1);
    for (const VertexPair& c : corners) with[at[p.source_vertex[c.p]]++] = q.source_vertex[c.q];
    sum.vertices.clear();
    for (std::uint32_t v = 0; v < sources; ++v) {
      const auto from = with.begin() + begin_[v], to = with.begin() + begin_[v + 1];
      std::sort(from, to);
      begin_[v] = static_cast<std::uint32_t>(sum.vertices.size());
      for (auto it = from; it != to; ++it)
        if (it == from || *it != *(it - 1)) sum.vertices.push_back({v, *it});
    }
    begin_[sources] = static_cast<std::uint32_t>(sum.vertices.size());
    index.reserve(corners.size());
    for (const VertexPair& c : corners) {
      const std::uint32_t v = p.source_vertex[c.p], w = q.source_vertex[c.q];
      const auto found = std::lower_bound(sum.vertices.begin() + begin_[v], sum.vertices.begin() + begin_[v + 1], w,
                                          [](const SolidSum::Vertex& x, std::uint32_t y) { return x.q < y; });
      index.push_back(static_cast<std::uint32_t>(found - sum.vertices.begin()));
    }
  }

  std::vector<std::uint32_t> index;

 private:
  std::vector<std::uint32_t> begin_;  // by P's vertex
};

/// Facets from their smallest vertex on, sorted by their vertices.
void write_facets(const Drafts& all, std::vector<std::uint32_t> index, SolidSum& sum) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;  // by the first two vertices: an edge of one facet
  order.reserve(all.drafts.size());
  for (std::uint32_t d = 0; d < all.drafts.size(); ++d) {
    const auto from = index.begin() + static_cast<std::ptrdiff_t>(all.drafts[d].first), to = from + all.drafts[d].count;
    std::rotate(from, std::min_element(from, to), to);
    order.emplace_back(std::uint64_t{from[0]} << 32 | from[1], d);
  }
  std::sort(order.begin(), order.end());
  sum.facets.clear();
  sum.facets.reserve(order.size());
  for (const auto& [key, d] : order) {
    const Draft& draft = all.drafts[d];
    const auto from = index.begin() + static_cast<std::ptrdiff_t>(draft.first);
    sum.facets.push_back({{from, from + draft.count}, draft.p, draft.q, draft.changed});
  }
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

// All edges at the extreme vertex fall or are level; level ones bound the extreme feature, and two level ones are
// neighbours in the ring.
ExtremeFeature extreme_feature(const Overlay& overlay, int op, std::uint32_t f) {
  const Polytope& other = overlay.poly(1 - op);
  const std::uint32_t v = overlay.extreme(op, f);
  const std::span<const HalfEdge> ring = other.leaving(v);
  const LevelEdges edges = level_edges(overlay, op, f);
  const std::array<std::size_t, 2>& level = edges.slot;
  if (edges.count == 0) return {{v}, 0};
  if (edges.count == 1) return {{v, other.target(ring[level[0]])}, 0};
  const std::size_t k =
      level[1] == level[0] + 1 ? level[0] : level[1];  // the face is on the left of the first of the two
  const std::uint32_t g = other.face[ring[k]];
  return {face_vertices(other, g), g};
}

bool crosses_properly(const Overlay& overlay, const Crossing& c) {
  const Signs& s = overlay.signs();
  const Polytope &p = overlay.poly(0), &q = overlay.poly(1);
  return s.true_sign(0, p.face[2 * c.p], c.q) != 0 && s.true_sign(0, p.face[2 * c.p + 1], c.q) != 0 &&
         s.true_sign(1, q.face[c.q], 2 * c.p) != 0 && s.true_sign(1, q.face[twin(c.q)], 2 * c.p) != 0;
}

void assemble(const Overlay& overlay, SolidSum& sum) {
  Drafts drafts(overlay);
  drafts.add_faces();
  drafts.add_crossings();
  Numbering numbering(overlay, drafts.corners, sum);
  write_facets(drafts, std::move(numbering.index), sum);
}

}  // namespace dymsum::spatial
