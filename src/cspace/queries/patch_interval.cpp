#include "cspace/queries/patch_interval.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace dymsum::cspace {
namespace {
// The error of an angle from a reference: the sums of an event's angle and of the reference with whole turns (8 each,
// as they are below 16), the turn that is left of both (3), differences of what is near each other (1), and the
// reference itself where lines are parallel (8). Inputs hardly show it: angles that whole turns are added to are near
// half a turn, where those of events are known to 16 only.
constexpr double kAngleError = exact::rounding_bound(8 + 8 + 3 + 1 + 8, 32);
constexpr double kFast = 0x1p-10;  // radians from a pole, farther away a crossing takes its time
// The error of the difference of two angles by tangents of their halves in pairs of doubles: relatively the arc tangent
// (2), its argument's value and the sum with the error (1 each); absolutely what is left of pairs that cancel.
constexpr double kDifference = exact::rounding_bound(2 + 1 + 1, 8), kCancelled = 0x1p-90;
static_assert(kCancelled > 1000 * base::kPairError);
// The error of the ranges of a box is this times the size: rotated vectors (14), and a dozen of products and sums.
constexpr double kIntervalBox = exact::rounding_bound(2 * 14 + 2 * 12, 8192);

// Angles that a patch covers, counter-clockwise, and those that it provably has.
struct Cover {
  double low = 0, high = 0, proved_low = 0, proved_high = 0;
  std::uint32_t begin = Patch::kNone, end = Patch::kNone;  // the event angles at which it begins and ends
};

// An angle at which the crossing at an end would be between parallel lines.
struct Pole {
  const PatchEnd* end = nullptr;
  int k = 0;
  double angle() const { return parallel_angle(*end, k); }
};

Pole pole_of(const PatchEnd& end, double theta) {
  if (end.corner || !end.mixed) return {};
  return {&end, nearest_parallel(end, theta)};
}

// The one that is near all of the cover.
Pole near_pole(const PatchForm& form, const Cover& cover, double longest) {
  Pole best;
  double nearest = 2 * longest;
  for (const PatchEnd* end : {&form.left, &form.right}) {
    const double midpoint = (cover.low + cover.high) / 2;
    const Pole pole = pole_of(*end, midpoint);
    if (pole.end == nullptr) continue;
    const double off =
        std::abs(std::remainder(midpoint - pole.angle(), 2 * std::numbers::pi)) + (cover.high - cover.low) / 2;
    if (off >= nearest) continue;
    best = pole;
    nearest = off;
  }
  return best;
}

// tan(theta / 2) of an angle, or of the angle less half a turn.
struct HalfTangent {
  bool opposite = false;
  DoublePair t;
};

// theta - phi for angles near each other.
double difference(HalfTangent theta, const HalfTangent& phi) {
  if (theta.opposite != phi.opposite) theta.t = DoublePair{-1, 0} / theta.t;
  return 2 * std::atan(((theta.t - phi.t) / (DoublePair{1, 0} + theta.t * phi.t)).value());
}

HalfTangent half_tangent(const Pole& pole) {
  const DoublePair &t = pole.end->half_tangent[0], &opposite = pole.end->half_tangent[1];
  // Number 1 is half a turn beyond number 0: what is less by half a turn for one is the other itself.
  const bool long_one = std::abs(t.high) > 1;
  return {long_one != (pole.k == 1), long_one ? opposite : t};
}

class IntervalMaker {
 public:
  IntervalMaker(const CspaceObstacle& obstacle, const PatchForms& forms, double longest)
      : obstacle_(obstacle), forms_(forms), longest_(longest), events_(obstacle.angles().size()) {}

  std::vector<PatchInterval> run() {
    for (std::uint32_t p = 0; p < forms_.forms().size(); ++p) {
      const Patch& patch = obstacle_.patches()[p];
      if (patch.begin == Patch::kNone) {
        split(p, {-std::numbers::pi - kAngleError, std::numbers::pi + kAngleError, -std::numbers::pi, std::numbers::pi,
                  Patch::kNone, Patch::kNone});
        continue;
      }
      const EventAngle &a = obstacle_.angles()[patch.begin], &b = obstacle_.angles()[patch.end];
      const double turn = patch.end <= patch.begin ? 2 * std::numbers::pi : 0;
      split(p, {a.low, b.high + turn, a.high, b.low + turn, patch.begin, patch.end});
    }
    return std::move(out_);
  }

