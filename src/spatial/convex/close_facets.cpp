#include "spatial/convex/close_facets.h"

namespace dymsum::spatial {

/// A facet differs from what the overlay's words say only where something is truly zero. A face of the walker has a
/// level edge only where doubles cannot prove that all fall. A crossing is improper where the circle of the walker's
/// edge goes through a face at the other edge, which doubles cannot exclude then, or where its arc only begins or ends
/// there, at a face of the first kind. A face of the other operand has a level edge only where an arc of the walker
/// goes through its direction: then some arc from there is crossed by it, after the infinitesimal rotation, as its arcs
/// leave in directions that no half-plane holds, and that crossing is improper; or it faces the same way as a face of
/// the walker.
void CloseFacets::find(const Overlay& overlay) {
  for (int op = 0; op < 2; ++op) faces_[op].assign(overlay.poly(op).face_count(), 0);
  crossings_.assign(overlay.crossing_indices(), 0);
  const int w = overlay.walker();
  const Polytope &mine = overlay.poly(w), &other = overlay.poly(1 - w);
  for (std::uint32_t f = 0; f < mine.face_count(); ++f) {
    if (overlay.provably_extreme(f)) continue;
    faces_[w][f] = 1;
    HalfEdge h = mine.first[f];
    do {
      for (std::uint32_t id = overlay.first_crossing(w, h / 2); id != kNoCrossing; id = overlay.crossing(id).next[w])
        crossings_[id] = 1;
      h = mine.next[h];
    } while (h != mine.first[f]);
  }
  for (std::uint32_t id = 0; id < overlay.crossing_indices(); ++id) {
    if (!overlay.is_crossing(id) || overlay.provably_crosses(id)) continue;
    const std::uint32_t e = edge_of(1 - w, overlay.crossing(id));
    crossings_[id] = faces_[1 - w][other.face[2 * e]] = faces_[1 - w][other.face[2 * e + 1]] = 1;
  }
  for (const FacePair& pair : overlay.pairs()) faces_[0][pair.p] = faces_[1][pair.q] = 1;
}

}  // namespace dymsum::spatial
