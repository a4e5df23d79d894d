// The positions at which the segments of a sum meet, by the method that is the least work.
#pragma once

#include <span>

#include "base/poll.h"
#include "planar/arrangement/crossings.h"
#include "planar/mask/fine_cells.h"

namespace dymsum::planar {

/// Meetings, and marks of covered cells that segments pass, where these are found on the way.
struct MarkedMeetings {
  Meetings meetings;
  Array<CoveredMark> marks;
};

/// All meetings, from all pairs of segments. O(n^2) for n segments.
Meetings all_meetings(const Soup& soup, const Chain* chain, const Poll& poll);

/// All meetings, by a sweep or on a grid.
Meetings every_meeting(const Soup& soup, const Poll& poll);

/// All meetings outside the cover, by a sweep or on the mask's grid.
MarkedMeetings open_meetings(const Soup& soup, const Chain& chain, const KnownCover& cover, const Poll& poll);

/// The same where only these pieces of the segments lie outside: they are swept.
Meetings piece_meetings(const Soup& soup, const Chain& chain, std::span<const SegmentPiece> pieces,
                        const FineCells& cells, const Poll& poll);

}  // namespace dymsum::planar
