// What happens at one angle only: configurations that are free and that no free configurations with clearance come
// near, contacts that can be held but neither reached nor left.
//
// A tight position z of the angle is not covered, so at least one segment of the convolution goes through it; one
// contact, two contacts whose lines cross, and the sum of two vertices can be left into free space. So either z is the
// position of an event at which lines cross, or an end of a segment on another one; or a segment passes through z and
// another one in the opposite direction, along an interval. What is covered changes along that interval only where a
// further segment comes in, at positions that are not covered either. Hence: the positions of events, and the intervals
// between neighbouring ones on two opposite segments, tell all, each by one exact test. Near a position that sub-edges
// before or after the angle come to there is free space with clearance; near any other free one there is none, as it
// is on the boundary of the obstacle.
#pragma once

#include <utility>
#include <vector>

#include "cspace/obstacle/event_clusters.h"
#include "cspace/obstacle/slice_reader.h"
#include "cspace/obstacle/tight_positions.h"

namespace dymsum::planar {

/// Threes that stay at one point in tight positions, before and after the angle; both sorted.
struct TightCurves {
  std::vector<AlwaysConcurrent> before, after;
};

struct TightFindings {
  std::vector<std::pair<TightCandidate, TightCandidate>> held;  ///< the ends of tight intervals, or one point twice
  std::vector<Point> events;                                    ///< where something tight begins, ends or is alone
  bool looked = false;                                          ///< there was a position to look at
};

/// Finds what is tight at the positions of `doubtful` events. Requires the graph after the angle.
TightFindings tight_at_events(const EventGroup& doubtful, const TightCurves& curves, const SweepScene& scene,
                              const AngleNow& now, const OverlapFilter& filter);
/// After a whole slice, one more slice, at the angle itself where that is rational, decides instead what is tight in
/// it.
TightFindings tight_in_slice(const Orientation& at, const TightCurves& curves, const SweepScene& scene,
                             const AngleNow& now, const SliceReader& reader);

}  // namespace dymsum::planar
