#include "spatial/convex/assemble.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "spatial/convex/facet_corners.h"

namespace dymsum::spatial {
namespace {

/// A facet whose vertices are still pairs of vertices of the polytopes.
struct Draft {
  std::size_t first;
  std::uint32_t count;
  bool changed;
  SolidFeature p, q;
};

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
        const std::size_t first = corners.size();
        const FacetFeatures features = append_face(o_, op, f, corners);
        if (corners.size() == first) continue;  // there already, as a face of P
        close(first, features, changed_[op][f] || (features.parallel != kNoFace && changed_[1][features.parallel]));
      }
  }

  void add_crossings() {
    std::vector<bool> is_new;
    for (const std::uint32_t id : o_.changes().crossings) {
      if (id >= is_new.size()) is_new.resize(id + 1);
      is_new[id] = true;
    }
    for (std::uint32_t e = 0; e < o_.poly(0).edge_count(); ++e)
      for (std::uint32_t id = o_.first_crossing(0, e); id != kNoCrossing; id = o_.crossing(id).next[0]) {
        const Crossing& c = o_.crossing(id);
        if (!crosses_properly(o_, c)) continue;
        const std::size_t first = corners.size();
        const FacetFeatures features = append_crossing(o_, c, corners);
        close(first, features, id < is_new.size() && is_new[id]);
      }
  }

 private:
  void close(std::size_t first, const FacetFeatures& features, bool changed) {
    drafts.push_back({first, static_cast<std::uint32_t>(corners.size() - first), changed, features.p, features.q});
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

void assemble(const Overlay& overlay, SolidSum& sum) {
  Drafts drafts(overlay);
  drafts.add_faces();
  drafts.add_crossings();
  Numbering numbering(overlay, drafts.corners, sum);
  write_facets(drafts, std::move(numbering.index), sum);
}

}  // namespace dymsum::spatial
