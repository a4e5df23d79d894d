#include "planar/arrangement/find_meetings.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {
namespace {

// A sweep is cheaper than filling a grid for few segments, and for more of them while each has not too many others
// above and below it: as many as widths of segments add up to that of the sum.
bool sweep_pays(const Soup& soup) {
  constexpr std::size_t kFew = 4000;
  constexpr double kBeside = 250;
  if (soup.size() < kFew) return true;
  double widths = 0;
  for (const SoupBox& b : soup.boxes) widths += std::abs(b.dx);
  return widths < kBeside * soup.lattice.span;
}

Grid plain_grid(const Lattice& lattice, std::size_t segments) {
  const double width = lattice.points[0]->width + lattice.points[1]->width;
  const double height = lattice.points[0]->height + lattice.points[1]->height;
  const double longer = std::max(width, height);
  Grid g;
  const int cells = grid_size(segments);
  g.cell = longer / cells;
  g.per_cell = cells / longer;
  g.columns = static_cast<int>(width * g.per_cell) + 1;
  g.rows = static_cast<int>(height * g.per_cell) + 1;
  return g;
}

}  // namespace

Meetings all_meetings(const Soup& soup, const Chain* chain, const Poll& poll) {
  Meetings meetings(soup.memory);
  CrossingFinder(soup, meetings, chain, &poll).all_pairs();
  return meetings;
}

Meetings every_meeting(const Soup& soup, const Poll& poll) {
  Meetings meetings(soup.memory);
  CrossingFinder finder(soup, meetings, nullptr, &poll);
  if (sweep_pays(soup)) {
    finder.sweep();
  } else {
    Array<CoveredMark> none(soup.memory);
    finder.grid(plain_grid(soup.lattice, soup.size()), nullptr, none);
  }
  return meetings;
}

MarkedMeetings open_meetings(const Soup& soup, const Chain& chain, const KnownCover& cover, const Poll& poll) {
  MarkedMeetings found{Meetings(soup.memory), Array<CoveredMark>(soup.memory)};
  CrossingFinder finder(soup, found.meetings, &chain, &poll);
  if (sweep_pays(soup)) finder.sweep(cover.mask);
  else if (cover.mask != nullptr) finder.grid(cover.mask->grid(), cover.mask, found.marks);
  else finder.grid(plain_grid(soup.lattice, soup.size()), nullptr, found.marks);
  return found;
}

Meetings piece_meetings(const Soup& soup, const Chain& chain, std::span<const SegmentPiece> pieces,
                        const FineCells& cells, const Poll& poll) {
  Meetings meetings(soup.memory);
  CrossingFinder(soup, meetings, &chain, &poll).sweep(pieces, kReach / 2 * cells.grid().cell);
  return meetings;
}

}  // namespace dymsum::planar
