#include "spatial/convex/facet_count.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "spatial/convex/assemble.h"

namespace dymsum::spatial {
namespace {

/// Marks of some of n things.
std::vector<bool> marked(std::size_t n, const std::vector<std::uint32_t>& some) {
  std::vector<bool> marks(n);
  for (const std::uint32_t i : some) {
    if (i >= marks.size()) marks.resize(i + 1);
    marks[i] = true;
  }
  return marks;
}

/// The faces on both sides of the edges of a crossing that face the same way.
void add_parallel_faces(const Overlay& o, const Crossing& c,
                        std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
  for (const std::uint32_t f : {o.poly(0).face[2 * c.p], o.poly(0).face[2 * c.p + 1]}) {
    const ExtremeFeature q = extreme_feature(o, 0, f);
    if (q.vertices.size() > 2) pairs.emplace_back(f, q.face);
  }
}

}  // namespace

// Every face makes a facet, a pair that faces the same way one together, and so does every crossing that has an area.
// Where a face f of P and a face g of Q face the same way, the infinitesimal rotation moves g's direction into a cell
// beside f's, a cone of less than half a turn there. The arcs of g leave in directions that no half-plane holds, so
// some leave the cone across an arc of f: near f, at a crossing with a zero sign. So pairs are found at crossings
// without area.
ConvexSum::FacetCount count_facets(const Overlay& o) {
  const std::vector<bool> new_p = marked(o.poly(0).face_count(), o.changes().faces[0]),
                          new_q = marked(o.poly(1).face_count(), o.changes().faces[1]),
                          new_crossing = marked(0, o.changes().crossings);
  const auto count = [](const std::vector<bool>& marks) {
    return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), true));
  };
  ConvexSum::FacetCount facets{new_p.size() + new_q.size(), count(new_p) + count(new_q)};
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t e = 0; e < o.poly(0).edge_count(); ++e)
    for (std::uint32_t id = o.first_crossing(0, e); id != kNoCrossing; id = o.crossing(id).next[0]) {
      if (crosses_properly(o, o.crossing(id))) {
        ++facets.all;
        facets.changed += id < new_crossing.size() && new_crossing[id];
      } else {
        add_parallel_faces(o, o.crossing(id), pairs);
      }
    }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  facets.all -= pairs.size();
  for (const auto& [f, g] : pairs) facets.changed -= new_p[f] && new_q[g];
  return facets;
}

}  // namespace dymsum::spatial
