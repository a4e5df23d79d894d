// Walks counter-clockwise through a range of angles, window by window: the angles at which something meets on the
// boundary, in order, and what changes there.
#pragma once

#include "spatial/events/root_contacts.h"

namespace dymsum::spatial {

/// What is made of a pair once, for all walks.
struct RotatingFacets {
  explicit RotatingFacets(RotatingPair of) : pair(std::move(of)), maps(pair), balls(pair) {}
  RotatingFacets(const RotatingFacets&) = delete;  // the maps refer to the pair
  RotatingFacets& operator=(const RotatingFacets&) = delete;

  RotatingPair pair;
  GaussMaps maps;
  PairOfBalls balls;
};

/// A path from a position of the circle to another one, both included unless `past`: then not the first one. A whole
/// turn from a position back to it where `whole`.
struct RotationPath {
  ChartPosition from, to;
  bool past = false, whole = false;
};

/// Calls take(event) for the events of a path in order, until it says false. Throws Cancelled, and
/// std::invalid_argument where sums need more than 8,192 bits.
void walk_angles(const RotatingFacets& of, const RotationPath& path, const SolidRotationOptions& options,
                 SolidRotationWork& work, const Progress& progress,
                 const std::function<bool(SolidRotationEvent&)>& take);

/// The exact sum at a position of the circle.
SpatialSum turned_sum(const RotatingPair& pair, const ChartPosition& at, const SpatialOptions& options);

}  // namespace dymsum::spatial
