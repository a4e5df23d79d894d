// Where walks go on in the nodes at which something touches at every scale: which rays are there now, and the sector
// rule on them.
#pragma once

#include <cstdint>
#include <vector>

#include "planar/scaling/window.h"

namespace dymsum::planar {

class NodeLinks {
 public:
  explicit NodeLinks(const Window& window);

  /// Before the lists of a frame are looked at; `first`: of the first one.
  void begin(bool first);
  /// Whether a touch lies inside its piece now.
  void set_touch(std::uint32_t touch, bool here) {
    if (touch_active_[touch] == static_cast<std::uint8_t>(here)) return;
    touch_active_[touch] = here;
    dirty_.push_back(window_.touches[touch].node);
  }
  /// Links the rays anew of all nodes at which a touch came or went since begin(). Calls f(piece) for pieces on which
  /// walks go another way than before.
  template <class F>
  void relink(F&& f) {
    sort_dirty();
    for (const std::uint32_t node : dirty_) relink(node, f);
  }

  /// Nodes at which something touches now.
  bool active(std::uint32_t node) const { return node_active_[node] != 0; }
  bool active_touch(std::uint32_t touch) const { return touch_active_[touch] != 0; }
  /// The node at the end of a ray, if it is active, or kNone.
  std::uint32_t node_at(std::uint32_t ray) const {
    return ray != kNone && active(window_.node_of_ray[ray]) ? window_.node_of_ray[ray] : kNone;
  }
  /// The ray in which the boundary goes on that arrives through one, or kNone; whether one is such a ray.
  std::uint32_t leaving(std::uint32_t arriving) const { return link_[arriving]; }
  bool entered(std::uint32_t ray) const { return entered_[ray] != 0; }
  /// Nodes that the last relink() looked at.
  const std::vector<std::uint32_t>& relinked() const { return dirty_; }

 private:
  struct Way {
    std::uint32_t link = kNone;
    bool entered = false;
  };
  void sort_dirty();
  /// Whether the node was active before and is now.
  struct Activity {
    bool before, now;
  };
  Activity link_rays(const PersistentNode& node, std::uint32_t number);
  template <class F>
  void relink(std::uint32_t node, F&& f) {
    const PersistentNode& n = window_.nodes[node];
    const Activity active = link_rays(n, node);
    for (std::uint32_t r = n.first_ray; r < n.last_ray; ++r) {
      const Way before = ways_before_[r - n.first_ray];
      if (active.before == active.now && before.link == link_[r] && before.entered == entered(r)) continue;
      f(window_.rays[r].piece);
    }
  }

  const Window& window_;
  std::vector<std::uint8_t> touch_active_, node_active_, entered_;  ///< per touch, node, ray
  std::vector<std::uint32_t> link_;                                 ///< ray that arrives -> ray that leaves, or kNone
  std::vector<std::uint32_t> rays_here_;                            ///< of a node
  std::vector<Way> ways_before_;
  std::vector<std::uint32_t> dirty_;  ///< nodes where a touch came or went in this frame
};

}  // namespace dymsum::planar