 private:
  void split(std::uint32_t patch, const Cover& all) {
    const int parts = std::max(1, static_cast<int>(std::ceil((all.high - all.low) / longest_)));
    const double width = (all.high - all.low) / parts;
    for (int k = 0; k < parts; ++k) {
      Cover part = all;
      if (k > 0) {
        part.low = part.proved_low = all.low + k * width;
        part.begin = Patch::kNone;
      }
      if (k + 1 < parts) {
        part.high = part.proved_high = all.low + (k + 1) * width;
        part.end = Patch::kNone;
      }
      add(patch, part);
    }
  }

  void add(std::uint32_t patch, const Cover& cover) {
    const PatchForm& form = forms_[patch];
    const Pole pole = near_pole(form, cover, longest_);
    const double midpoint = (cover.low + cover.high) / 2;
    PatchInterval s;
    s.patch = patch;
    s.reference = std::remainder(pole.end == nullptr ? midpoint : pole.angle(), 2 * std::numbers::pi);
    if (pole.end == nullptr) {
      s.c = std::cos(s.reference);
      s.s = std::sin(s.reference);
    } else {
      position_at(form, pole, s);
    }
    // The cover, moved by whole turns next to the reference.
    const double from =
        s.reference + std::round((midpoint - s.reference) / (2 * std::numbers::pi)) * (2 * std::numbers::pi);
    s.low = cover.low - from - kAngleError;
    s.high = cover.high - from + kAngleError;
    s.proved_low = cover.proved_low - from + kAngleError;
    s.proved_high = cover.proved_high - from - kAngleError;
    if (pole.end != nullptr && pole.end->fast(pole.k, form.own.length)) sharpen(cover, pole, s);
    set_ends(form, pole, s);
    out_.push_back(s);
  }

  // Event angles by how far they are from the pole.
  void sharpen(const Cover& cover, const Pole& pole, PatchInterval& s) {
    const HalfTangent at = half_tangent(pole);
    const auto beyond = [&](std::uint32_t angle) {
      std::optional<HalfTangent>& event = events_[angle];
      if (!event) {
        const CspaceObstacle::HalfTangent exact = obstacle_.half_tangent(angle);
        event = {exact.opposite, {exact.high, exact.low}};
      }
      return difference(*event, at);
    };
    const auto error = [](double x) { return kDifference * std::abs(x) + kCancelled; };
    if (cover.begin != Patch::kNone && std::abs(s.low) < kFast) {
      const double x = beyond(cover.begin);
      s.low = x - error(x);
      s.proved_low = x + error(x);
    }
    if (cover.end != Patch::kNone && std::abs(s.high) < kFast) {
      const double x = beyond(cover.end);
      s.high = x + error(x);
      s.proved_high = x - error(x);
    }
  }

  static void set_ends(const PatchForm& form, const Pole& reference, PatchInterval& s) {
    for (const auto& [end, curve] : {std::pair{&form.left, &s.left}, {&form.right, &s.right}}) {
      *curve = EndCurve(*end, form.own.length, s.reference);
      const Pole pole = pole_of(*end, s.reference);
      if (end == reference.end) *curve = EndCurve(*end, form.own.length, reference.k, 0);
      else if (reference.end != nullptr && pole.end != nullptr && reference.end->fast(reference.k, form.own.length) &&
               end->fast(pole.k, form.own.length))
        *curve = EndCurve(*end, form.own.length, pole.k, difference(half_tangent(reference), half_tangent(pole)));
      const Range possible = curve->possible(s.low, s.high);
      s.low = possible.low;
      s.high = possible.high;
    }
    s.proved_low = std::max(s.low, s.proved_low);
    s.proved_high = std::min(s.high, s.proved_high);
  }

  static void position_at(const PatchForm& form, const Pole& pole, PatchInterval& s) {
    const Point u = form.own.unit, m = pole.end->other.unit;
    const double sign = pole.k == 0 ? 1 : -1;
    s.c = sign * dot(u, m);
    s.s = (form.own.turns ? sign : -sign) * cross(u, m);
  }

