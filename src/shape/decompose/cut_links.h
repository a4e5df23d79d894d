// What cuts connect. A cut separates something exactly where the rings and cuts that it connects are connected without
// it, too.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/scratch.h"
#include "dymsum/rational.h"
#include "shape/decompose/ring_table.h"

namespace dymsum::shape {

/// Rings are connected twice where every cut between them separates two pieces; they make one block. Cuts are added in
/// rounds; when a round is closed, all rings that are connected are connected twice.
class CutLinks {
 public:
  explicit CutLinks(const RingTable& table);

  struct Stop {
    Rational t;          ///< along the cut
    std::uint32_t node;  ///< a ring, or a position where cuts of this round meet
  };
  /// The next cut: from a ring, over the boundaries of holes, to a ring or, at t, to an earlier cut.
  struct End {
    bool on_cut;
    std::uint32_t index;  ///< ring or cut
    Rational t;           ///< along that cut
  };
  void add(std::uint32_t from, std::vector<Stop> over, const End& end);

  /// Rings connected twice with each other, without the outer one, that only `cut` connects with others.
  struct Loose {
    std::vector<std::uint32_t> rings;
    std::uint32_t cut;
  };
  /// The one with the ring of the least rank, or nothing where every cut separates. O(cuts of the round + rings).
  std::optional<Loose> first_loose();

  /// Requires: there is nothing loose.
  void close_round();

 private:
  struct Link {
    std::uint32_t a, b, cut;
  };
  std::uint32_t node_of(const End& end);
  std::vector<Link> links();

  const RingTable& table_;
  std::vector<std::uint32_t> ranked_;        ///< rings, for ties
  UnionFind blocks_;                         ///< of rings
  std::vector<std::uint32_t> ring_of_;       ///< cut -> ring that it begins at
  std::vector<std::vector<Stop>> stops_;     ///< per cut of the round, in their order
  std::uint32_t first_cut_ = 0, meets_ = 0;  ///< of the round
  bool joins_ = false;                       ///< whether a cut of the round connects different blocks
};

}  // namespace dymsum::shape
