#include "cspace/queries/patch_interval.h"

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

}  // namespace dymsum::cspace
