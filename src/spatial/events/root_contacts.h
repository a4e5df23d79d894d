// What happens at one exact angle: which of the features that may meet there do, and whether the position is covered.
#pragma once

#include <functional>
#include <vector>

#include "spatial/events/rotation_candidates.h"
#include "spatial/moving/inner_facets.h"

namespace dymsum::spatial {

/// Balls inside both operands: what a ball of P plus one of Q holds lies in the open sum.
struct PairOfBalls {
  explicit PairOfBalls(const RotatingPair& pair);
  std::array<std::vector<InnerBalls::Ball>, 2> balls;  ///< in the pair's units
};

/// What may meet at one angle; where that is crowded, without edge_and_facets and four_facets.
struct MeetingsAt {
  std::vector<Meeting> all;
  bool crowded = false;
};

/// What meets on the sum's boundary at a root of a window, by kinds and features, each once, and 16 of them at most.
/// Exact, but of normal_on_arc: these are left out only where balls prove the face plus the edge to lie in the open
/// sum. `again` is called now and then and may throw.
std::vector<SolidRotationContact> contacts_at(const RotatingPair& pair, const PairOfBalls& balls,
                                              const RotationWindow& window, const exact::AlgebraicRoot& root,
                                              const MeetingsAt& meetings, SolidRotationWork& work,
                                              const std::function<void()>& again);

}  // namespace dymsum::spatial
