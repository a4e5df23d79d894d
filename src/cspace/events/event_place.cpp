#include "cspace/events/event_place.h"

namespace dymsum::planar {

EventPlace place_of(const TurnEvent& event, const TurningForms& forms, Heading h) {
  using Kind = TurnEvent::Kind;
  if (event.kind == Kind::vertex_on_segment) return {forms.place(event.v, h)};
  if (event.kind == Kind::overlap) return {forms.place(TurningForms::start(event.a), h)};
  if (event.kind == Kind::alignment) {
    return {forms.place({forms.operand(0).next[event.f], forms.operand(1).next[event.e]}, h)};
  }
  const std::array<const WalkSegment*, 3> s{&event.a, &event.b, &event.c};
  EventPlace place{{}, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const WalkSegment &a = *s[k], &b = *s[(k + 1) % 3];
    const double cross = forms.cross(a, b).at(h), sine = std::abs(cross) / (forms.length1(a) * forms.length1(b));
    if (!(sine > place.sine)) continue;
    const double t = forms.side(b, TurningForms::start(a)).at(h) / cross;
    const Point from = forms.place(TurningForms::start(a), h), d = forms.direction(a, h);
    place = {{from.x + t * d.x, from.y + t * d.y}, sine};
  }
  return place;
}

bool certainly_covered(const TurnEvent& event, const TurningForms& forms, const OverlapFilter& filter) {
  if (event.high - event.low > 0x1p-38) return false;
  const Heading h = Heading::of(event.theta());
  const EventPlace place = place_of(event, forms, h);
  return place.sine >= 0x1p-5 && filter.inside(place.at, h);
}

}  // namespace dymsum::planar
