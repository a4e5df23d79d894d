#include "cspace/queries/free_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cspace/queries/angle_passages.h"

namespace dymsum::cspace {
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
