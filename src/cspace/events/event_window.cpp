#include "cspace/events/event_window.h"

#include <algorithm>

namespace dymsum::planar {
namespace {

double low_of(const RotationRange& r) { return r.theta(r.t_low) - kAngleDouble; }
double high_of(const RotationRange& r) { return r.theta(r.t_high) + kAngleDouble; }

}  // namespace

EventWindow::EventWindow(const RotationGrid& grid, const RotationCatalog& catalog, const RotationRange& r, bool mask)
    : RotatingWindow(grid, catalog, (low_of(r) + high_of(r)) / 2, (high_of(r) - low_of(r)) / 2, mask),
      range(r),
      low(low_of(r)),
      high(high_of(r)) {
  pairs.reserve(candidates.size());
  for (const RotationCandidate& c : candidates)
    pairs.push_back({std::min(segment_of(c.a), segment_of(c.b)), std::max(segment_of(c.a), segment_of(c.b))});
  sort_pairs();
}

// Sorts pairs into one list per first segment, which are short; without what several pieces of two segments say twice.
void EventWindow::sort_pairs() {
  pairs_of_.assign(segments.size() + 1, 0);
  for (const SegmentPair& p : pairs) ++pairs_of_[p.a + 1];
  for (std::size_t a = 0; a < segments.size(); ++a) pairs_of_[a + 1] += pairs_of_[a];
  std::vector<std::uint32_t> others(pairs.size()), fill(pairs_of_.begin(), pairs_of_.end() - 1);
  for (const SegmentPair& p : pairs) others[fill[p.a]++] = p.b;
  pairs.clear();
  for (std::uint32_t a = 0; a < segments.size(); ++a) {
    const auto first = others.begin() + pairs_of_[a], last = others.begin() + fill[a];
    std::sort(first, last);
    pairs_of_[a] = static_cast<std::uint32_t>(pairs.size());
    for (auto b = first; b != last; ++b)
      if (b == first || *b != b[-1]) pairs.push_back({a, *b});
  }
  pairs_of_[segments.size()] = static_cast<std::uint32_t>(pairs.size());
}

bool EventWindow::meet(std::uint32_t a, std::uint32_t b) const {
  const auto first = pairs.begin() + pairs_of_[a], last = pairs.begin() + pairs_of_[a + 1];
  return std::binary_search(first, last, SegmentPair{a, b});
}

}  // namespace dymsum::planar
