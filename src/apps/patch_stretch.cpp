#include "patch_stretch.h"

#include <limits>
#include <numbers>

namespace dymsum::apps {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kAngleError = 0x1p-50;  // of sums and differences of angles

// Angles that a patch covers, counter-clockwise, and those that it surely has.
struct Cover {
  double low = 0, high = 0, surely_low = 0, surely_high = 0;
};

// The parallel angle of an end that is near all of the cover.
const PatchEnd* near_pole(const PatchForm& form, const Cover& cover, double longest) {
  const PatchEnd* best = nullptr;
  double nearest = 2 * longest;
  for (const PatchEnd* end : {&form.left, &form.right}) {
    if (end->corner || !end->mixed) continue;
    const double middle = (cover.low + cover.high) / 2;
    const double pole = parallel_angle(*end, nearest_parallel(*end, middle));
    const double off = std::abs(std::remainder(middle - pole, 2 * kPi)) + (cover.high - cover.low) / 2;
    if (off >= nearest) continue;
    best = end;
    nearest = off;
  }
  return best;
}

class StretchMaker {
 public:
  StretchMaker(const CspaceObstacle& obstacle, const PatchForms& forms, double longest)
      : obstacle_(obstacle), forms_(forms), longest_(longest) {}

  std::vector<PatchStretch> run() {
    for (std::uint32_t p = 0; p < forms_.forms().size(); ++p) {
      const Patch& patch = obstacle_.patches()[p];
      if (patch.begin == Patch::kNone) {
        split(p, {-kPi - kAngleError, kPi + kAngleError, -kPi, kPi});
        continue;
      }
      const EventAngle &a = obstacle_.angles()[patch.begin], &b = obstacle_.angles()[patch.end];
      const double turn = patch.end <= patch.begin ? 2 * kPi : 0;
      split(p, {a.low, b.high + turn, a.high, b.low + turn});
    }
    return std::move(out_);
  }

 private:
  void split(std::uint32_t patch, const Cover& all) {
    const int parts = std::max(1, static_cast<int>(std::ceil((all.high - all.low) / longest_)));
    const double width = (all.high - all.low) / parts;
    for (int k = 0; k < parts; ++k) {
      Cover part = all;
      if (k > 0) part.low = part.surely_low = all.low + k * width;
      if (k + 1 < parts) part.high = part.surely_high = all.low + (k + 1) * width;
      add(patch, part);
    }
  }

  void add(std::uint32_t patch, const Cover& cover) {
    const PatchForm& form = forms_[patch];
    const PatchEnd* pole = near_pole(form, cover, longest_);
    const double middle = (cover.low + cover.high) / 2;
    PatchStretch s;
    s.patch = patch;
    s.reference = std::remainder(middle, 2 * kPi);
    if (pole == nullptr) {
      s.c = std::cos(s.reference);
      s.s = std::sin(s.reference);
    } else {
      place_at(form, *pole, nearest_parallel(*pole, middle), s);
    }
    // The cover, moved by whole turns next to the reference.
    const double turns = std::round((middle - s.reference) / (2 * kPi)) * (2 * kPi);
    const double from = s.reference + turns;
    s.low = cover.low - from - kAngleError;
    s.high = cover.high - from + kAngleError;
    s.surely_low = cover.surely_low - from + kAngleError;
    s.surely_high = cover.surely_high - from - kAngleError;
    for (const auto& [end, curve] : {std::pair{&form.left, &s.left}, {&form.right, &s.right}}) {
      *curve = EndCurve(*end, form.own.length, s.reference, end == pole);
      const Range possible = curve->possible(s.low, s.high);
      s.low = possible.low;
      s.high = possible.high;
    }
    s.surely_low = std::max(s.low, s.surely_low);
    s.surely_high = std::min(s.high, s.surely_high);
    out_.push_back(s);
  }

  static void place_at(const PatchForm& form, const PatchEnd& pole, int k, PatchStretch& s) {
    s.reference = std::remainder(parallel_angle(pole, k), 2 * kPi);
    const Point u = form.own.unit, m = pole.other.unit;
    const double sign = (form.own.turns ? 1 : -1) * (k == 0 ? 1 : -1);
    s.c = (k == 0 ? 1 : -1) * dot(u, m);
    s.s = sign * cross(u, m);
  }

  const CspaceObstacle& obstacle_;
  const PatchForms& forms_;
  double longest_;
  std::vector<PatchStretch> out_;
};

}  // namespace

std::vector<PatchStretch> make_stretches(const CspaceObstacle& obstacle, const PatchForms& forms, double longest) {
  return StretchMaker(obstacle, forms, longest).run();
}

StretchBox box_of(const PatchForms& forms, const PatchStretch& stretch) {
  const ContactLine& own = forms[stretch.patch].own;
  const double middle = (stretch.low + stretch.high) / 2, half = (stretch.high - stretch.low) / 2;
  const SmallTurn x(middle);
  const double c = stretch.c * x.c - stretch.s * x.s, s = stretch.s * x.c + stretch.c * x.s;
  const auto turned = [&](Point v) { return Point{c * v.x - s * v.y, s * v.x + c * v.y}; };
  const Point u = own.turns ? turned(own.unit) : own.unit, n = quarter(u), a = own.start.a;
  const PointRange arm = turning(turned(own.start.b), half);
  const PointRange line = own.turns ? turning(u, half) : PointRange{{u.x, u.x}, {u.y, u.y}};
  const Range left = stretch.left.range(stretch.low, stretch.high);
  const Range right = stretch.right.range(stretch.low, stretch.high);
  const Range at{std::min(left.low, right.low), std::max(left.high, right.high)};
  const Range b_along = u.x * arm.x + u.y * arm.y, b_off = n.x * arm.x + n.y * arm.y;
  const Range along = u.x * line.x + u.y * line.y, off = n.x * line.x + n.y * line.y;
  const double margin = 0x1p-40 * forms.size();
  const Range wider{-margin, margin};
  const double from = stretch.reference - 4 * kAngleError, to = stretch.reference + 4 * kAngleError;
  const PointRange box{join(left * line.x, right * line.x), join(left * line.y, right * line.y)};
  return {{a.x + arm.x + box.x + wider, a.y + arm.y + box.y + wider}, u, dot(a, u) + b_along + at * along + wider, dot(a, n) + b_off + at * off + wider,
          {from + stretch.low, to + stretch.high}};
}

}  // namespace dymsum::apps
