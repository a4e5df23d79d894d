// Rings from frame to frame, and the loops behind them: their canonical order, which one is which, and which loops
// bound the sum.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "dymsum/frames.h"
#include "dymsum/planar_sum.h"
#include "planar/boundary/boundary.h"
#include "planar/boundary/collision.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {

/// The rings of all parts, the outer ring of each first.
std::vector<const SumRing*> rings_of(const PlanarSum& sum);

/// Hashes of what names a contact and a vertex.
std::uint64_t mixed(std::uint64_t h, std::uint64_t v);
std::uint64_t key(const Contact& c);
std::uint64_t key(const SumVertex& v);

/// What is known of a cycle of a frame, whatever moves.
struct LoopStatus {
  int turning = 0;                                         ///< the turning number: 1 for counter-clockwise ones
  std::uint32_t corners = 0;                               ///< steps with a vertex
  bool kept = false;                                       ///< it bounds the sum
  std::optional<CrossingEdges> witness;                    ///< of one that does not: what covers it
  std::uint64_t ring = 0;                                  ///< identity of a kept one, 0: not yet given
  std::uint32_t vertices_before = 0, vertices_shared = 0;  ///< of the ring whose identity it has taken, and of both
};

/// A connected sum has exactly one counter-clockwise true loop, the one that reaches farthest left: its index, or the
/// number of loops. told(i): the status of loop i is known. for_each_end(i, f) calls f(x, error) for its vertices.
template <class Loop, class Decided, class ForEachEnd>
std::size_t outer_loop(const std::vector<Loop>& loops, const Decided& decided, const ForEachEnd& for_each_end) {
  std::size_t count = 0, last = 0;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (loops[i].turning <= 0) continue;
    if (decided(i) && loops[i].kept) return i;
    ++count;
    last = i;
  }
  if (count == 1) return last;
  return leftmost_loop(
      loops.size(), [&](std::size_t i) { return loops[i].turning < 0; }, for_each_end);
}

/// Decides which loops bound the sum among those that are not told. covered(loop): the face right of it lies in the
/// sum.
template <class Loop, class Decided, class ForEachEnd, class Covered>
void decide_loops(std::vector<Loop>& loops, bool connected, const Decided& decided, const ForEachEnd& for_each_end,
                  const Covered& covered) {
  const std::size_t outer = connected ? outer_loop(loops, decided, for_each_end) : loops.size();
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (decided(i)) continue;
    if (i == outer) loops[i].kept = true;
    else if (outer != loops.size() && loops[i].turning > 0) loops[i].kept = false;
    else loops[i].kept = !covered(loops[i]);
  }
}

/// The rings of kept loops, each from its smallest vertex on.
struct KeptRings {
  std::vector<SumRing> rings;
  std::vector<std::uint8_t> outer;
  std::vector<LoopStatus*> loops;
  double at_error = 0;
};

/// What is known of a ring that has been written: which item is its smallest vertex, and the largest error of a
/// position.
struct WrittenRing {
  std::uint32_t leader = 0xffffffff;
  double error = 0;
};
/// A loop's vertices as a ring from the smallest one on, which the one at `start` often is. put(item, vertex) makes an
/// item a vertex of the sum and returns the error of its position. Requires: no two vertices at one position.
template <class Put>
WrittenRing write_ring(std::span<const std::uint32_t> items, std::size_t start, const VertexOrder& order,
                       const Put& put, SumRing& ring) {
  ring.vertices.resize(items.size());
  SumVertex* const first = ring.vertices.data();
  SumVertex *to = first, *least = first;
  WrittenRing written;
  const auto put_all = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i, ++to) {
      written.error = std::max(written.error, put(items[i], *to));
      if (to != first && (order.provably_right(*to, *least) || order.compare(*to, *least) >= 0)) continue;
      least = to;
      written.leader = items[i];
    }
  };
  put_all(start, items.size());
  put_all(0, start);
  std::rotate(first, least, to);
  return written;
}

/// Puts rings, each from its smallest vertex on, into the sum in canonical order; `outer` tells the counter-clockwise
/// ones. Returns for each ring of the sum, in the order of rings_of, its number in `rings`. Requires: no two rings
/// touch.
std::vector<std::size_t> place_rings(std::vector<SumRing> rings, const std::vector<std::uint8_t>& outer,
                                     PlanarSum& sum);

/// The identities of rings that are handed on from frame to frame.
class RingIdentities {
 public:
  /// Lists what became of the rings of kept loops, in this order, and names new ones. `stays`: at the same position.
  void follow(std::span<LoopStatus* const> kept, bool stays, FrameChanges& changes);
  /// Finds the identities of the rings of `after` from those of `before`, which are given: each takes that of the first
  /// ring with which it shares a vertex, unless it is taken. Lists what changed, not sorted.
  std::vector<std::uint64_t> match(const PlanarSum& before, const std::vector<std::uint64_t>& ids,
                                   const PlanarSum& after, bool same_position, FrameChanges& changes);

 private:
  void follow(LoopStatus& loop, bool stays, FrameChanges& changes);
  std::uint64_t next_ = 1;
};

/// The identities that loops have taken from those of the frame before.
class RingClaims {
 public:
  void begin_frame(std::size_t loops_before) { claimed_.assign(loops_before, 0); }
  void begin(LoopStatus& loop) {
    loop_ = &loop;
    from_ = 0xffffffff;
  }
  /// The loop has vertices of a kept one of the frame before: it takes the identity of the first such one, unless
  /// another loop has it.
  void fractions(std::uint32_t old, const LoopStatus& before, std::uint32_t vertices) {
    if (from_ == 0xffffffff && !claimed_[old] && before.ring != 0) {
      from_ = old;
      claimed_[old] = 1;
      loop_->ring = before.ring;
      loop_->vertices_before = before.corners;
    }
    if (old == from_) loop_->vertices_shared += vertices;
  }
  bool claimed(std::size_t old) const { return claimed_[old] != 0; }

 private:
  std::vector<std::uint8_t> claimed_;
  LoopStatus* loop_ = nullptr;
  std::uint32_t from_ = 0xffffffff;
};

/// Sorts the changed rings and reports what else differs.
void finish_changes(const PlanarSum& before, const PlanarSum& after, FrameChanges& changes);

}  // namespace dymsum::planar
