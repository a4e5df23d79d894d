// How the segments of a soup hang together at their ends.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planar/arrangement/soup.h"

namespace dymsum::planar {

/// A segment that starts or ends at a pair.
struct Incidence {
  std::uint32_t segment = 0;
  bool starts = false;
};

class Chain {
 public:
  explicit Chain(Scratch* memory) : next_(memory) {}
  virtual ~Chain() = default;
  /// The segment that continues s at its end in the generic case, or kNone.
  std::uint32_t next(std::uint32_t s) const { return next_[s]; }
  std::span<const std::uint32_t> next() const { return next_; }
  /// Segments from this index on belong to no chain: their shared ends are meetings like any other.
  std::uint32_t first_unchained() const { return first_unchained_; }
  /// Appends all segments that start or end at a pair of walk vertices.
  virtual void incident(WalkPair v, Array<Incidence>& out) const = 0;

 protected:
  Array<std::uint32_t> next_;
  std::uint32_t first_unchained_ = kNone;
};

}  // namespace dymsum::planar
