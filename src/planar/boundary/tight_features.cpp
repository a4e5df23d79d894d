#include "planar/boundary/tight_features.h"

#include <algorithm>

namespace dymsum::planar {

// Cracks and punctures: candidates of the arrangement that are not inside the open sum.
// A sector that no segment covers may still lie inside: where a chain ends at a reflex vertex its contact covers more
// than the half discs of its segments. So every node off the boundary is tested, not only those whose sectors are all
// covered.
void find_tight_features(const Soup& soup, const Arrangement& arrangement, const Array<BoundaryLoop>& kept,
                         Collision& collision, RawBoundary& out, double& grid_error, const Poll* poll) {
  const std::size_t rounds = arrangement.covered_subs().size() + arrangement.nodes().size();
  std::size_t round = 0;
  if (arrangement.nodes().empty()) return;
  Array<std::uint8_t> on_boundary(arrangement.degenerate_nodes() + 1, 0, soup.memory);
  for (const BoundaryLoop& loop : kept)
    for (const Step& step : loop.steps)
      if (const std::uint32_t node = arrangement.end_node(step); node != kNone) on_boundary[node] = 1;
  for (const Step& step : arrangement.covered_subs()) {
    if (poll != nullptr) poll->at_test(round++, rounds);
    if (collision.overlaps(arrangement.sample(step))) continue;
    const SegmentPosition from = arrangement.start_position(step), to = arrangement.end_position(step);
    const SubEnd a = arrangement.start_of(step), b = arrangement.end_of(step);
    grid_error = std::max({grid_error, position_error(soup, from), position_error(soup, to)});
    const std::uint32_t s = step.segment;
    out.cracks.push_back(
        {vertex_of(soup, s, a.pair ? s : a.other, a, from), vertex_of(soup, s, b.pair ? s : b.other, b, to)});
  }
  for (const Arrangement::Node& node : arrangement.nodes()) {
    if (poll != nullptr) poll->at_test(round++, rounds);
    if (on_boundary[node.index] != 0) continue;
    const SegmentPosition position = arrangement.position_of(node);
    if (collision.overlaps(position)) continue;
    grid_error = std::max(grid_error, position_error(soup, position));
    out.punctures.push_back(
        vertex_of(soup, node.segment, node.end.pair ? node.segment : node.end.other, node.end, position));
  }
}

}  // namespace dymsum::planar
