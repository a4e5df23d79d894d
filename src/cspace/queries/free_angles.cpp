#include "cspace/queries/free_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dymsum::cspace {
namespace {

// The error of c + a cos(theta) + b sin(theta) is this times |edge|_1 and the sizes: a difference of positions (3) or a
// corner, an edge (1), product and sum, for the constant and for the wave, sqrt(2) of which count.
constexpr double kLine = exact::rounding_bound(3 * (3 + 1 + 2), 32);
// The wave has to exceed what is known of it by this factor, so that the angle errs by at most 4 errors / amplitude.
constexpr double kKnown = 64;
// The errors of an arc cosine and of its sums with the phase, 4 each; then those of the sums with whole turns, of less
// than 16 each, together with the other ones.
constexpr double kPassageAngle = exact::rounding_bound(4 + 4 + 4, 32), kTurned = exact::rounding_bound(4, 8);
static_assert(exact::gamma(12 + 8 + 8 + 4) < kPassageAngle + kTurned);
// The error of distances is these times the sizes: a dozen roundings, and for a tight placement besides its own error.
constexpr double kCircle = exact::rounding_bound(16, 8192), kTight = exact::rounding_bound(16, 512);
// Passages that begin so near to each other may be one: any width is right, as such a one is looked at exactly.
constexpr double kOneBegin = 0x1p-46;

class Finder {
 public:
  Finder(const CspaceObstacle& obstacle, const PatchForms& forms, Point at)
      : obstacle_(obstacle), forms_(forms), at_(forms.relative(at)) {
    for (std::uint32_t p = 0; p < forms.forms().size(); ++p) {
      const PatchForm& form = forms[p];
      if (outside(form)) continue;
      pieces_.clear();
      PatchForms::split(obstacle, p, 4 * std::numbers::pi, pieces_);
      add(form.own, p);
    }
    for (const TightFeature& f : obstacle.tight()) add_tight(f, at);
  }

  Passages run() {
    std::sort(found_.begin(), found_.end(),
              [](const Passage& a, const Passage& b) { return a.low != b.low ? a.low < b.low : a.patch < b.patch; });
    return merged();
  }

 private:
  // No angle brings the whole edge to the position: its circle about the contact's fixed point misses that.
  bool outside(const PatchForm& form) const {
    const ContactLine& l = form.own;
    const double margin = kCircle * forms_.size();
    if (!l.turns) return false;
    const Point far = l.start.b + l.along, gap = at_ - l.start.a;
    return std::hypot(gap.x, gap.y) > std::max(std::hypot(far.x, far.y), std::hypot(l.start.b.x, l.start.b.y)) + margin;
  }

  // The position is on the line where c + a cos(theta) + b sin(theta) = 0.
  void add(const ContactLine& l, std::uint32_t patch) {
    const Point gap = at_ - l.start.a, d = l.along, r = l.start.b;
    const Point wave = l.turns ? Point{cross(d, gap), -dot(d, gap)} : Point{-cross(d, r), -dot(d, r)};
    const double constant = l.turns ? -cross(d, r) : cross(d, gap);
    const double amplitude = std::hypot(wave.x, wave.y);
    const double size = forms_.size() + std::abs(at_.x) + std::abs(at_.y);
    const double error = kLine * (std::abs(d.x) + std::abs(d.y)) * size;
    if (std::abs(constant) > amplitude + error) return;
    if (!(amplitude > kKnown * error)) return add_persistent(amplitude == 0, patch);
    const double value = -constant / amplitude, off = 4 * error / amplitude;
    const double phase = std::atan2(wave.y, wave.x);
    const double near = std::acos(std::clamp(value + off, -1.0, 1.0)) - kPassageAngle;
    const double far = std::acos(std::clamp(value - off, -1.0, 1.0)) + kPassageAngle;
    if (value + off >= 1) return add_turned(phase - far - off, phase + far + off, patch, false);
    if (value - off <= -1)
      return add_turned(phase + near - off, phase + 2 * std::numbers::pi - near + off, patch, false);
    add_turned(phase - far - off, phase - near + off, patch, true);
    add_turned(phase + near - off, phase + far + off, patch, true);
  }

  // The position is on the line all the time, or nearly. Where it does not move against the line at all, it stays free
  // or forbidden until the patch ends, however near they are.
  void add_persistent(bool at_rest, std::uint32_t patch) {
    const double margin = forms_.angle_margin();
    for (const PatchPiece& piece : pieces_) {
      if (!at_rest) {
        add_here(piece.low - margin, piece.high + margin, patch, false);
        continue;
      }
      for (const double end : {piece.low, piece.high}) add_here(end - margin, end + margin, patch, false);
    }
  }

