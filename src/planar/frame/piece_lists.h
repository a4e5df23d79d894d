// The crossings on every piece of a window in order, kept true from frame to frame, and where walks go on.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/memory_budget.h"
#include "dymsum/frames.h"
#include "planar/motion/operand_pair.h"
#include "planar/window/scaling_window.h"

namespace dymsum::planar {

/// Where walks go on in the nodes at which something touches at every scale: which rays are there now, and the sector
/// rule on them.
class NodeLinks {
 public:
  explicit NodeLinks(const Window& window);

  /// Comes before the lists of a frame are looked at; `first`: it is the first one.
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
  struct Passage {
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
      const Passage before = passages_before_[r - n.first_ray];
      if (active.before == active.now && before.link == link_[r] && before.entered == entered(r)) continue;
      f(window_.rays[r].piece);
    }
  }

  const Window& window_;
  std::vector<std::uint8_t> touch_active_, node_active_, entered_;  ///< per touch, node, ray
  std::vector<std::uint32_t> link_;                                 ///< ray that arrives -> ray that leaves, or kNone
  std::vector<std::uint32_t> rays_here_;                            ///< of a node
  std::vector<Passage> passages_before_;
  std::vector<std::uint32_t> dirty_;  ///< nodes where a touch came or went in this frame
};

/// Each list knows an interval of scales over which it provably stays as it is; only lists whose interval was left are
/// looked at.
class PieceLists {
 public:
  explicit PieceLists(Window& window);

  /// Brings every list to this frame. False when something touches here: the lists of the pieces involved are then
  /// unspecified, and will be looked at again.
  bool repair(double tau, ExactFrame& frame, FrameWork& work);

  std::uint32_t count(std::uint32_t piece) const { return hot_[piece].count; }
  /// What is at position k: a candidate that crosses here, or, with kTouchBit, a persistent touch.
  std::uint32_t entry(std::uint32_t piece, std::uint32_t k) const { return list_[base(piece) + k]; }
  /// Sub-edges are numbered first_sub(piece) + 0 .. count; the numbers of different pieces never overlap.
  std::uint32_t first_sub(std::uint32_t piece) const { return base(piece) + piece; }
  std::uint32_t sub_limit() const { return static_cast<std::uint32_t>(list_.size() + hot_.size()); }

  /// What the window's piece has.
  std::uint8_t half(std::uint32_t piece) const { return hot_[piece].half; }
  std::int8_t next_turn(std::uint32_t piece) const { return hot_[piece].next_turn; }

  /// What may lie on a piece somewhere in the window.
  struct Entry {
    double out_low, in_low, in_high, out_high;  ///< as for Candidate
    Linear t;
    double error;
    std::uint32_t id;  ///< candidate, or touch with kTouchBit
    bool inside;       ///< in the list
  };
  std::span<const Entry> entries(std::uint32_t piece) const {
    return {entries_.data() + hot_[piece].base, hot_[piece].entries};
  }
  /// The position of an entry on a piece, anywhere in the window.
  struct Line {
    Linear t;
    double error = 0;
  };
  Line line(std::uint32_t piece, std::uint32_t entry) const {
    if (entry & kTouchBit) return {window_.touches[entry & ~kTouchBit].t, window_.touches[entry & ~kTouchBit].error};
    const Candidate& c = window_.candidates[entry];
    return c.a == piece ? Line{c.ta, c.error_a} : Line{c.tb, c.error_b};
  }
  /// Whether all entries of a piece but two stay outside of a part of it while they are there, at every scale from low
  /// to high. `margin`: what bounds the errors of its ends.
  bool stays_clear(std::uint32_t piece, const std::array<Linear, 2>& ends, double margin,
                   const std::array<std::uint32_t, 2>& but, double low, double high) const;
  /// A candidate's pieces and its positions in their lists, while it crosses.
  struct Crossing {
    std::uint32_t a, b, at_a, at_b;
    std::int32_t sign;
  };
  const Crossing& crossing(std::uint32_t candidate) const { return crossings_[candidate]; }

  struct Step {
    std::uint32_t piece = kNone, sub = 0;
    friend bool operator==(const Step&, const Step&) = default;
  };
  bool dead(Step s) const {
    const Hot& h = hot_[s.piece];
    return (s.sub == 0 && h.head_cut) || (s.sub == h.count && h.tail_cut);
  }
  bool alive_at_start(Step s) const {
    if (dead(s)) return false;
    const std::uint32_t e = s.sub == 0 ? kTouchBit : entry(s.piece, s.sub - 1);
    if (e & kTouchBit) return alive_at_touch(s);
    return (crossings_[e].a == s.piece ? crossings_[e].sign : -crossings_[e].sign) > 0;
  }
  Step successor(Step s) const {
    if (dead(s)) return {};
    const std::uint32_t e = s.sub == hot_[s.piece].count ? kTouchBit : entry(s.piece, s.sub);
    if (e & kTouchBit) return successor_at_touch(s);
    const Crossing& c = crossings_[e];
    const bool a = c.a == s.piece;
    if ((a ? c.sign : -c.sign) > 0) return {};
    const Step to = a ? Step{c.b, c.at_b + 1} : Step{c.a, c.at_a + 1};
    return dead(to) ? Step{} : to;
  }
  /// The ray through which a sub-edge arrives in that node, and the one in which the boundary goes on or kNone.
  /// Requires: it ends in one.
  std::uint32_t arriving_ray(Step s) const;
  std::uint32_t leaving_ray(std::uint32_t arriving) const { return links_.leaving(arriving); }
  /// The node in which a sub-edge ends, if something touches there now, or kNone.
  std::uint32_t end_node(Step s) const;
  /// What touches now.
  const NodeLinks& links() const { return links_; }