  const CspaceObstacle& obstacle_;
  const PatchForms& forms_;
  double longest_;
  std::vector<std::optional<HalfTangent>> events_;
  std::vector<PatchInterval> out_;
};

}  // namespace

std::vector<PatchInterval> make_intervals(const CspaceObstacle& obstacle, const PatchForms& forms, double longest) {
  return IntervalMaker(obstacle, forms, longest).run();
}

IntervalBox box_of(const PatchForms& forms, const PatchInterval& interval) {
  const ContactLine& own = forms[interval.patch].own;
  const double midpoint = (interval.low + interval.high) / 2, half = (interval.high - interval.low) / 2;
  const SmallRotation x(midpoint);
  const double c = interval.c * x.c - interval.s * x.s, s = interval.s * x.c + interval.c * x.s;
  const auto turned = [&](Point v) { return Point{c * v.x - s * v.y, s * v.x + c * v.y}; };
  const Point u = own.turns ? turned(own.unit) : own.unit, n = quarter(u), a = own.start.a;
  const PointRange arm = turning(turned(own.start.b), half);
  const PointRange line = own.turns ? turning(u, half) : PointRange{{u.x, u.x}, {u.y, u.y}};
  const Range left = interval.left.range(interval.low, interval.high);
  const Range right = interval.right.range(interval.low, interval.high);
  const Range at{std::min(left.low, right.low), std::max(left.high, right.high)};
  const Range b_along = u.x * arm.x + u.y * arm.y, b_off = n.x * arm.x + n.y * arm.y;
  const Range along = u.x * line.x + u.y * line.y, off = n.x * line.x + n.y * line.y;
  const double margin = kIntervalBox * forms.size();
  const Range wider{-margin, margin};
  const double from = interval.reference - 4 * kAngleError, to = interval.reference + 4 * kAngleError;
  const PointRange box{join(left * line.x, right * line.x), join(left * line.y, right * line.y)};
  return {{a.x + arm.x + box.x + wider, a.y + arm.y + box.y + wider},
          u,
          dot(a, u) + b_along + at * along + wider,
          dot(a, n) + b_off + at * off + wider,
          {from + interval.low, to + interval.high}};
}

namespace {

// The error of u and v is this times the sizes of their terms: scalar and cross products with unit vectors (5 + 3
// each), turned (2 * 4), and sums. What is made of two of them errs by this times the square of all sizes: both, the
// product and sums.
constexpr double kCoordinate = exact::rounding_bound(8 + 8 + 2, 512), kSquare = exact::rounding_bound(2 * 18 + 6, 512);
// A bound so near to the value is not improved any more: any fraction is right.
constexpr double kNearEnough = 1 - 0x1p-34;

double square(double v) { return v * v; }

// The least value of value + 2 slope y + curvature y^2 for y in [low, high].
double least_of(double value, double slope, double curvature, double low, double high) {
  const auto at = [&](double y) { return value + y * (2 * slope + curvature * y); };
  if (curvature > 0) return at(std::clamp(-slope / curvature, low, high));
  return std::min(at(low), at(high));
}

}  // namespace

struct IntervalDistance::Position {
  SmallRotation t;
  double h = 0, k = 0, u = 0, v = 0, angle = 0;
};

IntervalDistance::IntervalDistance(const PatchForm& form, const PatchInterval& interval,
                                   const DistanceQuestion& question, double off)
    : interval_(interval),
      whole_(question.whole_edges),
      length_(form.own.length),
      off_(off),
      weight_(question.weight),
      weight2_(square(question.weight)) {
  const ContactLine& l = form.own;
  const Point gap = question.from - l.start.a, b = l.start.b, e = l.unit;
  // The vector that turns, and the one that does not; by the edge's direction at the angle 0.
  double p = 0, q = 0;
  if (l.turns) {
    p = dot(gap, e);
    q = cross(e, gap);
    u0_ = -dot(b, e);
    v0_ = -cross(e, b);
  } else {
    p = -dot(b, e);
    q = cross(e, b);
    u0_ = dot(gap, e);
    v0_ = cross(e, gap);
    sign_ = -1;
  }
  h_ = interval.c * p + interval.s * q;
  k_ = interval.c * q - interval.s * p;
  tolerance_ = kCoordinate * (std::abs(u0_) + std::abs(v0_) + std::abs(h_) + std::abs(k_));
}

