// A finished solid kept beside an overlay: what differs from the overlay as the solid last saw it is found by comparing
// the two, so nothing can be missed, whatever moved in between.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dymsum/convex_solid.h"
#include "spatial/convex/facet_corners.h"
#include "spatial/convex/nearest_positions.h"
#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

// The index of the sum's vertex for each pair of vertices: a hash table with open addressing.

class PairIndex {
 public:
  /// The index of a pair; where it has none, it gets the one that fresh() gives. O(1) on average.
  template <class Fresh>
  std::uint32_t find_or_add(VertexPair pair, const Fresh& fresh) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    std::size_t at = home(pair);
    while (slots_[at].pair != kNoPair) {
      if (slots_[at].pair == pair) return slots_[at].index;
      at = (at + 1) & (slots_.size() - 1);
    }
    ++count_;
    slots_[at] = {pair, fresh()};
    return slots_[at].index;
  }
  /// Requires that the pair is there.
  void erase(VertexPair pair) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t hole = home(pair);
    while (slots_[hole].pair != pair) hole = (hole + 1) & mask;
    // What would no longer be found behind the hole moves into it.
    for (std::size_t at = (hole + 1) & mask; slots_[at].pair != kNoPair; at = (at + 1) & mask) {
      if (((at - home(slots_[at].pair)) & mask) < ((at - hole) & mask)) continue;
      slots_[hole] = slots_[at];
      hole = at;
    }
    slots_[hole].pair = kNoPair;
    --count_;
  }
  std::size_t bytes() const { return slots_.capacity() * sizeof(Slot); }

 private:
  struct Slot {
    VertexPair pair = kNoPair;
    std::uint32_t index = 0;
  };
  std::size_t home(VertexPair pair) const {
    constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15;  // 2^64 over the golden ratio: spreads runs of numbers
    const std::uint64_t key = (std::uint64_t{pair.p} << 32 | pair.q) * kGolden;
    return static_cast<std::size_t>((key ^ key >> 29) * kGolden >> (64 - std::countr_zero(slots_.size())));
  }
  void grow() {
    std::vector<Slot> before(slots_.empty() ? 64 : 2 * slots_.size());
    before.swap(slots_);
    for (const Slot& slot : before) {
      if (slot.pair == kNoPair) continue;
      std::size_t at = home(slot.pair);
      while (slots_[at].pair != kNoPair) at = (at + 1) & (slots_.size() - 1);
      slots_[at] = slot;
    }
  }

  std::vector<Slot> slots_;  // a power of two
  std::size_t count_ = 0;
};

// The vertices of a solid whose indices stay: a vertex leaves when no corner of a facet stands at it any more.

class KeptVertices {
 public:
  /// The pair of each index; kNoPair where one is free.
  std::span<const VertexPair> pairs() const { return pairs_; }
  /// The corners that a facet had go.
  void leave(std::span<const std::uint32_t> corners);
  /// A corner of that facet now: its vertex. Calls fresh(vertex) for one that has no index yet.
  template <class Fresh>
  std::uint32_t enter(VertexPair pair, const Fresh& fresh) {
    const std::uint32_t v = index_.find_or_add(pair, [&] {
      const std::uint32_t added = index_for(pair);
      fresh(added);
      return added;
    });
    ++uses_[v];
    return v;
  }
  /// Whether the facet had a corner there that went.
  bool was_left(std::uint32_t v) const { return left_[v] == stamp_; }
  /// Frees those without corners, and lists them, sorted.
  void drop_unused(std::vector<std::uint32_t>& gone);
  /// Memory held beside this.
  std::size_t bytes() const {
    const auto of = [](const auto&... v) { return (std::size_t{0} + ... + (v.capacity() * sizeof(v[0]))); };
    return index_.bytes() + of(pairs_, uses_, left_, free_, unused_);
  }

 private:
  std::uint32_t index_for(VertexPair pair);

