// The slots of an overlay's crossings, as a solid kept beside it last saw them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "spatial/gauss/overlay.h"

namespace dymsum::spatial {

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

}  // namespace dymsum::spatial
