#include "spatial/moving/frame_changes.h"

#include <algorithm>

namespace dymsum::spatial {

namespace {

/// A face seen from one of its edges: what makes it, and what makes the face beyond.
struct Meeting {
  SolidContact face, beyond;
  friend auto operator<=>(const Meeting&, const Meeting&) = default;
};

/// Of every face with every other one at each edge, sorted.
std::vector<Meeting> meetings(const SpatialSum& sum) {
  const auto contact = [&](std::uint32_t f) { return SolidContact{sum.faces[f].p, sum.faces[f].q}; };
  std::vector<Meeting> all;
  all.reserve(2 * sum.edges.size());
  for (const SpatialEdge& edge : sum.edges)
    for (const std::uint32_t a : edge.faces)
      for (const std::uint32_t b : edge.faces)
        if (a != b) all.push_back({contact(a), contact(b)});
  std::sort(all.begin(), all.end());
  return all;
}

std::int64_t more(std::size_t before, std::size_t after) {
  return static_cast<std::int64_t>(after) - static_cast<std::int64_t>(before);
}

}  // namespace

SolidFrameChanges frame_changes(const SpatialSum& before, const SpatialSum& after) {
  SolidFrameChanges changes;
  const std::vector<Meeting> was = meetings(before), is = meetings(after);
  const auto end_of = [](auto at, auto end) {
    return std::find_if(at, end, [&](const Meeting& m) { return m.face != at->face; });
  };
  auto a = was.begin(), b = is.begin();
  while (a != was.end() || b != is.end()) {
    const auto a_end = end_of(a, was.end()), b_end = end_of(b, is.end());
    if (b == is.end() || (a != was.end() && a->face < b->face)) {
      changes.disappeared.push_back(a->face), a = a_end;
    } else if (a == was.end() || b->face < a->face) {
      changes.appeared.push_back(b->face), b = b_end;
    } else {
      if (!std::equal(a, a_end, b, b_end)) changes.changed.push_back(b->face);
      a = a_end, b = b_end;
    }
  }
  changes.shells = more(before.shells, after.shells);
  changes.tight_faces = more(before.tight_faces.size(), after.tight_faces.size());
  changes.tight_segments = more(before.tight_segments.size(), after.tight_segments.size());
  changes.tight_points = more(before.tight_points.size(), after.tight_points.size());
  return changes;
}

}  // namespace dymsum::spatial
