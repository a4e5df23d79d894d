#include "spatial/slice/slice_lines.h"

#include <algorithm>
#include <tuple>
#include <vector>

namespace dymsum::spatial {

namespace {

/// A line by the points at which it meets two opposite edges of the frame, or their lines: equal lines have equal
/// hashes of them.
struct LineKey {
  bool across = false;  ///< it meets the facet edges along y
  exact::Residue a = 0, b = 0;
  PlaneId cut = 0;
};

PointSource crossing(PlaneId a, PlaneId b, PlaneId c) {
  std::array<PlaneId, 3> planes{a, b, c};
  std::sort(planes.begin(), planes.end());
  return {PointSource::Kind::planes, planes[0], planes[1], planes[2]};
}

}  // namespace

std::unordered_map<PlaneId, CutLine> cut_lines(const SlicePlane& plane) {
  std::unordered_map<PlaneId, CutLine> lines;
  std::array<PlaneId, 4> facet_edge{};
  std::size_t facet_edges = 0;
  for (const SliceSegment& s : plane.segments) {
    const bool frame = s.facet == SliceSegment::kFrame;
    const std::int8_t side = s.crossing ? plane.table.facets[s.facet].side : std::int8_t{0};
    const auto [line, added] = lines.emplace(s.segment.cut, CutLine{side, true, frame});
    if (!added && line->second.side != side) line->second.side = 0;
    if (frame) facet_edge[facet_edges++] = s.segment.cut;
  }
  std::vector<LineKey> keys;
  std::vector<PointSource> sources;
  for (const auto& [cut, line] : lines) {
    if (line.frame) continue;
    const bool across = plane.space->det(plane.plane, cut, facet_edge[1]) != 0;
    keys.push_back({across, 0, 0, cut});
    sources.push_back(crossing(plane.plane, cut, facet_edge[across ? 1 : 0]));
    sources.push_back(crossing(plane.plane, cut, facet_edge[across ? 3 : 2]));
  }
  const std::vector<exact::Residue> hashes = plane.space->point_hashes(sources);
  for (std::size_t k = 0; k < keys.size(); ++k) keys[k].a = hashes[2 * k], keys[k].b = hashes[2 * k + 1];
  std::sort(keys.begin(), keys.end(), [](const LineKey& x, const LineKey& y) {
    return std::tie(x.across, x.a, x.b, x.cut) < std::tie(y.across, y.a, y.b, y.cut);
  });
  for (std::size_t k = 1; k < keys.size(); ++k)
    if (std::tie(keys[k].across, keys[k].a, keys[k].b) == std::tie(keys[k - 1].across, keys[k - 1].a, keys[k - 1].b))
      lines[keys[k].cut].alone = lines[keys[k - 1].cut].alone = false;
  return lines;
}

}  // namespace dymsum::spatial
