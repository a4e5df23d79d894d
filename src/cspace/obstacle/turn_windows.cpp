#include "cspace/obstacle/turn_windows.h"

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

TurnWindows::TurnWindows(const TurningForms& forms, const TurnCatalog& catalog, bool reference)
    : forms_(forms),
      catalog_(catalog),
      reference_(reference),
      pairs_(static_cast<double>(forms.size(0)) * forms.size(1)),
      per_half_turn_(windows_for(pairs_)),
      all_(alignments(forms, catalog)) {
  if (!reference) crowded_.emplace(forms, all_);
  grid_.emplace(forms, crowded_ && crowded_->any() ? cells_for_crowd(forms, pairs_) : cells_for(pairs_), kLongEdges);
}

TurnRange TurnWindows::range_of(int k) const {
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

std::vector<PreparedWindow> TurnWindows::prepare(int k, Halved halved, const std::function<void()>& again) const {
  std::vector<PreparedWindow> parts;
  add(range_of(k), 0, halved, again, parts);
  return parts;
}

// Triples grow with the square of the pairs: where segments meet more than some others each, a range is halved.
// Beside a quarter turn at which much is aligned they do for certain. Fewer than twelve others are mostly real
// crossings, of which half a range has as many.
void TurnWindows::add(const TurnRange& range, int depth, Halved halved, const std::function<void()>& again,
                      std::vector<PreparedWindow>& parts) const {
  constexpr std::size_t kMost = 12;
  again();
  const double middle = std::nearbyint(0.5 * (range.t_low + range.t_high) * 0x1p24) * 0x1p-24;
  const bool divides = depth < 3 && middle > range.t_low && middle < range.t_high;
  const auto halve = [&] {
    add({range.chart, range.t_low, middle}, depth + 1, Halved::where_crowded, again, parts);
    add({range.chart, middle, range.t_high}, depth + 1, Halved::where_crowded, again, parts);
  };
  if (divides && (halved == Halved::always || beside_crowd(range))) return halve();
  PreparedWindow p;
  p.range = range;
  p.window = std::make_unique<TurnWindow>(*grid_, catalog_, range, !reference_ && pairs_ > 100);
  if (divides && p.window->pairs.size() > kMost * p.window->segments.size()) return halve();
  p.filter = std::make_unique<OverlapFilter>(forms_, *p.window);
  QuarterEnds ends;
  if (crowded_) {
    if (const CrowdedQuarter* low = crowded_->at(range.chart, range.t_low)) ends.low = &low->turn;
    p.at_end = crowded_->at(range.chart, range.t_high);
    if (p.at_end != nullptr) ends.high = &p.at_end->turn;
  }
  p.found = events_in(*p.window, forms_, catalog_, all_, reference_ ? nullptr : p.filter.get(), ends, again);
  parts.push_back(std::move(p));
}

bool TurnWindows::beside_crowd(const TurnRange& range) const {
  constexpr double kCrowd = 2;
  const auto crowd = [&](double t) {
    const CrowdedQuarter* quarter = crowded_ ? crowded_->at(range.chart, t) : nullptr;
    return quarter != nullptr && quarter->per_edge > kCrowd;
  };
  return crowd(range.t_low) || crowd(range.t_high);
}

}  // namespace dymsum::planar
