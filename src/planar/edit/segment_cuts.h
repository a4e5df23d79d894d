// Cuts of segments of a soup: their order along a segment, their positions, and samples between two of them.
#pragma once

#include <cstdint>

#include "planar/arrangement/arrangement.h"

namespace dymsum::planar {

/// The cut that an end names.
Cut cut_of(const Soup& soup, const SubEnd& end);

/// The exact order along segment s of two cuts on it: -1, 0, 1.
int compare_cuts(const Soup& soup, std::uint32_t s, const SubEnd& a, const SubEnd& b);

/// The position of a cut at parameter t of s, which errs by at most `t_error`.
SegmentPosition position_of_cut(const Soup& soup, std::uint32_t s, const Cut& cut, double t, double t_error);

/// A cut with its parameter.
struct CutOnSegment {
  Cut cut;
  double t = 0, error = 0;
};
/// The mediant of two cuts of s, the first of which comes first: a position strictly between them.
SegmentPosition sample_between(const Soup& soup, std::uint32_t s, const CutOnSegment& from, const CutOnSegment& to);

}  // namespace dymsum::planar
