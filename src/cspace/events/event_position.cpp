#include "cspace/events/event_position.h"

#include "planar/motion/turning_forms.h"

namespace dymsum::planar {

EventPosition position_of(const RotationEvent& event, const TurningForms& forms, Heading h) {
  using Kind = RotationEvent::Kind;
  if (event.kind == Kind::vertex_on_segment) return {forms.position(event.v, h)};
  if (event.kind == Kind::overlap) return {forms.position(TurningForms::start(event.a), h)};
  if (event.kind == Kind::alignment) {
    return {forms.position({forms.operand(0).next[event.f], forms.operand(1).next[event.e]}, h)};
  }
  const std::array<const WalkSegment*, 3> s{&event.a, &event.b, &event.c};
  EventPosition position{{}, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const WalkSegment &a = *s[k], &b = *s[(k + 1) % 3];
    const double cross = forms.cross(a, b).at(h), sine = std::abs(cross) / (forms.length1(a) * forms.length1(b));
    if (!(sine > position.sine)) continue;
    const double t = forms.side(b, TurningForms::start(a)).at(h) / cross;
    const Point from = forms.position(TurningForms::start(a), h), d = forms.direction(a, h);
    position = {{from.x + t * d.x, from.y + t * d.y}, sine};
  }
  return position;
}

// A crossing errs by what the side and the cross product do, over the sine.
static_assert((kTurnedSide + kTurnedCross) / kPlacedSine + kTurnedPosition < OverlapFilter::kPosition);

// The position of an event moves by at most 1 + 4 / sine spans for every radian (event_clusters.cpp), a vertex of the
// robot by less than one. What is covered by the filter's margin at one angle is covered as long as they move by less
// than that leaves.
bool provably_covered(const RotationEvent& event, const TurningForms& forms, const OverlapFilter& filter) {
  const Heading h = Heading::of(event.theta());
  const EventPosition position = position_of(event, forms, h);
  const double moves = (event.high - event.low) * (2 + 4 / position.sine);
  return position.sine >= kPlacedSine && moves <= OverlapFilter::kMoves && filter.inside(position.at, h);
}

}  // namespace dymsum::planar
