#include "planar/turning/turn_window.h"

#include <algorithm>

namespace dymsum::planar {

TurnWindow::TurnWindow(const TurnGrid& base, const TurnCatalog& catalog, const TurnRange& r, bool mask) : range(r) {
  low = range.theta(range.t_low) - kAngleDouble;
  high = range.theta(range.t_high) + kAngleDouble;
  middle = (low + high) / 2;
  half = (high - low) / 2 * exact::kOutwards;
  heading = Heading::of(middle);
  const RotatingWindow pieces(base, catalog, middle, half, mask);
  all_segments = pieces.all_segments;
  segments.reserve(pieces.segments.size());
  for (const TurnSegment& s : pieces.segments) segments.push_back(s.walk);
  meetings.reserve(pieces.meetings.size());
  for (const TurnMeeting& m : pieces.meetings)
    meetings.push_back({std::min(m.segment_a, m.segment_b), std::max(m.segment_a, m.segment_b)});
  sort_meetings();
  const TurningForms& forms = base.forms;
  for (const Point& p : forms.points(1))
    turned.push_back({heading.c * p.x - heading.s * p.y, heading.s * p.x + heading.c * p.y});
}

// Into one list per first segment, which are short; without what several pieces of two segments say twice.
void TurnWindow::sort_meetings() {
  first_of.assign(segments.size() + 1, 0);
  for (const Meeting& m : meetings) ++first_of[m.a + 1];
  for (std::size_t a = 0; a < segments.size(); ++a) first_of[a + 1] += first_of[a];
  std::vector<std::uint32_t> others(meetings.size()), fill(first_of.begin(), first_of.end() - 1);
  for (const Meeting& m : meetings) others[fill[m.a]++] = m.b;
  meetings.clear();
  for (std::uint32_t a = 0; a < segments.size(); ++a) {
    const auto first = others.begin() + first_of[a], last = others.begin() + fill[a];
    std::sort(first, last);
    first_of[a] = static_cast<std::uint32_t>(meetings.size());
    for (auto b = first; b != last; ++b)
      if (b == first || *b != b[-1]) meetings.push_back({a, *b});
  }
  first_of[segments.size()] = static_cast<std::uint32_t>(meetings.size());
}

bool TurnWindow::meet(std::uint32_t a, std::uint32_t b) const {
  const auto first = meetings.begin() + first_of[a], last = meetings.begin() + first_of[a + 1];
  return std::binary_search(first, last, Meeting{a, b});
}

}  // namespace dymsum::planar