IntervalDistance::Position IntervalDistance::at(double x) const {
  Position r{SmallRotation(x)};
  r.h = h_ * r.t.c + k_ * r.t.s;
  r.k = k_ * r.t.c - h_ * r.t.s;
  r.u = u0_ + r.h;
  r.v = v0_ + sign_ * r.k;
  r.angle = off_ + x;
  return r;
}

double IntervalDistance::end_at(const EndCurve& curve, double fixed, const SmallRotation& t) const {
  return whole_ ? fixed : curve.value(t);
}

EndCurve::Ranges IntervalDistance::end_ranges(const EndCurve& curve, double fixed, double low, double high) const {
  if (whole_) return {{fixed, fixed}, {}, {}, true, 0, 0};
  return curve.ranges(low, high);
}

IntervalDistance::Nearest IntervalDistance::nearest(double x) const {
  const Position p = at(x);
  const double left = end_at(interval_.left, 0, p.t), right = end_at(interval_.right, length_, p.t);
  Nearest n;
  n.along = p.u;
  if (p.u > right) {
    n.along = right;
    n.error = whole_ ? 0 : interval_.right.error(p.t);
  }
  if (p.u < left) {
    n.along = left;
    n.error = whole_ ? 0 : interval_.left.error(p.t);
  }
  n.distance = std::sqrt(square(p.u - n.along) + square(p.v) + weight2_ * square(p.angle));
  return n;
}

double IntervalDistance::drift(double x, double by) const {
  double speed = 0;
  for (const EndCurve* end : {&interval_.left, &interval_.right}) {
    const EndCurve::Ranges ranges = end->ranges(x - by, x + by);
    if (!ranges.known) return std::numeric_limits<double>::infinity();
    speed = std::max(speed, magnitude(ranges.first));
  }
  return by * speed;
}

// Whether the foot of the perpendicular is outside of an end, sign being that of u - end then. What is outside by less
// than the tolerance may count as inside, and the other way round.
IntervalDistance::Side IntervalDistance::side_of(const EndCurve& curve, double fixed, double sign,
                                                 const EndCurve::Ranges& end, Range u, Range speed, double low,
                                                 double high, Bound& bound) const {
  const Range over = sign * (u - end.value);
  if (over.low >= -tolerance_) return Side::outside;
  if (over.high <= tolerance_) return Side::inside;
  const Range faster = speed - end.first;
  if (!end.known || (faster.low <= 0 && faster.high >= 0)) return Side::unknown;
  const Position a = at(low), b = at(high);
  const double at_low = sign * (a.u - end_at(curve, fixed, a.t)), at_high = sign * (b.u - end_at(curve, fixed, b.t));
  if (std::min(at_low, at_high) >= -tolerance_) return Side::outside;
  if (std::max(at_low, at_high) <= tolerance_) return Side::inside;
  if (!bound.splits) bound.split = root(curve, fixed, low, high, sign * at_low, sign * at_high);
  bound.splits = true;
  return Side::splits;
}

// The parameter at which u meets the end, by false position (Illinois).
double IntervalDistance::root(const EndCurve& curve, double fixed, double low, double high, double at_low,
                              double at_high) const {
  double x = low;
  for (int k = 0; k < 12; ++k) {
    const double last = x;
    x = low + (high - low) * (at_low / (at_low - at_high));
    if (!(x > low && x < high) || x == last) break;
    const Position p = at(x);
    const double here = p.u - end_at(curve, fixed, p.t);
    if (std::abs(here) < tolerance_) break;
    if ((here > 0) == (at_low > 0)) {
      low = x;
      at_low = here;
      at_high /= 2;
    } else {
      high = x;
      at_high = here;
      at_low /= 2;
    }
  }
  return x;
}

