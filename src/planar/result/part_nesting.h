// What makes parts of boundary rings, and the canonical order of rings, holes, parts and features.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planar/position/exact_source.h"

namespace dymsum::planar {

// Everywhere below `at_error` bounds |at - exact position| in each coordinate, for every vertex handed in. Doubles that
// are further apart than that allows decide; the source decides the rest.

/// Groups rings into parts: each hole goes to the innermost outer ring that contains it. Requires: rings do not cross
/// (they may touch at points), is_outer has one entry per ring, every hole lies inside an outer ring; throws
/// std::logic_error otherwise. Parts come in the order of their outer rings.
/// Cost: O(rings) with one outer ring; otherwise O(h n) for h holes and n vertices of outer rings whose boxes overlap.
std::vector<SumPart> group_rings(std::vector<SumRing> rings, std::span<const std::uint8_t> is_outer,
                                 const ExactSource& source, double at_error);

/// The canonical form: every ring starts at its lexicographically smallest vertex (where it visits that several times,
/// at the visit after which the ring continues smallest), holes and parts are sorted by their vertices in ring order.
/// Cost: O(n + r log r) for n vertices of r rings; the source is queried only about vertices that doubles cannot order.
void canonicalize(std::vector<SumPart>& parts, const ExactSource& source, double at_error);

/// from < to, sorted by from, then to; equal segments once. Provenance of `from` and `to` travels with them.
void canonicalize(std::vector<SumSegment>& segments, const ExactSource& source, double at_error);

/// Sorted; equal points once.
void canonicalize(std::vector<SumVertex>& points, const ExactSource& source, double at_error);

}  // namespace dymsum::planar
