#include "spatial/sum/tight_lines.h"

#include <algorithm>

namespace dymsum::spatial {

namespace {

using exact::BigRational;

/// Whether b lies on the segment from a to c: all coordinates in one proportion.
bool between(const SumSpace& space, const PointTable& points, PointId a, PointId b, PointId c) {
  BigRational u[3], v[3];
  for (int axis = 0; axis < 3; ++axis) {
    const BigRational midpoint = space.exact_coordinate(points.source(b), axis);
    u[axis] = midpoint - space.exact_coordinate(points.source(a), axis);
    v[axis] = space.exact_coordinate(points.source(c), axis) - midpoint;
  }
  return u[0] * v[1] == u[1] * v[0] && u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] &&
         u[0] * v[0] + u[1] * v[1] + u[2] * v[2] > 0;
}

}  // namespace

std::vector<TightLine> joined_lines(const SumSpace& space, const PointTable& points,
                                    std::span<const std::array<PointId, 2>> pieces) {
  // Ends as 2 k for the first and 2 k + 1 for the second one of piece k, by points.
  const auto at = [&](std::uint32_t end) { return pieces[end / 2][end % 2]; };
  std::vector<std::uint32_t> ends(2 * pieces.size()), next(ends.size(), kNoId);
  for (std::uint32_t e = 0; e < ends.size(); ++e) ends[e] = e;
  std::sort(ends.begin(), ends.end(),
            [&](std::uint32_t a, std::uint32_t b) { return at(a) != at(b) ? at(a) < at(b) : a < b; });
  for (std::size_t first = 0, last = 0; first < ends.size(); first = last) {
    while (last < ends.size() && at(ends[last]) == at(ends[first])) ++last;
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t j = i + 1; j < last; ++j)
        if (between(space, points, at(ends[i] ^ 1), at(ends[i]), at(ends[j] ^ 1)))
          next[ends[i]] = ends[j], next[ends[j]] = ends[i];
  }
  std::vector<TightLine> lines;
  for (std::uint32_t e = 0; e < next.size(); ++e) {
    if (next[e] != kNoId) continue;
    std::uint32_t to = e ^ 1;
    while (next[to] != kNoId) to = next[to] ^ 1;
    if (e < to) lines.push_back({at(e), at(to), e / 2, to / 2});
  }
  return lines;
}

}  // namespace dymsum::spatial
