// Loops that meet at nodes, cut and joined to simple rings.
#include <algorithm>
#include <unordered_map>
#include <vector>

#include "planar/boundary/boundary.h"

namespace dymsum::planar {
namespace {

// A sub-edge at a node, by its direction away from the node.
struct Ray {
  Step step;
  bool out;
};

// The rays counter-clockwise from +x; those of one direction stand together.
void sort_rays(const Soup& soup, std::vector<Ray>& rays) {
  const auto half = [&](const Ray& r) {
    const SoupBox& b = soup.boxes[r.step.segment];
    return half_plane(b.dx, b.dy) ^ (r.out ? 0 : 1);
  };
  std::sort(rays.begin(), rays.end(), [&](const Ray& a, const Ray& b) {
    if (half(a) != half(b)) return half(a) < half(b);
    return soup.cross(a.step.segment, b.step.segment) * (a.out == b.out ? 1 : -1) > 0;
  });
}

// The successors of the kept sub-edges, joined anew at nodes that loops pass several times.
class Joined {
 public:
  Joined(const Soup& soup, const Arrangement& arrangement, const Array<BoundaryLoop>& loops,
         const Array<std::uint32_t>& visits)
      : soup_(soup), arrangement_(arrangement) {
    std::unordered_map<std::uint32_t, std::vector<Ray>> nodes;
    for (const BoundaryLoop& loop : loops)
      for (std::size_t i = 0; i < loop.steps.size(); ++i) {
        const Step &in = loop.steps[i], &out = loop.steps[(i + 1) % loop.steps.size()];
        next_[in.sub] = out;
        order_.push_back(in);
        const std::uint32_t node = arrangement.end_node(in);
        if (node == kNone || visits[node] < 2) continue;
        nodes[node].push_back({in, false});
        nodes[node].push_back({out, true});
      }
    for (auto& [node, rays] : nodes) {
      sort_rays(soup, rays);
      for (std::size_t i = 0; i < rays.size(); ++i)
        if (!rays[i].out) next_[rays[i].step.sub] = rays[(i + rays.size() - 1) % rays.size()].step;
    }
  }

  /// Cut where they come back to a node.
  Array<BoundaryLoop> rings() {
    Array<BoundaryLoop> rings(soup_.memory);
    for (const Step& start : order_)
      if (!seen_[start.sub]) follow(start, rings);
    return rings;
  }

 private:
  void follow(Step start, Array<BoundaryLoop>& rings) {
    std::vector<Step> path;
    std::unordered_map<std::uint32_t, std::size_t> at_node;  // node -> length of the path that ends there
    const auto emit = [&](std::size_t from) {
      BoundaryLoop ring;
      ring.steps.assign(path.begin() + static_cast<std::ptrdiff_t>(from), path.end());
      ring.turning = turning_number(soup_, ring.steps);
      for (std::size_t i = from; i + 1 < path.size(); ++i)
        if (const std::uint32_t n = arrangement_.end_node(path[i]); n != kNone) at_node.erase(n);
      path.resize(from);
      rings.push_back(std::move(ring));
    };
    Step at = start;
    do {
      seen_[at.sub] = true;
      path.push_back(at);
      if (const std::uint32_t node = arrangement_.end_node(at); node != kNone) {
        if (const auto it = at_node.find(node); it != at_node.end()) emit(it->second);
        else at_node[node] = path.size();
      }
      at = next_[at.sub];
    } while (at.sub != start.sub);
    if (!path.empty()) emit(0);
  }

  const Soup& soup_;
  const Arrangement& arrangement_;
  std::unordered_map<std::uint32_t, Step> next_;  // by sub-edge
  std::unordered_map<std::uint32_t, bool> seen_;
  std::vector<Step> order_;
};

}  // namespace

// At a node that several kept passes share, every pass in is joined to the next way out clockwise from it: interior
// pairing. Rings then bound connected interiors; those that still meet themselves are cut at the repeated node.
Array<BoundaryLoop> simple_rings(const Soup& soup, const Arrangement& arrangement, Array<BoundaryLoop> loops) {
  if (arrangement.degenerate_nodes() == 0) return loops;
  Array<std::uint32_t> visits(arrangement.degenerate_nodes() + 1, 0, soup.memory);
  bool repeated = false;
  for (const BoundaryLoop& loop : loops)
    for (const Step& step : loop.steps)
      if (const std::uint32_t node = arrangement.end_node(step); node != kNone) repeated |= ++visits[node] > 1;
  return repeated ? Joined(soup, arrangement, loops, visits).rings() : std::move(loops);
}

}  // namespace dymsum::planar
