#include "cspace/events/event_signs.h"

namespace dymsum::planar {

using Existence = RotationCatalog::Existence;

// The edge's direction lies strictly between those of the edges at a convex vertex exactly if it is on the left of the
// first one and the second one is on its left: the cone is at most a half turn.
std::array<int, 2> existence_signs(const SignsAt& signs, const WalkSegment& s) {
  const std::uint32_t op = 1 - s.side, before = signs.forms().operand(op).prev[s.vertex];
  return {signs.cross({op, before, 0}, s), signs.cross(s, {op, s.vertex, 0})};
}

bool exists_at(const SignsAt& signs, const RotationCatalog& catalog, const WalkSegment& s) {
  if (!catalog.may_exist(s)) return false;
  if (signs.forms().is_point(1 - s.side, s.vertex)) return true;
  const auto [from, to] = existence_signs(signs, s);
  return from >= 0 && to >= 0;
}

// Doubles decide with a margin for what they and the event's angle err by, exact signs decide the rest.
Existence EventSigns::exists(const WalkSegment& s) const {
  if (!catalog_.may_exist(s)) return Existence::no;
  const std::uint32_t op = 1 - s.side;
  const RotationCatalog::Span span = catalog_.span(s, event_.theta());
  const double slack = kAngleSlack + (event_.high - event_.low);
  if (span.from > slack || span.to < -slack) return Existence::no;
  if (forms_.is_point(op, s.vertex) || (span.from < -slack && span.to > slack)) return Existence::yes;
  const auto [from, to] = existence_signs(exact(), s);
  if (from < 0 || to < 0) return Existence::no;
  return from > 0 && to > 0 ? Existence::yes : Existence::unsure;
}

RotationCatalog::Joint EventSigns::joint(Pair v) const {
  RotationCatalog::Joint joint;
  const auto set = [&](const WalkSegment& s, bool& has, WalkSegment& to) {
    const Existence e = exists(s);
    if (e == Existence::no) return;
    joint.unsure |= e == Existence::unsure || has;
    has = true;
    to = s;
  };
  for (std::uint32_t side = 0; side < 2; ++side) {
    const std::uint32_t own = side == 0 ? v.p : v.q, other = side == 0 ? v.q : v.p;
    set({side, forms_.operand(side).prev[own], other}, joint.has_in, joint.in);
    set({side, own, other}, joint.has_out, joint.out);
  }
  return joint;
}

// The first derivative that is not zero decides: what polynomials are multiplied by to be integers is positive.
int EventSigns::after(const exact::Polynomial& p) const {
  int sign = 0;
  for (exact::Polynomial d = p.derivative(); sign == 0 && !d.is_zero(); d = d.derivative()) sign = exact().sign(d);
  return sign;
}

}  // namespace dymsum::planar