// The square distance, half its slope and half its curvature at x.
IntervalDistance::Parabola IntervalDistance::parabola(Part part, double x) const {
  const Position p = at(x);
  Parabola r{square(p.v) + weight2_ * square(p.angle), -sign_ * p.v * p.h + weight2_ * p.angle,
             p.h * p.h - sign_ * p.k * p.v + weight2_};
  if (part == Part::line) return r;
  const EndCurve::Derivatives end = whole_ ? EndCurve::Derivatives{fixed(part), 0, 0} : curve(part).derivatives(p.t);
  const double gap = p.u - end.value, speed = p.k - end.first;
  r.value += gap * gap;
  r.slope += gap * speed;
  r.curvature += speed * speed + gap * (-p.h - end.second);
  return r;
}

// Half of it. v' = -sign h, v'' = -sign k, u' = k, u'' = -h, and h^2 + k^2 does not change: for an end that does not
// move along the edge a sine wave is left.
double IntervalDistance::least_curvature(Part part, Range h, Range k, const EndCurve::Ranges& end) const {
  const double reach = magnitude(h) + magnitude(k) + std::abs(u0_) + std::abs(v0_) + length_ + end.scale;
  const double size = square(reach) + weight2_;
  const auto falls = [&](double z) { return z * (v0_ + z); };
  const double most = std::max(falls(sign_ * k.low), falls(sign_ * k.high));
  if (part == Part::line) return least_square(h) - most + weight2_ - kSquare * size;
  if (end.first.low == 0 && end.first.high == 0) {
    const Range wave = (u0_ - end.value.low) * h + (sign_ * v0_) * k;
    return weight2_ - wave.high - kSquare * size;
  }
  const Range speed = k - end.first, gap = u0_ + (h - end.value), faster = gap * (-1.0 * h - end.second);
  const double moving = square(magnitude(speed)) + magnitude(faster);
  return least_square(speed) + faster.low + least_square(h) - most + weight2_ - kSquare * (size + moving);
}

IntervalDistance::Bound IntervalDistance::lower(double low, double high, double enough) const {
  const double midpoint = low + (high - low) / 2, half = std::max(high - midpoint, midpoint - low);
  const Position m = at(midpoint);
  const double h_off = half * (std::abs(m.k) + std::abs(m.h) * half / 2);
  const double k_off = half * (std::abs(m.h) + std::abs(m.k) * half / 2);
  const Range h{m.h - h_off, m.h + h_off}, k{m.k - k_off, m.k + k_off};
  const Range u = u0_ + h, v = v0_ + sign_ * k, angle{m.angle - half, m.angle + half};
  const EndCurve::Ranges left = end_ranges(interval_.left, 0, low, high);
  const EndCurve::Ranges right = end_ranges(interval_.right, length_, low, high);
  const double beside = std::max(std::max(0.0, left.value.low - u.high), u.low - right.value.high);
  const double simple = square(beside) + least_square(v) + weight2_ * least_square(angle);
  Bound bound{std::sqrt(simple), midpoint, false, 0};
  if (bound.distance >= enough) return bound;
  const Side at_left = side_of(interval_.left, 0, -1, left, u, k, low, high, bound);
  const Side at_right = side_of(interval_.right, length_, 1, right, u, k, low, high, bound);
  const Part part = at_left == Side::outside ? Part::left : at_right == Side::outside ? Part::right : Part::line;
  const EndCurve::Ranges& end = part == Part::right ? right : left;
  const double curvature = least_curvature(part, h, k, end);
  double x = midpoint, best = simple;
  for (int step = 0; step < 5; ++step) {
    const Parabola p = parabola(part, x);
    bound.x = x;
    best = std::max(best, least_of(p.value, p.slope, curvature, low - x, high - x));
    if (best >= p.value * kNearEnough) break;
    const double bend = std::max(p.curvature, curvature);
    const double next = bend > 0 ? std::clamp(x - p.slope / bend, low, high) : p.slope > 0 ? low : high;
    if (next == x) break;
    x = next;
  }
  const double error = std::max(left.known ? left.error : 0, right.known ? right.error : 0);
  bound.distance = std::max(bound.distance, std::sqrt(best) - error - tolerance_);
  return bound;
}

}  // namespace dymsum::cspace
