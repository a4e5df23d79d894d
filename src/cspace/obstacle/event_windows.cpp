#include "cspace/obstacle/event_windows.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {
namespace {

/// Windows of a half turn, by the count of pairs of an edge and a vertex: fewer sweep too far, more cost too much
/// each. Even, so that quarter turns are between two.
int windows_for(double pairs) { return 2 * std::clamp(static_cast<int>(std::ceil(0.4 * std::sqrt(pairs))), 8, 256); }
int cells_for(double pairs) { return std::clamp(static_cast<int>(2.25 * std::sqrt(pairs)), 24, 160); }

/// All pairs of them are looked at for every window. Less than all edges of a star leave whole sectors of the sum
/// without covered cells.
constexpr std::size_t kLongEdges = 96;

/// The reach in half tangents around an angle at which edges are nearly aligned: lines that are 2^-50 apart there, and
/// part with the square of the angle, have parted within this.
constexpr double kNearCrowd = 0x1p-22;
double nearby(double t) { return std::nearbyint(t * 0x1p30) * 0x1p-30; }

/// Twice the area by the perimeter: how wide a bar, or a comb's teeth, are.
double thickness(const TurningForms& forms, std::uint32_t op) {
  const Operand& o = forms.operand(op);
  double area2 = 0, perimeter = 0;
  for (std::uint32_t i = 0; i < o.size(); ++i) {
    const Point a = forms.points(op)[i], b = forms.points(op)[o.next[i]];
    area2 += a.x * b.y - a.y * b.x;
    perimeter += std::hypot(b.x - a.x, b.y - a.y);
  }
  return std::abs(area2) / perimeter;
}

/// Where edges crowd at quarter turns, most pairs are of segments that are covered, but for thin places only: cells
/// there are less than half as wide as the operands are thick, or hardly one would lie inside. But no more cells than
/// 16 for every pair of an edge and a vertex, or a few thin bars far apart spend their time on cells.
int cells_for_crowd(const TurningForms& forms, double pairs) {
  const double thin = std::min(thickness(forms, 0), thickness(forms, 1)), most = std::min(640.0, 4 * std::sqrt(pairs));
  const int usual = cells_for(pairs);
  return thin > 0 ? std::max(usual, static_cast<int>(std::min(most, 2.5 * forms.span() / thin))) : usual;
}

}  // namespace

EventWindows::EventWindows(const TurningForms& forms, const RotationCatalog& catalog, bool reference)
    : forms_(forms),
      catalog_(catalog),
      reference_(reference),
      pairs_(static_cast<double>(forms.size(0)) * forms.size(1)),
      per_half_turn_(windows_for(pairs_)),
      all_(alignments(forms, catalog)) {
  if (!reference) {
    crowded_.emplace(forms, all_);
    find_near_crowds();
  }
  const bool crowd = (crowded_ && crowded_->any()) || !near_.empty();
  grid_.emplace(forms, crowd ? cells_for_crowd(forms, pairs_) : cells_for(pairs_), kLongEdges);
}

// Alignments within kTogether of each other, more than there are edges. At quarter turns around these, which ranges end
// with.
void EventWindows::find_near_crowds() {
  constexpr double kTogether = 0x1p-38, kQuarter = std::numbers::pi / 2;
  const double edges = forms_.size(0) + forms_.size(1);
  double after = -INFINITY;
  for (std::size_t first = 0, last = 0; first < all_.size(); ++first) {
    last = std::max(last, first);
    while (last < all_.size() && all_[last].theta <= all_[first].theta + kTogether) ++last;
    const double per_edge = static_cast<double>(last - first) / edges;
    if (per_edge <= 1 || all_[first].theta <= after) continue;
    after = all_[first].theta + kTogether;
    double theta = (all_[first].theta + all_[last - 1].theta) / 2;
    const double quarter = std::nearbyint(theta / kQuarter);
    const bool at_quarter = std::abs(theta - quarter * kQuarter) <= kTogether;
    if (at_quarter) theta = quarter * kQuarter;
    for (const int chart : {0, 1}) {
      // Where charts meet it is an end of both.
      const double turn = std::remainder(theta - chart * std::numbers::pi, kTurn);
      if (std::abs(turn) > kQuarter + kTogether) continue;
      const double t = !at_quarter ? std::tan(turn / 2) : std::nearbyint(turn / kQuarter);
      if (crowded_->at(chart, t) != nullptr) continue;
      const RotationRange range{chart, std::max(-1.0, nearby(t - kNearCrowd)), std::min(1.0, nearby(t + kNearCrowd))};
      if (std::any_of(near_.begin(), near_.end(), [&](const NearCrowd& o) {
            return o.range.chart == chart && range.t_low <= o.range.t_high && o.range.t_low <= range.t_high;
          }))
        continue;
      near_.push_back({NearAngle(forms_, chart, t), range, per_edge, {}});
      if (!at_quarter) continue;
      const exact::BigRational at = exact::exact_value(t);
      for (std::size_t k = first; k < last && !near_.back().exactly; ++k)
        if (forms_.exact_alignment(all_[k].e, all_[k].f, chart).sign_at(at) == 0) near_.back().exactly = all_[k];
    }
  }
}

