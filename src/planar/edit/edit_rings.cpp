#include "planar/edit/edit_rings.h"

#include <algorithm>

#include "planar/boundary/boundary.h"
#include "planar/result/planar_sum.h"

namespace dymsum::planar {

SumRing ring_of_steps(const EditArrangement& arrangement, std::span<const LiveSubEdge> steps, const ExactSource& source,
                      double& error) {
  const Soup& soup = arrangement.soup();
  SumPart part;
  SumRing& ring = part.outer;
  ring.vertices.reserve(steps.size());
  const std::size_t n = steps.size();
  double worst = error;
  for (std::size_t i = 0; i < n; ++i) {
    const LiveSubEdge at = steps[i];
    const std::uint32_t s = at.segment, next = steps[i + 1 == n ? 0 : i + 1].segment;
    if (s == next || soup.cross(s, next) == 0) continue;  // straight on
    const EditArrangement::End end = arrangement.end_of(at);
    const SegmentPosition x = arrangement.position(end, s);
    worst = std::max(worst, position_error(soup, x));
    ring.vertices.push_back(vertex_of(soup, s, next, end.end, x));
  }
  error = worst;
  std::vector<SumPart> one;
  one.push_back(std::move(part));
  canonicalize(one, source, input_error(soup.lattice, worst));
  return std::move(one[0].outer);
}

void rename_vertices(SumRing& ring, const std::array<WalkChanges, 2>& walks) {
  const auto rename = [&](Contact& c) {
    c.p = walks[0].vertex_index(c.p);
    c.q = walks[1].vertex_index(c.q);
  };
  for (SumVertex& v : ring.vertices) {
    rename(v.in);
    rename(v.out);
    if (v.corner_p != SumVertex::kNone) v.corner_p = walks[0].vertex_index(v.corner_p);
    if (v.corner_q != SumVertex::kNone) v.corner_q = walks[1].vertex_index(v.corner_q);
  }
}

}  // namespace dymsum::planar
