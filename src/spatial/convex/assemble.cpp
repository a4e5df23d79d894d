#include "spatial/convex/assemble.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "spatial/convex/close_facets.h"
#include "spatial/convex/facet_corners.h"

namespace dymsum::spatial {
namespace {

/// Facets whose corners are still pairs of vertices of the polytopes.
class Drafts {
 public:
  explicit Drafts(const Overlay& overlay) : o_(overlay) {
    for (int op = 0; op < 2; ++op) {
      changed_[op].assign(o_.poly(op).face_count(), false);
      for (const std::uint32_t f : o_.changes().faces[op]) changed_[op][f] = true;
    }
    const std::size_t count = o_.poly(0).face_count() + o_.poly(1).face_count() + o_.crossing_count();
    close_.find(o_);
    facets.reserve(count);
    corners.reserve(5 * count);
  }

  std::vector<ConvexFacets::Facet> facets;
  std::vector<VertexPair> corners;

  void add_faces() {
    for (int op = 0; op < 2; ++op)
      for (std::uint32_t f = 0; f < o_.poly(op).face_count(); ++f) {
        const std::size_t first = corners.size();
        const FacetFeatures features =
            close_.of_face(op, f) ? append_face(o_, op, f, corners) : append_face_and_vertex(o_, op, f, corners);
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
        if (close_.of_crossing(id) && !crosses_properly(o_, c)) continue;
        const std::size_t first = corners.size();
        const FacetFeatures features = append_crossing(o_, c, corners);
        close(first, features, id < is_new.size() && is_new[id]);
      }
  }

 private:
  void close(std::size_t first, const FacetFeatures& features, bool changed) {
    facets.push_back({first, static_cast<std::uint32_t>(corners.size() - first), changed, features.p, features.q});
  }

  const Overlay& o_;
  CloseFacets close_;
  std::array<std::vector<bool>, 2> changed_;
};

/// The vertices of all corners by P's, and the index of each corner's.
void name_corners(const Overlay& overlay, const std::vector<VertexPair>& corners, ConvexFacets& all) {
  const Polytope &p = overlay.poly(0), &q = overlay.poly(1);
  std::vector<std::uint32_t> begin(p.vertex_count() + std::size_t{1}, 0);  // by P's vertex
  for (const VertexPair& c : corners) ++begin[c.p + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::uint32_t> of_p(corners.size());
  for (std::uint32_t k = 0; k < corners.size(); ++k) of_p[begin[corners[k].p]++] = k;  // begin becomes end
  all.corners.resize(corners.size());
  std::vector<std::uint32_t> named(q.vertex_count(),
                                   0);  // how many vertices there were with the last one of Q's vertex
  std::uint32_t k = 0;
  for (std::uint32_t v = 0; v < p.vertex_count(); ++v) {
    const std::size_t first = all.vertices.size();
    for (; k < begin[v]; ++k) {
      const std::uint32_t w = corners[of_p[k]].q;
      if (named[w] <= first) {
        all.vertices.push_back({p.source_vertex[v], q.source_vertex[w]});
        named[w] = static_cast<std::uint32_t>(all.vertices.size());
      }
      all.corners[of_p[k]] = named[w] - 1;
    }
  }
}

}  // namespace

ConvexFacets assemble(const Overlay& overlay) {
  Drafts drafts(overlay);
  drafts.add_faces();
  drafts.add_crossings();
  ConvexFacets all;
  name_corners(overlay, drafts.corners, all);
  all.facets = std::move(drafts.facets);
  return all;
}

}  // namespace dymsum::spatial
