// What a single event changes, read off the few segments that meet there, and planned as an edit: in doubles, and in
// exact signs at the event's angle where doubles are unsure. Where more coincides the plan says so: it is never a
// guess.
#pragma once

#include <optional>
#include <vector>

#include "cspace/boundary/boundary_graph.h"
#include "cspace/events/crossing_orders.h"
#include "cspace/events/exact_position.h"
#include "cspace/events/rotation_events.h"
#include "exact/rounding_bound.h"
#include "planar/motion/turning_forms.h"

namespace dymsum::planar {

// What the stages at one angle of the sweep read: the pair, the boundary before the angle, and the angle itself.

struct SweepScene {
  const TurningForms& forms;
  const RotationCatalog& catalog;
  const BoundaryGraph& graph;
};

/// An angle in doubles, and exactly once its signs are requested.
class AngleNow {
 public:
  explicit AngleNow(const TurningForms& forms) : forms_(forms) {}
  /// `crowded`: null unless it is a crowded quarter turn.
  void begin(double theta, const QuarterTurn* crowded) {
    theta_ = theta;
    crowded_ = crowded;
    exact_.reset();
    signs_.reset();
  }
  void set_exact(ExactAngle angle, double theta) {
    theta_ = theta;
    exact_ = std::move(angle);
  }
  double theta() const { return theta_; }
  Heading heading() const { return Heading::of(theta_); }
  const QuarterTurn* crowded() const { return crowded_; }
  /// Requires set_exact().
  const SignsAt& signs() const {
    if (!signs_) signs_.emplace(forms_, exact_.value());
    return *signs_;
  }

 private:
  const TurningForms& forms_;
  double theta_ = 0;
  const QuarterTurn* crowded_ = nullptr;
  std::optional<ExactAngle> exact_;
  mutable std::optional<SignsAt> signs_;
};

/// The error of a position on a segment beside the fraction's, in each coordinate, is this times the span: a position
/// (16), a direction (19), product and sum.
inline constexpr double kPositionError = exact::rounding_bound(16 + 19 + 2, 128);
/// The same at an angle that errs by `turn`: nothing turns about a centre farther than half a span.
constexpr double position_error(double turn) { return kPositionError + turn; }

/// The angles of planned events err by at most this much: wider ones are narrowed first.
inline constexpr double kPlannedTurn = 0x1p-39;
/// Directions that are nearer to parallel, relatively, have no sign that holds at the event's angle too: a cross
/// product changes by less than 2 for every radian.
inline constexpr double kParallel = 0x1p-32;
static_assert(kTurnedCross + 2 * kPlannedTurn < kParallel);
/// The same for slopes, in errors of the form: those of sides change by less than 2, those of three lines by less than
/// 6 (4 + 2) for every radian, as their coefficients add up to 2 and 6.
inline constexpr double kSlopes = 4096;
static_assert(kTurnedSide + 2 * kPlannedTurn < kSlopes * kTurnedSide);
static_assert(4 * kConcurrency + 6 * 6 * kPlannedTurn < kSlopes * kConcurrency);

/// What the double of an event's angle errs by.
inline double turn_of(const RotationEvent& event) { return (event.high - event.low) / 2 * exact::kOutwards; }

struct EventPlan {
  enum class Verdict : std::uint8_t {
    nothing,   ///< nothing changes
    unsure,    ///< more coincides
    doubtful,  ///< nothing changes after the event, but the position may be free at its angle
    change,    ///< the edit, less its births that are not free
  };
  Verdict verdict = Verdict::nothing;
  ObstacleEvent::Kind kind = ObstacleEvent::Kind::alignment;
  Point at;  ///< in the forms' doubles
  BoundaryEdit edit;
};

/// Where an edge of the robot passes the direction of one of the obstacle, the boundary along their common line changes
/// hands: before, edge e from vertex q_j and then edge f from p_(i+1); after, f from p_i and then e from q_(j+1).
EventPlan plan_alignment(RotationEvent& event, const RotationRange& range, const SweepScene& scene);

/// Where two segments with one direction pass over each other: along the interval that they share the boundary changes
/// from one to the other, and at the ends of that interval it turns into the next or the previous segment of a chain.
EventPlan plan_overlap(RotationEvent& event, const RotationRange& range, const SweepScene& scene);

/// Three segments, or a vertex and a segment, that meet where nothing else does: a small arrangement after the event,
/// and paths in it from the visible sub-edges that come in to those that go out.
EventPlan plan_meeting(RotationEvent& event, const RotationRange& range, const SweepScene& scene,
                       const OverlapFilter& filter);

/// That of the event's kind.
EventPlan plan_event(RotationEvent& event, const RotationRange& range, const SweepScene& scene,
                     const OverlapFilter& filter);

// Events at one angle by what they change: each changes the boundary around its own position only, so that events at
// different positions are handled one by one even if a segment takes part in several of them.

/// Events at one angle, or some of them.
using EventGroup = std::vector<RotationEvent*>;

/// Segments that take part in an event, by index, and perhaps some that only nearly do.
std::vector<std::uint32_t> segments_of(const RotationEvent& event, const SweepScene& scene);

/// Parts that share no segment, or only at positions that are apart.
std::vector<EventGroup> clusters(const EventGroup& group, const SweepScene& scene);

}  // namespace dymsum::planar
