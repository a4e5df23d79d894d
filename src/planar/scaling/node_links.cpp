#include "planar/scaling/node_links.h"

#include <algorithm>

namespace dymsum::planar {

NodeLinks::NodeLinks(const Window& window)
    : window_(window),
      touch_active_(window.touches.size(), 0),
      node_active_(window.nodes.size(), 0),
      entered_(window.rays.size(), 0),
      link_(window.rays.size(), kNone) {}

void NodeLinks::begin(bool first) {
  dirty_.clear();
  if (!first) return;
  for (std::uint32_t k = 0; k < window_.nodes.size(); ++k)
    if (window_.nodes[k].hands_on && !window_.nodes[k].covered) dirty_.push_back(k);
}

void NodeLinks::sort_dirty() {
  std::sort(dirty_.begin(), dirty_.end());
  dirty_.erase(std::unique(dirty_.begin(), dirty_.end()), dirty_.end());
}

// The sector rule of planar-sum.md on the rays that are there now; their order never changes.
NodeLinks::Activity NodeLinks::link_rays(const PersistentNode& n, std::uint32_t node) {
  rays_here_.clear();
  ways_before_.clear();
  bool any = false;
  for (std::uint32_t r = n.first_ray; r < n.last_ray; ++r) {
    ways_before_.push_back({link_[r], entered(r)});
    link_[r] = kNone;
    entered_[r] = 0;
    const PersistentNode::Ray& ray = window_.rays[r];
    if (ray.touch != kNone && !touch_active_[ray.touch]) continue;
    any |= ray.touch != kNone || n.hands_on;
    rays_here_.push_back(r);
  }
  const std::size_t m = any ? rays_here_.size() : 0;
  const auto group = [&](std::size_t k) { return window_.rays[rays_here_[k]].group; };
  for (std::size_t k = 0; k < m;) {
    std::size_t end = k + 1;
    while (end < m && group(end) == group(k)) ++end;
    const std::size_t to = end == m ? 0 : end;
    // Rays of one direction all leave or all arrive; otherwise the window is left to the static routine.
    if (!window_.rays[rays_here_[k]].out && window_.rays[rays_here_[to]].out) {
      entered_[rays_here_[to]] = 1;
      for (std::size_t q = k; q < end; ++q) link_[rays_here_[q]] = rays_here_[to];
    }
    k = end;
  }
  const bool was_active = active(node);
  node_active_[node] = any;
  return {was_active, any};
}

}  // namespace dymsum::planar