  void add_turned(double low, double high, std::uint32_t patch, bool crosses) {
    const double margin = forms_.angle_margin();
    for (const double turn : {-2 * std::numbers::pi, 0.0, 2 * std::numbers::pi})
      for (const PatchPiece& piece : pieces_)
        if (high + turn >= piece.low - margin && low + turn <= piece.high + margin)
          add_here(low + turn - kTurned, high + turn + kTurned, patch, crosses);
  }

  // Unless an end of the patch is far from the position then.
  void add_here(double low, double high, std::uint32_t patch, bool crosses) {
    const PatchForm& form = forms_[patch];
    const double half = (high - low) / 2;
    if (half < 0.5) {
      const PointRange box = forms_.box(form, (low + high) / 2, half);
      if (at_.x < box.x.low || at_.x > box.x.high || at_.y < box.y.low || at_.y > box.y.high) return;
    }
    push(low, high, patch, crosses);
  }

  // Coordinates are taken as they are, not from the origin: the error of a position covers their differences.
  void add_tight(const TightFeature& f, Point at) {
    const Point d = forms_.in_units(f.to - f.from), gap = forms_.in_units(at - f.from), position = forms_.in_units(at);
    const double length2 = dot(d, d), fraction = length2 > 0 ? std::clamp(dot(gap, d) / length2, 0.0, 1.0) : 0;
    const double off = std::hypot(gap.x - fraction * d.x, gap.y - fraction * d.y);
    const double margin = kTight * (std::abs(position.x) + std::abs(position.y) + forms_.size());
    if (off > 2 * forms_.in_units(f.error) + margin) return;
    const EventAngle& angle = obstacle_.angles()[f.angle];
    push(angle.low - kPassageAngle, angle.high + kPassageAngle, Patch::kNone, false);
  }

  void push(double low, double high, std::uint32_t patch, bool crosses) {
    const double turns = low < -std::numbers::pi   ? 2 * std::numbers::pi
                         : low >= std::numbers::pi ? -2 * std::numbers::pi
                                                   : 0;
    found_.push_back({low + turns, high + turns, patch, crosses});
  }

  // Passages that overlap become one, those of the same patch at its ends in (-pi, pi] too.
  Passages merged() const {
    Passages out;
    for (const Passage& p : found_)
      if (!out.all.empty() && p.low <= out.all.back().high + kPassageGap) join(out.all.back(), p, 0);
      else out.all.push_back(p);
    while (out.all.size() > 1 && out.all.front().low + 2 * std::numbers::pi <= out.all.back().high + kPassageGap) {
      join(out.all.back(), out.all.front(), 2 * std::numbers::pi);
      out.all.erase(out.all.begin());
    }
    if (!out.all.empty() && out.all.front().low + 2 * std::numbers::pi <= out.all.back().high + kPassageGap)
      out = {{}, true};
    return out;
  }
  static void join(Passage& to, const Passage& more, double turn) {
    to.crosses = to.crosses && more.crosses && to.patch == more.patch && more.low + turn <= to.low + kOneBegin;
    to.high = std::max(to.high, more.high + turn);
    if (to.patch == Patch::kNone) to.patch = more.patch;
  }

  const CspaceObstacle& obstacle_;
  const PatchForms& forms_;
  Point at_;
  std::vector<PatchPiece> pieces_;
  std::vector<Passage> found_;
};

}  // namespace

Passages passages_at(const CspaceObstacle& obstacle, const PatchForms& forms, Point at) {
  return Finder(obstacle, forms, at).run();
}

namespace {

// An angle at which something may change at the position.
struct Mark {
  double angle = 0, error = 0;
  std::uint32_t patch = Patch::kNone;
  bool free = false, free_after = false;
};

Mark mark_of(const TurnMark& m, std::uint32_t patch) {
  const EventAngle& e = m.angle;
  return {e.theta, std::max(e.theta - e.low, e.high - e.theta), patch, m.free, m.free_after};
}

double reduced(double theta) {
  return std::clamp(std::remainder(theta, 2 * std::numbers::pi), -std::numbers::pi, std::numbers::pi);
}
Orientation orientation_at(double theta) { return Orientation::nearest(theta).value(); }

class Marks {
 public:
  Marks(const CspaceObstacle& obstacle, const PatchForms& forms, Point at, const std::function<bool(double)>& is_free)
      : obstacle_(obstacle), at_(at), is_free_(is_free) {
    const Passages passages = passages_at(obstacle, forms, at);
    // Where there may be curves of tight placements, no patch determines where they pass.
    if (passages.everywhere || obstacle.may_have_tight_curves()) {
      for (const TurnMark& m : obstacle.turn_marks(at.x, at.y)) found_.push_back(mark_of(m, Patch::kNone));
    } else {
      add(passages.all);
    }
  }