  PairIndex index_;
  std::vector<VertexPair> pairs_;
  std::vector<std::uint32_t> uses_, left_;  // how many corners are there; the stamp when one last went
  std::vector<std::uint32_t> free_, unused_;
  std::uint32_t stamp_ = 0;
};

// The slots of an overlay's crossings, as a solid kept beside it last saw them.

/// A slot for each index of a crossing, free or not. A crossing of the same two edges keeps its slot.
class CrossingSlots {
 public:
  /// The two edges that cross; none where an index is free.
  struct Edges {
    std::uint32_t p = kNoCrossing, q = kNoCrossing;
    std::uint64_t key() const { return std::uint64_t{p} << 32 | q / 2; }
    bool is_there() const { return p != kNoCrossing; }
    friend bool operator==(const Edges&, const Edges&) = default;
  };
  static Edges edges_now(const Overlay& overlay, std::uint32_t crossing);

  std::size_t size() const { return slot_.size(); }
  void add() { slot_.push_back(static_cast<std::uint32_t>(seen_.size())), seen_.emplace_back(); }
  std::uint32_t of(std::uint32_t crossing) const { return slot_[crossing]; }
  /// What the slot of a crossing was of when it was seen last.
  Edges& seen(std::uint32_t crossing) { return seen_[slot_[crossing]]; }
  /// What was made anew, or went and came back, has another index now: its slot stays. Requires a slot for every index
  /// of the overlay.
  void keep(const Overlay& overlay);
  /// Memory held beside this.
  std::size_t bytes() const;

 private:
  /// A crossing that another one was before, or will be: its edges, and its slot or index.
  struct Moved {
    std::uint64_t key;
    std::uint32_t at;
  };
  std::vector<std::uint32_t> slot_;    // of the overlay's indices
  std::vector<Edges> seen_;            // by slots
  std::vector<Moved> before_, now_;    // scratch of keep
  std::vector<std::uint32_t> vacant_;  // the same
};

class KeptSolid {
 public:
  /// Holds nothing yet. `operands` has to outlive this.
  KeptSolid(const Overlay& overlay, const ConvexOperands& operands);

  /// Makes it the solid of the overlay, which is that of the same operands, at these poses.
  void follow(const Overlay& overlay, const SolidPose& p, const SolidPose& q);
  const ConvexSolid& solid() const { return solid_; }
  /// Memory held.
  std::size_t bytes() const;

 private:
  struct Counts {
    std::uint32_t before, now, kept;
  };
  std::uint32_t facet_of(int op, std::uint32_t f) const { return op == 0 ? f : p_faces_ + f; }
  std::uint32_t facet_of(std::uint32_t crossing) const { return p_faces_ + q_faces_ + slots_.of(crossing); }
  void add_crossings(const Overlay& overlay);
  void follow_faces(const Overlay& overlay);
  void follow_crossings(const Overlay& overlay);
  void change(std::uint32_t facet, const FacetFeatures& features, bool same);
  bool is_as_before(std::uint32_t facet) const;
  void add_facet(std::uint32_t corners);
  void allot(std::uint32_t facet, std::uint32_t corners);
  void note(std::uint32_t facet, bool same, const Counts& corners);
  void add_vertex(std::uint32_t v);
  void drop_unused_vertices();
  void name_new_vertices(const Overlay& overlay);
  void join_ranges();

  ConvexSolid solid_;
  std::uint32_t p_faces_, q_faces_;
  // The overlay's words as they were.
  std::array<std::vector<std::uint32_t>, 2> extreme_;
  CrossingSlots slots_;  // facets after those of the faces
  CloseFacets close_;
  std::vector<std::uint8_t> was_close_;  // of each facet
  std::vector<std::uint32_t> room_;      // of each facet, for corners; two less for triangles
  KeptVertices vertices_;
  NearestPositions positions_;
  std::vector<VertexPair> corners_;  // of the facet at hand
};

}  // namespace dymsum::spatial
