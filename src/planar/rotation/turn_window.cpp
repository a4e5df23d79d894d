#include "planar/rotation/turn_window.h"

#include <algorithm>

namespace dymsum::planar {

TurnWindow::TurnWindow(const TurnGrid& base, const TurnCatalog& catalog, const TurnRange& r, bool mask) : range(r) {
  low = range.theta(range.t_low) - 0x1p-48;
  high = range.theta(range.t_high) + 0x1p-48;
  middle = (low + high) / 2;
  half = (high - low) / 2 * (1 + 0x1p-40);
  heading = Heading::of(middle);
  const RotatingWindow pieces(base, catalog, middle, half, mask);
  all_segments = pieces.all_segments;
  segments.reserve(pieces.segments.size());
  for (const TurnSegment& s : pieces.segments) segments.push_back(s.walk);
  meetings.reserve(pieces.meetings.size());
  for (const TurnMeeting& m : pieces.meetings) meetings.push_back({std::min(m.segment_a, m.segment_b), std::max(m.segment_a, m.segment_b)});
  std::sort(meetings.begin(), meetings.end());
  meetings.erase(std::unique(meetings.begin(), meetings.end()), meetings.end());
  const TurningForms& forms = base.forms;
  for (const Point& p : forms.points(1)) turned.push_back({heading.c * p.x - heading.s * p.y, heading.s * p.x + heading.c * p.y});
}

}  // namespace dymsum::planar
