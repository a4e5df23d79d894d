// Tracks: what becomes of the reflex corners of a sum while its disc grows, and which of them go on where they meet.
// See docs/design/shape-features.md.
#pragma once

#include <cstdint>
#include <vector>

#include "shape/features/junctions.h"
#include "shape/features/since.h"

namespace dymsum::shape {

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
  TrackWorth worth;                  ///< at its death
  std::uint32_t until_neck_of = kNoIndex;
};

struct Tracks {
  std::vector<Junction> junctions;
  std::vector<Bar> bars;
  std::vector<std::uint32_t> bar_of;  ///< edge -> bar; kNoIndex for flat edges
};

/// Where tracks meet, the bar above goes on with the one whose pocket holds its minimum; where none does, with a gap if
/// there is one, else with what counts most there, then by the lesser contacts. Bars are ordered by their births, then
/// the contacts of their first edges. Indices decide last of all. What bars are worth does not depend on that: see
/// docs/design/shape-features.md. O(edges) questions. Throws std::logic_error where a track would split, which no
/// complex has.
Tracks tracks_of(const Complex& complex, const PocketOracle& pockets);

}  // namespace dymsum::shape
