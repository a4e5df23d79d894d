#include "depth/same_cell.h"

#include <algorithm>

namespace dymsum::depth {

using spatial::Vec3;

namespace {

constexpr double kNearlyFlat = 0x1p-12;

/// How a way from a to b lies to a facet: off it, inside of its facet edges, or unknown.
enum class Passage : std::uint8_t { off, within, unknown };

Passage passage_of(const FacetView& view, std::uint32_t g, Vec3 a, Vec3 b) {
  const Vec3 n = view.o.normals[g], o = view.corner(g, 0);
  const double margin = 8 * view.slack, from = spatial::dot(n, a - o), to = spatial::dot(n, b - o);
  if (std::min(from, to) > margin || std::max(from, to) < -margin) return Passage::off;
  bool within = true;
  for (std::size_t k = 0; k < view.corners(g); ++k) {
    const Vec3 c = view.corner(g, k), d = view.corner(g, k + 1) - c;
    const double size = spatial::length(d), reach = spatial::length(a - c) + spatial::length(b - c);
    const Vec3 inward = (1 / size) * spatial::cross(n, d);
    const double u = spatial::dot(inward, a - c), v = spatial::dot(inward, b - c);
    const double off = margin + reach * 0x1p-46 / size;
    if (std::max(u, v) < -off) return Passage::off;
    within = within && std::min(u, v) > off;
  }
  return within ? Passage::within : Passage::unknown;
}

}  // namespace

bool in_one_plane(const FacetView& view, const ExactFrame& frame, std::uint32_t f, std::uint32_t g) {
  if (f == g) return true;
  if (spatial::length(spatial::cross(view.o.normals[f], view.o.normals[g])) > kNearlyFlat) return false;
  const ExactPlane a = frame.plane(view.o.facets[f]), b = frame.plane(view.o.facets[g]);
  if (exact::leading_sign(exact::cross(a.n, b.n)) != 0) return false;
  return ExactFrame::side(a, {frame.corner(view.o.facets[g].corner[0]), Big::from_int64(1)}) == 0;
}

bool same_cell(const FacetView& view, const ExactFrame& frame, std::uint32_t facet, Vec3 a, Vec3 b) {
  spatial::Box box;
  box.add(view.from + a), box.add(view.from + b);
  box.grow(4 * view.slack);
  bool same = true;
  view.o.tree.for_each(box, [&](std::uint32_t g) {
    if (!same) return;
    const Passage way = passage_of(view, g, a, b);
    same = way == Passage::off || (way == Passage::within && in_one_plane(view, frame, facet, g));
  });
  return same;
}

}  // namespace dymsum::depth
