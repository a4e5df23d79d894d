// Tracks: what becomes of the reflex corners of a sum while its disc grows, and which of them go on where they meet.
// See docs/design/shape-features.md.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "shape/complex/complex.h"

namespace dymsum::shape {

/// A place where tracks begin, meet or end: a node, or nodes that flat edges connect, which lie at one radius.
struct Junction {
  std::vector<std::uint32_t> nodes;    ///< ascending
  std::vector<std::uint32_t> in, out;  ///< edges that ascend to it and from it, ascending
};

/// All junctions in order of radius, and among equal ones of their first nodes. O(edges).
std::vector<Junction> junctions_of(const Complex& complex);

/// The life of a corner of the sum.
struct Bar {
  enum class Death : std::uint8_t {
    merged,  ///< it met an older one, `parent`, which goes on
    filled,  ///< the disc nowhere fits beyond it: a pocket or hole is full
    never,
  };
  Death death = Death::never;
  std::uint32_t birth = 0;         ///< junction
  std::uint32_t end = kNoIndex;    ///< junction where it dies; kNoIndex: never
  std::uint32_t last = kNoIndex;   ///< the edge that it dies on, or leaves on
  std::uint32_t first = kNoIndex;  ///< the edge that it is born on
  std::uint32_t parent = kNoIndex;
  std::uint32_t minimum = kNoIndex;  ///< what `deepest` told of its last edge, or where that belongs to a younger bar,
  double concavity = 0;              ///< of the edge on which it met that
};

/// A loop vertex, or kNoIndex where a bridge has no pocket.
struct PocketMinimumAt {
  std::uint32_t vertex = kNoIndex;
  double concavity = 0;
};

/// What tracks ask about the bridges at the upper ends of edges.
struct PocketOracle {
  std::function<PocketMinimumAt(std::uint32_t edge)> deepest;
  std::function<bool(std::uint32_t edge, std::uint32_t vertex)> holds;  ///< whether the pocket has the vertex inside
  /// What its discs touch, by ranks that tell nothing of indices.
  std::function<std::array<std::uint32_t, 4>(std::uint32_t edge)> contacts;
};

struct Tracks {
  std::vector<Junction> junctions;
  std::vector<Bar> bars;
  std::vector<std::uint32_t> bar_of;  ///< edge -> bar; kNoIndex for flat edges
};

/// Elder rule: where tracks meet, the one that was born first goes on. Of equally old ones it is the one whose pocket
/// holds the pocket minimum of the bar where the bar dies, hence the deeper one as seen from there; where none holds
/// it, the one with the larger concavity, then the one whose edge begins at the smaller radius, then the one of the
/// lesser contacts. Bars are ordered by their births, then the contacts of their first edges. Indices decide last of
/// all. O(edges) and one question per bar. Throws std::logic_error where a track would split, which no complex has.
Tracks tracks_of(const Complex& complex, const PocketOracle& pockets);

}  // namespace dymsum::shape