const EventWindows::NearCrowd* EventWindows::around(const RotationRange& range) const {
  for (const NearCrowd& crowd : near_)
    if (crowd.range.chart == range.chart && crowd.range.t_low <= range.t_low && range.t_high <= crowd.range.t_high)
      return &crowd;
  return nullptr;
}

const EventWindows::NearCrowd* EventWindows::beside(const RotationRange& range) const {
  for (const NearCrowd& crowd : near_)
    if (crowd.range.chart == range.chart && (crowd.range.t_high == range.t_low || range.t_high == crowd.range.t_low))
      return &crowd;
  return nullptr;
}

RotationRange EventWindows::range_of(int k) const {
  const int windows = per_half_turn_;
  const int chart = k / windows, i = k % windows;
  // Equal angles, rounded to short dyadic tangents.
  const auto end = [&](int j) {
    if (j == 0 || j == windows) return j == 0 ? -1.0 : 1.0;
    return std::nearbyint(std::tan((-0.5 + static_cast<double>(j) / windows) * std::numbers::pi / 2) * 0x1p20) *
           0x1p-20;
  };
  return {chart, end(i), end(i + 1)};
}

std::vector<PreparedWindow> EventWindows::prepare(int k, Halved halved, const std::function<void()>& again) const {
  std::vector<PreparedWindow> parts;
  add_parts(range_of(k), halved, again, parts);
  return parts;
}

// What is around angles at which edges are nearly aligned apart from the rest.
void EventWindows::add_parts(const RotationRange& range, Halved halved, const std::function<void()>& again,
                             std::vector<PreparedWindow>& parts) const {
  std::vector<double> ends{range.t_low};
  for (const NearCrowd& crowd : near_)
    if (crowd.range.chart == range.chart)
      for (const double t : {crowd.range.t_low, crowd.range.t_high})
        if (t > range.t_low && t < range.t_high) ends.push_back(t);
  ends.push_back(range.t_high);
  std::sort(ends.begin(), ends.end());
  for (std::size_t k = 0; k + 1 < ends.size(); ++k)
    if (ends[k] < ends[k + 1]) add({range.chart, ends[k], ends[k + 1]}, 0, halved, again, parts);
}

// Triples grow with the square of the pairs: where segments meet more than some others each, a range is halved.
// Beside a quarter turn at which much is aligned they do provably. Fewer than twelve others are mostly real
// crossings, of which half a range has as many.
void EventWindows::add(const RotationRange& range, int depth, Halved halved, const std::function<void()>& again,
                       std::vector<PreparedWindow>& parts) const {
  constexpr std::size_t kMost = 12;
  again();
  const double midpoint = std::nearbyint(0.5 * (range.t_low + range.t_high) * 0x1p24) * 0x1p-24;
  const NearCrowd *near = around(range), *next_to = beside(range);
  const bool divides = depth < 3 && near == nullptr && midpoint > range.t_low && midpoint < range.t_high;
  const auto halve = [&] {
    add({range.chart, range.t_low, midpoint}, depth + 1, Halved::where_crowded, again, parts);
    add({range.chart, midpoint, range.t_high}, depth + 1, Halved::where_crowded, again, parts);
  };
  if (divides && (halved == Halved::always || beside_crowd(range))) return halve();
  PreparedWindow p;
  p.range = range;
  p.window = std::make_unique<EventWindow>(*grid_, catalog_, range, !reference_ && pairs_ > 100);
  if (divides && p.window->pairs.size() > kMost * p.window->segments.size()) return halve();
  p.filter = std::make_unique<OverlapFilter>(forms_, *p.window);
  QuarterEnds ends;
  if (near != nullptr) ends.around = &near->angle;
  if (near != nullptr && near->exactly && range.t_high == near->angle.tangent()) {
    p.at_end = {nullptr, *near->exactly};
    ends.high_left_out = true;
  }
  if (next_to != nullptr && near == nullptr) ends.beside = &next_to->angle;
  if (crowded_) {
    if (const CrowdedQuarter* low = crowded_->at(range.chart, range.t_low)) ends.low = &low->turn;
    if (const CrowdedQuarter* high = crowded_->at(range.chart, range.t_high)) {
      p.at_end = {&high->turn, high->pair};
      ends.high = &high->turn;
    }
  }
  p.found = events_in(*p.window, forms_, catalog_, all_, reference_ ? nullptr : p.filter.get(), ends, again);
  parts.push_back(std::move(p));
}

bool EventWindows::beside_crowd(const RotationRange& range) const {
  constexpr double kCrowd = 2;
  const auto crowd = [&](double t) {
    const CrowdedQuarter* quarter = crowded_ ? crowded_->at(range.chart, t) : nullptr;
    return quarter != nullptr && quarter->per_edge > kCrowd;
  };
  const NearCrowd* near = beside(range);
  return crowd(range.t_low) || crowd(range.t_high) || (near != nullptr && near->per_edge > kCrowd);
}

}  // namespace dymsum::planar
