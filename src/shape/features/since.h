// The diameter from which tracks count: what lets depth count besides age. See docs/design/shape-features.md.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exact/root_expression.h"
#include "shape/features/junctions.h"

namespace dymsum::shape {

/// The diameter of a node less kAgePerDepth times a depth.
struct Since {
  std::uint32_t node = 0;
  double depth = 0;
};

/// A track is at most so many times as old as its pocket is deep. The pocket of a right angle, 1 / sqrt(8) of the
/// diameter deep, counts from its birth; what is flatter than some 100 degrees, as dents of noise are, counts less.
inline constexpr int kAgePerDepth = 4;

/// Half of that diameter. Exact.
exact::RootExpression half_of(const Complex& complex, const Since& since);
/// -1, 0, 1 for a < b, a = b, a > b. Exact.
int compare(const Complex& complex, const Since& a, const Since& b);

/// What a track is worth at a node: the lesser of its depth and of the diameter there less `since`.
struct TrackWorth {
  Since since;
  std::optional<double> depth;  ///< none: a gap
};
int compare_at(const Complex& complex, std::uint32_t node, const TrackWorth& a, const TrackWorth& b);

/// Per edge, at its outer end: where its pocket is larger. Pockets enter a junction by its inlets, and leave it, as one
/// that holds them all, by its outlet: the edge that ascends, or at a full pocket the edge down to the neck, against
/// its own sense. The track that leaves counts from the least `since` of those that enter, at a neck not later than
/// from there; without any, from the junction. Where an edge ends above a pocket of depth c, it counts at least from
/// the diameter there less kAgePerDepth c. Flat edges have none. O(edges) questions.
std::vector<Since> since_of(const Complex& complex, const std::vector<Junction>& junctions,
                            const PocketOracle& pockets);

/// The edges by which pockets enter a junction, and gaps whose track goes on from it.
std::vector<std::uint32_t> inlets_of(const Junction& junction, const PocketOracle& pockets);

}  // namespace dymsum::shape
