// What a single event changes, read off the few segments that meet there in doubles, and planned as an edit. Where
// doubles are unsure about any sign the plan says so: it is never a guess.
#pragma once

#include "cspace/events/event_place.h"
#include "cspace/obstacle/sweep_scene.h"

namespace dymsum::planar {

struct EventPlan {
  enum class Verdict : std::uint8_t {
    nothing,   ///< nothing changes
    unsure,    ///< doubles do not tell, or more coincides
    doubtful,  ///< nothing changes behind the event, but the place may be free at its angle
    change,    ///< the edit, less its births that are not free
  };
  Verdict verdict = Verdict::nothing;
  ObstacleEvent::Kind kind = ObstacleEvent::Kind::alignment;
  Point at;  ///< in the forms' doubles
  BoundaryEdit edit;
};

/// Where an edge of the robot passes the direction of one of the obstacle, the boundary along their common line changes
/// hands: before, edge e from vertex q_j and then edge f from p_(i+1); behind, f from p_i and then e from q_(j+1).
EventPlan plan_alignment(TurnEvent& event, const TurnRange& range, const SweepScene& scene);

/// Where two segments with one direction pass over each other: along the stretch that they share the boundary changes
/// from one to the other, and at the ends of that stretch it turns into the next or the previous segment of a chain.
EventPlan plan_overlap(const TurnEvent& event, const SweepScene& scene);

/// Three segments, or a vertex and a segment, that meet where nothing else does: a small arrangement behind the event,
/// and paths in it from the visible sub-edges that come in to those that go out.
EventPlan plan_meeting(const TurnEvent& event, const SweepScene& scene, const OverlapFilter& filter);

/// That of the event's kind.
EventPlan plan_event(TurnEvent& event, const TurnRange& range, const SweepScene& scene, const OverlapFilter& filter);

}  // namespace dymsum::planar
