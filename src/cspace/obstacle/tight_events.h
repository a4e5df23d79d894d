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

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "cspace/events/rotation_events.h"
#include "cspace/obstacle/event_plan.h"
#include "cspace/obstacle/slice_reader.h"

namespace dymsum::planar {

// Positions at an exact angle, and which visible sub-edges come to them.

/// A position that may be free, and segments whose lines go through it.
struct TightCandidate {
  ExactPosition position;
  Point near;  ///< in the forms' doubles
  std::vector<std::uint32_t> through;
  bool visible = false;  ///< sub-edges before or after the angle come to it
  bool goes_through(std::uint32_t segment) const {
    return std::find(through.begin(), through.end(), segment) != through.end();
  }
};

/// A sub-edge before or after the angle: where it begins and ends at the angle, as d . (x - start) of its segment, in
/// doubles.
struct NodeNow {
  std::uint32_t node = 0;
  double from = 0, to = 0, error = 0;  ///< of the difference to `along_near` of a position
};

/// Exact answers; doubles where they tell.
class PositionsAtAngle {
 public:
  PositionsAtAngle(const SweepScene& scene, const SignsAt& signs)
      : forms_(scene.forms),
        catalog_(scene.catalog),
        graph_(scene.graph),
        segments_(scene.graph.segments()),
        signs_(signs) {}

  bool same_position(const TightCandidate& y, const TightCandidate& z) const;
  std::vector<TightCandidate> each_once(std::vector<TightCandidate> all) const;
  /// Neighbouring positions, by index, along two segments of opposite directions that exist at the angle near theta: of
  /// the two sides of a polyline with one vertex mostly one does.
  std::vector<std::array<std::uint32_t, 2>> opposite_intervals(const std::vector<TightCandidate>& positions,
                                                               double theta) const;
  /// The boundary after the angle, or before and after it.
  std::vector<NodeNow> nodes_now(bool before) const;
  /// Whether a sub-edge comes to z at the angle.
  bool reaches(const NodeNow& n, const TightCandidate& z) const;
  /// Ends of a part of an interval from y to z; nothing for y and for z.
  using PartEnds = std::array<std::optional<Point>, 2>;
  /// The parts of the interval from y to z that no sub-edges come to.
  std::vector<PartEnds> not_reached(const std::vector<NodeNow>& nodes, const TightCandidate& y,
                                    const TightCandidate& z) const;
  /// The position that three concurrent segments have in common, if they do.
  std::optional<TightCandidate> meeting_of(const AlwaysConcurrent& three) const;
  std::vector<TightCandidate> positions_of(const std::vector<AlwaysConcurrent>& curves) const;

 private:
  int order_of_end(const NodeNow& n, const TightCandidate& z, bool at_end) const;
  bool on_line(const NodeNow& n, const TightCandidate& z) const;
  /// The position at which a sub-edge comes to a line, on which it is, at the angle: exact positions along that.
  std::array<Fraction, 2> limit_along(const WalkSegment& line, std::uint32_t node) const;
  Point point_on(const WalkSegment& line, const Fraction& along) const;

  const TurningForms& forms_;
  const RotationCatalog& catalog_;
  const BoundaryGraph& graph_;
  const SegmentIndex& segments_;
  const SignsAt& signs_;
};

// Placements that are tight along a curve of angles.

/// Returns those of some threes that meet in a tight position at an angle between events; sorted. Requires the boundary
/// there.
std::vector<AlwaysConcurrent> tight_curves(const SweepScene& scene, const std::vector<AlwaysConcurrent>& threes,
                                           const Orientation& at, const OverlapFilter& filter);

/// What two sorted lists have in common, and what only one of them has.
std::vector<AlwaysConcurrent> common_curves(const std::vector<AlwaysConcurrent>& before,
                                            const std::vector<AlwaysConcurrent>& after);
std::vector<AlwaysConcurrent> other_curves(const std::vector<AlwaysConcurrent>& before,
                                           const std::vector<AlwaysConcurrent>& after);

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