  /// Pieces looked at by the last repair, and those among them whose list changed.
  bool touched(std::uint32_t piece) const { return touched_[piece] == frame_; }
  const std::vector<std::uint32_t>& looked_at() const { return looked_at_; }
  const std::vector<std::uint32_t>& changed() const { return changed_; }
  bool has_changed(std::uint32_t piece) const { return changed_at_[piece] == frame_; }
  /// What is new on a piece whose list changed: the sub-edges [first, last] that were not there before, by what is at
  /// their ends or where they lead.
  struct NewSubs {
    std::uint32_t first = 0, last = 0;
  };
  NewSubs new_subs(std::uint32_t piece) const { return new_subs_[piece]; }
  /// The sub-edge between two entries of a piece's list, kNone standing for its own ends, if they are neighbours now.
  Step between(std::uint32_t piece, std::uint32_t from, std::uint32_t to) const;
  /// A piece's list provably stays as it is strictly between these; empty where only exact signs know it.
  std::array<double, 2> proved(std::uint32_t piece) const { return {low_[piece], high_[piece]}; }
  Window& window() const { return window_; }
  std::size_t bytes() const;

 private:
  void add_entries();
  struct Item {
    double t, error, slope;
    std::uint32_t entry;
  };
  /// While a piece is looked at: where its list is proved, whether exact signs were needed, whether nothing touches.
  struct Certainty {
    double low = -INFINITY, high = INFINITY;
    bool exact = false, generic = true;
  };
  bool refresh(std::uint32_t piece, double tau, ExactFrame& frame, FrameWork& work);
  std::uint32_t collect(std::uint32_t piece, double tau, ExactFrame& frame, Certainty& proved);
  static bool inside(const Entry& e, double tau, Certainty& proved, bool& unsure);
  bool inside_exactly(std::uint32_t piece, std::uint32_t id, ExactFrame& frame, Certainty& proved) const;
  void sort_items(std::uint32_t piece, ExactFrame& frame);
  void look_at_neighbours(std::uint32_t piece, double tau, ExactFrame& frame, Certainty& proved) const;
  std::optional<NewSubs> store(std::uint32_t piece);
  bool alive_at_touch(Step s) const;
  Step successor_at_touch(Step s) const;
  std::uint32_t base(std::uint32_t piece) const { return hot_[piece].base; }
  Step target(std::uint32_t ray) const;
  void mark_changed(std::uint32_t piece, NewSubs subs);
  std::uint32_t position_in_list(std::uint32_t piece, std::uint32_t entry) const;
  int compare(std::uint32_t piece, const Item& a, const Item& b, ExactFrame& frame) const {
    const double gap = a.t - b.t, error = a.error + b.error;
    return gap > error ? 1 : gap < -error ? -1 : compare_exactly(piece, a, b, frame);
  }
  int compare_exactly(std::uint32_t piece, const Item& a, const Item& b, ExactFrame& frame) const;
  Cut cut_at(std::uint32_t piece, std::uint32_t entry) const;
  bool before_end(std::uint32_t piece, std::uint32_t entry, ExactFrame& frame, Certainty& proved) const;

  Window& window_;
  base::CountedArray<double> low_, high_;  ///< the list of a piece is proved strictly between
  static constexpr std::uint32_t kBlock = 8;
  base::CountedArray<std::array<double, 2>> blocks_;  ///< where the lists of kBlock pieces are proved
  /// What walks ask of a piece.
  struct Hot {
    std::uint32_t base = 0, entries = 0;  ///< where its list and its entries start; how many entries
    std::uint32_t count = 0;              ///< in the list
    std::uint32_t next = kNone, head_ray = kNone, tail_ray = kNone;  ///< as in the window
    bool head_cut = false, tail_cut = false;
    std::int8_t next_turn = 0;
    std::uint8_t half = 0;
  };
  base::CountedArray<Hot> hot_;
  base::CountedArray<std::uint32_t> list_;
  base::CountedArray<Entry> entries_;
  base::CountedArray<Crossing> crossings_;  ///< per candidate
  std::vector<std::uint32_t> touched_, looked_at_, changed_at_, changed_;
  std::vector<NewSubs> new_subs_;  ///< per piece, of the frame in which it changed last
  std::vector<Item> items_;
  NodeLinks links_;
  std::uint32_t frame_ = 0;
};

/// How two live segments meet at an exact scale.
enum class Meet { none, crossing, degenerate };
Meet meet(const Window& window, std::uint32_t a, std::uint32_t b, ExactFrame& frame);

}  // namespace dymsum::planar
