// The finished solid as renderers take it.
#include <algorithm>

#include "dymsum/convex_solid.h"

namespace dymsum {
namespace {

void write_position(const ConvexSolid& solid, std::size_t v, SolidBuffers& buffers) {
  const Point3& at = solid.at[v];
  float* to = &buffers.positions[3 * v];
  to[0] = static_cast<float>(at.x);
  to[1] = static_cast<float>(at.y);
  to[2] = static_cast<float>(at.z);
}

void write_facet(const ConvexSolid& solid, std::size_t facet, SolidBuffers& buffers) {
  const std::span<const std::uint32_t> corners = solid.corners_of(facet);
  std::size_t to = 3 * std::size_t{solid.facets[facet].first_triangle};
  for (std::size_t k = 2; k < corners.size(); ++k)
    for (const std::uint32_t v : {corners[0], corners[k - 1], corners[k]}) buffers.triangles[to++] = v;
}

/// Indices one by one; runs of them become one range.
void add(std::vector<IndexRange>& ranges, std::size_t index) {
  if (!ranges.empty() && ranges.back().first + ranges.back().count == index) ++ranges.back().count;
  else ranges.push_back({index, 1});
}

void write_all(const ConvexSolid& solid, SolidBuffers& buffers) {
  buffers.positions_changed = {{0, solid.at.size()}};
  buffers.triangles_changed = {{0, solid.triangle_slots}};
  std::fill(buffers.triangles.begin(), buffers.triangles.end(), 0);
  for (std::size_t v = 0; v < solid.at.size(); ++v) write_position(solid, v, buffers);
  for (std::size_t f = 0; f < solid.facets.size(); ++f) write_facet(solid, f, buffers);
}

void write_changes(const ConvexSolid& solid, SolidBuffers& buffers) {
  const SolidChanges& changes = solid.changes;
  buffers.positions_changed.clear();
  if (changes.moved) {
    buffers.positions_changed.push_back({0, solid.at.size()});
    for (std::size_t v = 0; v < solid.at.size(); ++v) write_position(solid, v, buffers);
  } else {
    // Both lists are sorted and have nothing in common.
    auto gone = changes.vertices_disappeared.begin();
    const auto write_until = [&](std::uint32_t end) {
      for (; gone != changes.vertices_disappeared.end() && *gone < end; ++gone) {
        write_position(solid, *gone, buffers);
        add(buffers.positions_changed, *gone);
      }
    };
    for (const std::uint32_t v : changes.vertices_appeared) {
      write_until(v);
      write_position(solid, v, buffers);
      add(buffers.positions_changed, v);
    }
    write_until(ConvexSolid::kFree);
  }
  buffers.triangles_changed = changes.triangles;
  for (const IndexRange& r : changes.triangles) {
    const auto first = buffers.triangles.begin() + static_cast<std::ptrdiff_t>(3 * r.first);
    std::fill(first, first + static_cast<std::ptrdiff_t>(3 * r.count), 0);
  }
  for (const FacetChange& change : changes.facets) write_facet(solid, change.facet, buffers);
}

}  // namespace

void ConvexSolid::write(SolidBuffers& buffers) const {
  const bool follows = frame > 0 && buffers.frame + 1 == frame && buffers.frame > 0;
  if (buffers.frame == frame && frame > 0) {
    buffers.positions_changed.clear();
    buffers.triangles_changed.clear();
    return;
  }
  buffers.positions.resize(3 * at.size());
  buffers.triangles.resize(3 * triangle_slots);
  if (follows) write_changes(*this, buffers);
  else write_all(*this, buffers);
  buffers.frame = frame;
}

}  // namespace dymsum
