#include "spatial/convex/assemble.h"

#include <algorithm>
#include <array>
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
  std::vector<VertexPair> vertices;
  SolidFeature p, q;
  bool changed;
};

class Drafts {
 public:
  explicit Drafts(const Overlay& overlay) : o_(overlay) {
    for (int op = 0; op < 2; ++op) {
      changed_[op].assign(o_.poly(op).face_count(), false);
      for (const std::uint32_t f : o_.changes().faces[op]) changed_[op][f] = true;
    }
  }

  void add_faces() {
    for (std::uint32_t f = 0; f < o_.poly(0).face_count(); ++f) {
      const ExtremeFeature p{face_vertices(o_.poly(0), f), f}, q = extreme_feature(o_, 0, f);
      const bool changed = changed_[0][f] || (q.vertices.size() > 2 && changed_[1][q.face]);
      add(p, q, 0, f, changed);
    }
    for (std::uint32_t g = 0; g < o_.poly(1).face_count(); ++g) {
      const ExtremeFeature q{face_vertices(o_.poly(1), g), g}, p = extreme_feature(o_, 1, g);
      if (p.vertices.size() > 2) continue;  // there already, as a face of P
      add(p, q, 1, g, changed_[1][g]);
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
        drafts_.push_back({{{a, to}, {b, to}, {b, from}, {a, from}},
                           edge_feature(p, a, b),
                           edge_feature(q, from, to),
                           id < is_new.size() && is_new[id]});
      }
  }

  std::vector<Draft>& drafts() { return drafts_; }

 private:
  void add(const ExtremeFeature& p, const ExtremeFeature& q, int op, std::uint32_t f, bool changed) {
    drafts_.push_back({plane_sum(o_.signs(), p.vertices, q.vertices, op, f), feature(o_.poly(0), p),
                       feature(o_.poly(1), q), changed});
  }

  const Overlay& o_;
  std::array<std::vector<bool>, 2> changed_;
  std::vector<Draft> drafts_;
};

/// Numbers the vertices by the meshes' numbers.
void number(const Overlay& overlay, std::vector<Draft>& drafts, SolidSum& sum) {
  const Polytope &p = overlay.poly(0), &q = overlay.poly(1);
  std::vector<SolidSum::Vertex> all;
  for (const Draft& d : drafts)
    for (const VertexPair& v : d.vertices) all.push_back({p.source_vertex[v.p], q.source_vertex[v.q]});
  sum.vertices = all;
  std::sort(sum.vertices.begin(), sum.vertices.end());
  sum.vertices.erase(std::unique(sum.vertices.begin(), sum.vertices.end()), sum.vertices.end());
  std::size_t k = 0;
  sum.facets.clear();
  for (Draft& d : drafts) {
    SolidFacet facet{{}, d.p, d.q, d.changed};
    for (std::size_t i = 0; i < d.vertices.size(); ++i, ++k)
      facet.vertices.push_back(static_cast<std::uint32_t>(
          std::lower_bound(sum.vertices.begin(), sum.vertices.end(), all[k]) - sum.vertices.begin()));
    std::rotate(facet.vertices.begin(), std::min_element(facet.vertices.begin(), facet.vertices.end()),
                facet.vertices.end());
    sum.facets.push_back(std::move(facet));
  }
  std::sort(sum.facets.begin(), sum.facets.end(),
            [](const SolidFacet& a, const SolidFacet& b) { return a.vertices < b.vertices; });
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
  std::vector<std::size_t> level;
  for (std::size_t k = 0; k < ring.size(); ++k)
    if (overlay.signs().true_sign(op, f, ring[k]) == 0) level.push_back(k);
  if (level.empty()) return {{v}, 0};
  if (level.size() == 1) return {{v, other.target(ring[level[0]])}, 0};
  if (level.size() > 2) throw std::logic_error("extreme_feature: three level edges at a vertex");
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
  number(overlay, drafts.drafts(), sum);
}

}  // namespace dymsum::spatial
