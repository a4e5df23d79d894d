#include "free_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace dymsum::apps {
namespace {

constexpr double kPi = std::numbers::pi;

// A patch may pass through the position at angles within [low, high].
struct Passage {
  double low = 0, high = 0;
  std::uint32_t patch = Patch::kNone;
};

class Passages {
 public:
  Passages(const CspaceObstacle& obstacle, const PatchForms& forms, Point at) : forms_(forms), at_(at) {
    for (std::uint32_t p = 0; p < forms.forms().size(); ++p) {
      const PatchForm& form = forms[p];
      if (outside(form)) continue;
      pieces_.clear();
      PatchForms::split(obstacle, p, 4 * kPi, pieces_);
      add(form.own, p);
    }
    std::sort(found_.begin(), found_.end(), [](const Passage& a, const Passage& b) {
      return a.low != b.low ? a.low < b.low : a.patch < b.patch;
    });
  }

  const std::vector<Passage>& found() const { return found_; }

 private:
  // No angle brings the whole edge to the position: its circle about the contact's fixed point misses that.
  bool outside(const PatchForm& form) const {
    const ContactLine& l = form.own;
    const double margin = 0x1p-40 * forms_.size();
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
    const double error = 0x1p-48 * (std::abs(d.x) + std::abs(d.y)) * size;
    if (std::abs(constant) > amplitude + error) return;
    if (!(amplitude > 0x1p6 * error)) return add_persistent(amplitude == 0, patch);
    const double value = -constant / amplitude, off = 4 * error / amplitude;
    const double phase = std::atan2(wave.y, wave.x);
    const double near = std::acos(std::clamp(value + off, -1.0, 1.0)) - 0x1p-48;
    const double far = std::acos(std::clamp(value - off, -1.0, 1.0)) + 0x1p-48;
    if (value + off >= 1) return add_turned(phase - far - off, phase + far + off, patch);
    if (value - off <= -1) return add_turned(phase + near - off, phase + 2 * kPi - near + off, patch);
    add_turned(phase - far - off, phase - near + off, patch);
    add_turned(phase + near - off, phase + far + off, patch);
  }

  // The position is on the line all the time, or nearly. Where it does not move against the line at all, it stays free
  // or forbidden until the patch ends, however near they are.
  void add_persistent(bool at_rest, std::uint32_t patch) {
    const double margin = forms_.angle_margin();
    for (const PatchPiece& piece : pieces_) {
      if (!at_rest) {
        add_here(piece.low - margin, piece.high + margin, patch);
        continue;
      }
      for (const double end : {piece.low, piece.high}) add_here(end - margin, end + margin, patch);
    }
  }

  void add_turned(double low, double high, std::uint32_t patch) {
    const double margin = forms_.angle_margin();
    for (const double turn : {-2 * kPi, 0.0, 2 * kPi})
      for (const PatchPiece& piece : pieces_)
        if (high + turn >= piece.low - margin && low + turn <= piece.high + margin)
          add_here(low + turn - 0x1p-50, high + turn + 0x1p-50, patch);
  }

  // Unless an end of the patch is far from the position then.
  void add_here(double low, double high, std::uint32_t patch) {
    const PatchForm& form = forms_[patch];
    const double half = (high - low) / 2;
    if (half < 0.5) {
      const PointRange box = forms_.box(form, (low + high) / 2, half);
      if (at_.x < box.x.low || at_.x > box.x.high || at_.y < box.y.low || at_.y > box.y.high) return;
    }
    found_.push_back({std::max(low, -kPi), std::min(high, kPi), patch});
  }

  const PatchForms& forms_;
  Point at_;
  std::vector<PatchPiece> pieces_;
  std::vector<Passage> found_;
};

// Passages that overlap become one.
std::vector<Passage> merged(const std::vector<Passage>& all) {
  std::vector<Passage> out;
  for (const Passage& p : all)
    if (!out.empty() && p.low <= out.back().high)
      out.back().high = std::max(out.back().high, p.high);
    else
      out.push_back(p);
  return out;
}

struct Change {
  Passage where;
  bool to_free = false;
};

FreeAngles between(const Change& begin, const Change& end) {
  const auto middle = [](const Passage& p) { return p.low / 2 + p.high / 2; };
  const auto error = [](const Passage& p) { return (p.high - p.low) / 2 + 0x1p-50; };
  return {middle(begin.where), middle(end.where),     error(begin.where),
          error(end.where),    begin.where.patch, end.where.patch};
}

std::vector<FreeAngles> all_or_none(bool free) {
  if (!free) return {};
  return {{-kPi, kPi, 0, 0, Patch::kNone, Patch::kNone}};
}

}  // namespace

std::vector<FreeAngles> free_angles(const CspaceObstacle& obstacle, const PatchForms& forms, Point at,
                                    const std::function<bool(double)>& is_free) {
  const std::vector<Passage> passages = merged(Passages(obstacle, forms, at).found());
  const std::size_t n = passages.size();
  if (n == 0) return all_or_none(is_free(0));
  // Between two passages nothing changes: one angle tells. The last gap goes on from the first one across pi.
  std::vector<bool> free_after(n);
  for (std::size_t k = 0; k + 1 < n; ++k) free_after[k] = is_free(passages[k].high / 2 + passages[k + 1].low / 2);
  const double ahead = kPi - passages[n - 1].high, behind = passages[0].low + kPi;
  free_after[n - 1] = is_free(ahead >= behind ? passages[n - 1].high + ahead / 2 : -kPi + behind / 2);
  std::vector<Change> changes;
  for (std::size_t k = 0; k < n; ++k)
    if (free_after[k] != free_after[(k + n - 1) % n]) changes.push_back({passages[k], free_after[k]});
  if (changes.empty()) return all_or_none(free_after[0]);
  std::vector<FreeAngles> out;
  for (std::size_t k = 0; k < changes.size(); ++k)
    if (changes[k].to_free) out.push_back(between(changes[k], changes[(k + 1) % changes.size()]));
  return out;
}

}  // namespace dymsum::apps