  /// The marks in cyclic order; nothing changes between them.
  std::vector<Mark> run() { return std::move(found_); }

 private:
  // Between two passages nothing changes: one angle decides.
  void add(const std::vector<Passage>& all) {
    const std::size_t n = all.size();
    std::vector<double> gap(n);
    std::vector<bool> free_after(n);
    for (std::size_t k = 0; k < n; ++k) {
      gap[k] = (k + 1 < n ? all[k + 1].low : all[0].low + 2 * std::numbers::pi) - all[k].high;
      free_after[k] = is_free_(reduced(all[k].high + gap[k] / 2));
    }
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t before = (k + n - 1) % n;
      const Passage& p = all[k];
      if (p.crosses && free_after[before] != free_after[k]) {
        found_.push_back(
            {reduced((p.low + p.high) / 2), (p.high - p.low) / 2 + kMidpoint, p.patch, true, free_after[k]});
        continue;
      }
      const Orientation from = orientation_at(p.low - std::min(gap[before] / 2, kBeside));
      const Orientation to = orientation_at(p.high + std::min(gap[k] / 2, kBeside));
      for (const TurnMark& m : obstacle_.turn_marks(at_.x, at_.y, from, to)) found_.push_back(mark_of(m, p.patch));
    }
  }

  // The error of the midpoint of two angles of at most 8, reduced: a half of 8, and 4.
  static constexpr double kMidpoint = exact::rounding_bound(4 + 4, 16);
  static constexpr double kBeside = 0x1p-20;  // few other contacts come so near
  const CspaceObstacle& obstacle_;
  Point at_;
  const std::function<bool(double)>& is_free_;
  std::vector<Mark> found_;
};

// The next double of an angle of at most 4.
constexpr double kNextAngle = exact::rounding_bound(4, 8);

// Begin and end of an interval whose doubles are the same are moved apart: only single angles begin where they end.
FreeAngles between(const Mark& begin, const Mark& end, bool passes_pi) {
  FreeAngles f{begin.angle, end.angle, begin.error, end.error, begin.patch, end.patch};
  if (f.begin != f.end) return f;
  const double up = passes_pi ? 4 : -4;
  f.begin = std::nextafter(f.begin, up);
  f.end = std::nextafter(f.end, -up);
  f.begin_error += kNextAngle;
  f.end_error += kNextAngle;
  return f;
}

std::vector<FreeAngles> all_or_none(bool free) {
  if (!free) return {};
  return {{-std::numbers::pi, std::numbers::pi, 0, 0, Patch::kNone, Patch::kNone}};
}

// The marks without those at which nothing changes: what is left begins or ends an interval, or is free alone.
std::vector<Mark> changes(const std::vector<Mark>& marks) {
  std::vector<Mark> left;
  for (std::size_t k = 0; k < marks.size(); ++k) {
    const bool before = marks[(k + marks.size() - 1) % marks.size()].free_after;
    if (before != marks[k].free_after || (!before && marks[k].free)) left.push_back(marks[k]);
  }
  return left;
}

}  // namespace

std::vector<FreeAngles> free_angles(const CspaceObstacle& obstacle, const PatchForms& forms, Point at,
                                    const std::function<bool(double)>& is_free) {
  const std::vector<Mark> marks = Marks(obstacle, forms, at, is_free).run();
  if (marks.empty()) return all_or_none(is_free(0));
  const std::vector<Mark> left = changes(marks);
  if (left.empty()) return all_or_none(marks[0].free_after);
  std::vector<FreeAngles> out;
  for (std::size_t k = 0; k < left.size(); ++k) {
    const Mark &m = left[k], &next = left[(k + 1) % left.size()];
    const bool free_before = left[(k + left.size() - 1) % left.size()].free_after;
    if (m.free_after) out.push_back(between(m, next, k + 1 == left.size()));
    else if (!free_before) out.push_back({m.angle, m.angle, m.error, m.error, m.patch, m.patch});
  }
  std::stable_sort(out.begin(), out.end(), [](const FreeAngles& a, const FreeAngles& b) { return a.begin < b.begin; });
  return out;
}

}  // namespace dymsum::cspace
