#include "spatial/convex/facet_count.h"

#include <algorithm>
#include <vector>

#include "spatial/convex/facet_corners.h"

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

}  // namespace

// Every face makes a facet, a pair that faces the same way one together, and so does every crossing that has an area.
ConvexSum::FacetCount count_facets(const Overlay& o) {
  const std::vector<bool> new_p = marked(o.poly(0).face_count(), o.changes().faces[0]),
                          new_q = marked(o.poly(1).face_count(), o.changes().faces[1]),
                          new_crossing = marked(0, o.changes().crossings);
  const auto count = [](const std::vector<bool>& marks) {
    return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), true));
  };
  ConvexSum::FacetCount facets{new_p.size() + new_q.size(), count(new_p) + count(new_q)};
  facets.all -= o.pairs().size();
  for (const Overlay::FacePair& pair : o.pairs()) facets.changed -= new_p[pair.p] && new_q[pair.q];
  for (std::uint32_t e = 0; e < o.poly(0).edge_count(); ++e)
    for (std::uint32_t id = o.first_crossing(0, e); id != kNoCrossing; id = o.crossing(id).next[0]) {
      if (!crosses_properly(o, o.crossing(id))) continue;
      ++facets.all;
      facets.changed += id < new_crossing.size() && new_crossing[id];
    }
  return facets;
}

}  // namespace dymsum::spatial
