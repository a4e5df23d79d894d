// Of many translates of one edge those that lie farther out cover parts of the others: the operand's interior lies
// beneath them. Lemma and proof: docs/design/planar-sum.md, "Translates of an edge".
#pragma once

#include "base/poll.h"
#include "planar/arrangement/crossings.h"

namespace dymsum::planar {

/// Parameters of a segment; none where low > high.
struct Span {
  double low = 0, high = 1;
};

/// Returns for every segment the part that other translates of its edge do not prove to lie in the open sum, with a
/// rim: where the rest ends, the open sum goes on for `reach`. Only edges with at least `fewest` translates, of
/// operands with few edges beside that, are looked at; empty where there are none. O(n log n) for n segments.
Array<Span> uncovered_spans(const Soup& soup, double reach, std::size_t fewest, const Poll& poll);

/// The part of the interior of an operand beneath an edge, on its left: at depth d in (0, depth) what lies more than
/// from_start d after the start and more than from_end d before the end, along the edge.
struct Beneath {
  double depth = 0, from_start = 0, from_end = 0;
};
/// One such part, empty where none was found. Lengths err by less than `margin`. O(edges).
Beneath beneath(const Operand& o, std::uint32_t edge, double margin);

}  // namespace dymsum::planar
