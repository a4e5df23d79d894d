#include "cspace/events/exact_position.h"

#include <algorithm>
#include <cmath>

#include "cspace/events/walked_rings.h"
#include "exact/rounding_bound.h"
#include "planar/motion/turning_forms.h"

namespace dymsum::planar {

using exact::Polynomial;

namespace {

// The least sine for crossings in doubles: they err by what the side and the cross product do and the angle moves them
// by, over it.
constexpr double kLeastSine = 0x1p-4;
static_assert((kTurnedSide + kTurnedCross + 4 * 0x1p-49) / kLeastSine + kTurnedPosition + 0x1p-49 <=
              SignsAt::kCrossingNear);
// The error of the cross or scalar product of two edges at the heading is this times their lengths: the form
// (kTurnedCross, and as much for two directions), and what an angle within 2^-49 turns it by.
constexpr double kProduct = exact::rounding_bound(56 + 2 * 16, 8192);

Polynomial one() { return Polynomial({exact::Big(exact::BigInteger(1))}); }

Fraction half_of_sum(const Fraction& x, const Fraction& y) {
  const Polynomial den = product(x.den, y.den);
  return {sum_of(product(x.num, y.den), product(y.num, x.den), 1), sum_of(den, den, 1)};
}

// The heading of t within 2^-60.
Heading heading_of(exact::RootBracket& bracket, int chart) {
  bracket.refine_to(60);
  const double t = exact::double_bounds(bracket.low().value()).first, sign = chart == 0 ? 1 : -1;
  return {sign * (1 - t * t) / (1 + t * t), sign * 2 * t / (1 + t * t)};
}

/// p at a dyadic number x of [-1, 1], and a bound on what its values within 2^-bits of x differ from that by.
struct ValueNear {
  exact::BigInteger value, error;  ///< times 2^(kMaxDegree shift of x)
  ValueNear(const Polynomial& p, const exact::DyadicNumber& x, unsigned bits) {
    const int degree = std::max(p.degree(), 0);
    value = p.value_at_dyadic(x.numerator, x.shift)
            << (static_cast<unsigned>(Polynomial::kMaxDegree - degree) * x.shift);
    for (int k = 1; k <= degree; ++k) error += abs(p[k].value()) * k;
    error <<= Polynomial::kMaxDegree * x.shift;
    error >>= bits;
    error += 1;
  }
};

}  // namespace

Polynomial product(const Polynomial& p, const Polynomial& q) {
  if (p.is_zero() || q.is_zero()) return {};
  std::vector<exact::Big> c(static_cast<std::size_t>(p.degree() + q.degree()) + 1);
  for (int i = 0; i <= p.degree(); ++i)
    for (int j = 0; j <= q.degree(); ++j) {
      exact::Big& to = c[static_cast<std::size_t>(i + j)];
      to = to + exact::Big(exact::BigInteger(p[i].value() * q[j].value()));
    }
  return Polynomial(std::move(c));
}

Polynomial sum_of(const Polynomial& p, const Polynomial& q, int sign) {
  std::vector<exact::Big> c(static_cast<std::size_t>(std::max({p.degree(), q.degree(), 0})) + 1);
  for (int i = 0; i < static_cast<int>(c.size()); ++i)
    c[static_cast<std::size_t>(i)] = p[i] + exact::Big(exact::BigInteger(sign * q[i].value()));
  return Polynomial(std::move(c));
}

SignsAt::SignsAt(const TurningForms& forms, const ExactAngle& angle)
    : forms_(forms), angle_(angle), bracket_(angle.t.bracket()), heading_(heading_of(bracket_, angle.chart)) {}

int SignsAt::compare(const Fraction& x, const Fraction& y) const {
  return sign(sum_of(product(x.num, y.den), product(y.num, x.den), -1)) * sign(x.den) * sign(y.den);
}

// It ends, as the denominator is not 0.
double SignsAt::quotient(const Polynomial& num, const Polynomial& den) const {
  for (unsigned bits = 128;; bits *= 2) {
    bracket_.refine_to(bits);
    const ValueNear n(num, bracket_.low(), bits), d(den, bracket_.low(), bits);
    const exact::BigInteger size = abs(d.value);
    if (!bracket_.is_point() && ((n.error << 52) > size || (d.error << 52) > size)) continue;
    return exact::round_to_double(exact::ratio(exact::Big(n.value), exact::Big(d.value)));
  }
}

// Rounding lets a crossing in doubles err along the first segment by less than 2^-45 of the span over the sine
// (side_error, over the lengths), and by 2^-49 (1 + 4 / sine) by the angle.
std::optional<Point> SignsAt::near(const ExactPosition::Simple& z) const {
  if (!z.crossing) return forms_.position(z.corner, heading_);
  const Pair start = TurningForms::start(z.a);
  const double cross = forms_.cross(z.a, z.b).at(heading_);
  const bool clear = std::abs(cross) >= kLeastSine * forms_.length1(z.a) * forms_.length1(z.b);
  const double t =
      clear ? forms_.side(z.b, start).at(heading_) / cross
            : quotient(forms_.exact_side(z.b, start, angle_.chart), forms_.exact_cross(z.a, z.b, angle_.chart));
  // The t of a short segment may err by more than it is long.
  const double slack = kNear * forms_.span() / forms_.length1(z.a);
  if (!(t > -slack && t < 1 + slack)) return std::nullopt;
  const Point from = forms_.position(start, heading_), d = forms_.direction(z.a, heading_);
  return Point{from.x + t * d.x, from.y + t * d.y};
}

std::optional<Point> SignsAt::near(const ExactPosition& z) const {
  const std::optional<Point> first = near(z.first);
  if (!z.second || !first) return first;
  const std::optional<Point> second = near(*z.second);
  if (!second) return second;
  return Point{(first->x + second->x) / 2, (first->y + second->y) / 2};
}

// A crossing is start_a + (side(b, start_a) / (a x b)) d_a.
Fraction SignsAt::side(const WalkSegment& s, const ExactPosition::Simple& z) const {
  const int chart = angle_.chart;
  if (!z.crossing) return {forms_.exact_side(s, z.corner, chart), one()};
  const Pair from = TurningForms::start(z.a);
  const Polynomial ab = forms_.exact_cross(z.a, z.b, chart), fraction = forms_.exact_side(z.b, from, chart);
  return {
      sum_of(product(forms_.exact_side(s, from, chart), ab), product(fraction, forms_.exact_cross(s, z.a, chart)), 1),
      ab};
}

Fraction SignsAt::along(const WalkSegment& s, const ExactPosition::Simple& z) const {
  const int chart = angle_.chart;
  const Pair start = TurningForms::start(s);
  if (!z.crossing) return {forms_.exact_along(s, start, z.corner, chart), one()};
  const Pair from = TurningForms::start(z.a);
  const Polynomial ab = forms_.exact_cross(z.a, z.b, chart), fraction = forms_.exact_side(z.b, from, chart);
  const Polynomial dot = forms_.exact_along(s, from, forms_.end(z.a), chart);
  return {sum_of(product(forms_.exact_along(s, start, from, chart), ab), product(fraction, dot), 1), ab};
}

Fraction SignsAt::side(const WalkSegment& s, const ExactPosition& z) const {
  return z.second ? half_of_sum(side(s, z.first), side(s, *z.second)) : side(s, z.first);
}

Fraction SignsAt::along(const WalkSegment& s, const ExactPosition& z) const {
  return z.second ? half_of_sum(along(s, z.first), along(s, *z.second)) : along(s, z.first);
}

Fraction SignsAt::length(const WalkSegment& s) const {
  return {forms_.exact_along(s, TurningForms::start(s), forms_.end(s), angle_.chart), one()};
}

int SignsAt::side_sign(const WalkSegment& s, const ExactPosition& z, Point near) const {
  const Point from = forms_.position(TurningForms::start(s), heading_), d = forms_.direction(s, heading_);
  const double value = d.x * (near.y - from.y) - d.y * (near.x - from.x);
  if (std::abs(value) > kNear * forms_.length1(s) * forms_.span()) return value > 0 ? 1 : -1;
  return sign(side(s, z));
}

bool SignsAt::within(const WalkSegment& s, const ExactPosition& z, Point near) const {
  const Point e = forms_.edge(s.side, s.edge);
  const double value = along_near(s, near), end = e.x * e.x + e.y * e.y,
               error = 2 * kNear * forms_.length1(s) * forms_.span();
  if (value < -error || value > end + error) return false;
  if (value > error && value < end - error) return true;
  const Fraction at = along(s, z);
  return sign(at) >= 0 && compare(at, length(s)) <= 0;
}

int SignsAt::order(const WalkSegment& s, const ExactPosition& y, Point y_near, const ExactPosition& z,
                   Point z_near) const {
  const double d = along_near(s, y_near) - along_near(s, z_near);
  if (std::abs(d) > 2 * kNear * forms_.length1(s) * forms_.span()) return d > 0 ? 1 : -1;
  return compare(along(s, y), along(s, z));
}

bool SignsAt::same(const ExactPosition::Simple& y, const ExactPosition& z) const {
  if (y.crossing) return sign(side(y.a, z)) == 0 && sign(side(y.b, z)) == 0;
  // An edge that starts there; a single point has none.
  const WalkSegment s =
      forms_.is_point(0, y.corner.p) ? WalkSegment{1, y.corner.q, y.corner.p} : WalkSegment{0, y.corner.p, y.corner.q};
  return sign(side(s, z)) == 0 && sign(along(s, z)) == 0;
}

// Whether y and z are the same. Requires that y is no midpoint.
bool SignsAt::same(const ExactPosition& y, const ExactPosition& z) const { return same(y.first, z); }

int SignsAt::cross(const WalkSegment& d, const WalkSegment& e) const {
  const double value = forms_.cross(d, e).at(heading_);
  if (std::abs(value) > kProduct * forms_.length1(d) * forms_.length1(e)) return value > 0 ? 1 : -1;
  return sign(forms_.exact_cross(d, e, angle_.chart));
}

int SignsAt::dot(const WalkSegment& d, const WalkSegment& e) const {
  const Point u = forms_.direction(d, heading_), v = forms_.direction(e, heading_);
  const double value = u.x * v.x + u.y * v.y;
  if (std::abs(value) > kProduct * forms_.length1(d) * forms_.length1(e)) return value > 0 ? 1 : -1;
  return sign(forms_.exact_along(d, TurningForms::start(e), forms_.end(e), angle_.chart));
}

Located position_on(const TurningForms& forms, const WalkSegment& s, const WalkSegment& other, bool at_start, Heading h,
                    double turn) {
  if (at_start ? meet_at_ends(forms, other, s) : meet_at_ends(forms, s, other)) return {at_start ? 0.0 : 1.0, 0};
  const TrigForm side = forms.side(other, TurningForms::start(s)), cross = forms.cross(s, other);
  const double d = cross.at(h), t = side.at(h) / d;
  // The numerator and the denominator err by their bounds, and change by their swings: of lines that may be parallel
  // doubles know nothing. Other roundings are less than what the bounds grant beyond what they count.
  const double n_error = forms.side_error(other) + turn * side.swing(),
               d_error = kTurnedCross * forms.length1(s) * forms.length1(other) + turn * cross.swing(),
               size = std::abs(d) - d_error;
  return {t, size > 0 ? (n_error + std::abs(t) * d_error) / size : INFINITY};
}

// The start of its segment and a fraction of its vector, which is a crossing's side / cross. Where the crossing line
// runs along this one at the angle, both are zero and their derivatives tell the limit.
std::optional<Fraction> end_along(const SignsAt& signs, const WalkSegment& s, const SubEdge& e, bool at_end) {
  const TurningForms& forms = signs.forms();
  const int chart = signs.chart();
  const WalkSegment &t = e.segment, &by = at_end ? e.right : e.left;
  const Pair start = TurningForms::start(t), end = forms.end(t);
  const Polynomial one(std::vector<exact::Big>{exact::Big(exact::BigInteger(1))});
  if (at_end && meet_at_ends(forms, t, by))
    return Fraction{forms.exact_along(s, TurningForms::start(s), end, chart), one};
  const Polynomial base = forms.exact_along(s, TurningForms::start(s), start, chart);
  if (!at_end && meet_at_ends(forms, by, t)) return Fraction{base, one};
  Polynomial side = forms.exact_side(by, start, chart), cross = forms.exact_cross(t, by, chart);
  if (signs.sign(cross) == 0) {
    if (signs.sign(side) != 0) return std::nullopt;
    side = side.derivative();
    cross = cross.derivative();
    if (signs.sign(cross) == 0) return std::nullopt;
  }
  return Fraction{sum_of(product(base, cross), product(side, forms.exact_along(s, start, end, chart)), 1), cross};
}

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
