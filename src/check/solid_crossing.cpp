#include "check/solid_crossing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "spatial/mesh/box_tree.h"

namespace dymsum::check {
namespace {

using spatial::Box;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
/// Of more triangles the cell is cut halfway between them first.
constexpr std::size_t kFew = 12;

/// The side of the line from a to b on which p lies, seen along z.
int side_seen_along_z(const SpacePoint& a, const SpacePoint& b, const SpacePoint& p) {
  const double bx = b.near.x - a.near.x, by = b.near.y - a.near.y;
  const double px = p.near.x - a.near.x, py = p.near.y - a.near.y, area = bx * py - by * px;
  // Positions are off by half an ulp, each difference by three halves of the largest coordinate's.
  const double reach = std::max({std::abs(a.near.x), std::abs(a.near.y), std::abs(b.near.x), std::abs(b.near.y),
                                 std::abs(p.near.x), std::abs(p.near.y)});
  const double sizes = std::abs(bx) + std::abs(by) + std::abs(px) + std::abs(py);
  const double slack = 0x1p-48 * reach * (sizes + 0x1p-48 * reach) + 0x1p-1000;
  if (area > slack) return 1;
  if (area < -slack) return -1;
  const auto &u = a.exact, &v = b.exact, &w = p.exact;
  return BigInteger(u[0] * (v[1] * w[3] - v[3] * w[1]) - u[1] * (v[0] * w[3] - v[3] * w[0]) +
                    u[3] * (v[0] * w[1] - v[1] * w[0]))
      .sign();
}

double coordinate(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

SolidCrossing::SolidCrossing(const spatial::ExactSet& set, PlaneTable& planes)
    : set_(set), planes_(planes), planes_of_(set.set.faces.size(), kNone) {
  for (const RationalVector& p : set.at) vertices_.push_back(std::make_shared<SpacePoint>(p));
  std::vector<Box> boxes;
  for (const Face& f : set.set.faces)
    for (Box& box = boxes.emplace_back(); const std::uint32_t v : f) box.add(vertices_[v]->near);
  tree_ = spatial::BoxTree(std::move(boxes));
}

std::vector<std::uint32_t> SolidCrossing::all() const {
  std::vector<std::uint32_t> all(planes_of_.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

SolidCell SolidCrossing::box(PlaneTable& planes) const {
  Box box;
  for (const Face& f : set_.set.faces)
    for (const std::uint32_t v : f) box.add(vertices_[v]->near);
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const auto& [low, high] = box;
  return box_cell({std::nextafter(low.x, -kFar), std::nextafter(low.y, -kFar), std::nextafter(low.z, -kFar)},
                  {std::nextafter(high.x, kFar), std::nextafter(high.y, kFar), std::nextafter(high.z, kFar)}, planes);
}

std::uint32_t SolidCrossing::plane_of(std::uint32_t triangle) {
  std::uint32_t& plane = planes_of_[triangle];
  if (plane == kNone) {
    const Face& f = set_.set.faces[triangle];
    plane = planes_.add(*vertices_[f[0]], *vertices_[f[1]], *vertices_[f[2]]);
  }
  return plane;
}

bool SolidCrossing::crosses(const SolidCell& cell, std::uint32_t triangle, bool by_plane) {
  const Face& f = set_.set.faces[triangle];
  for (const SolidCell::Facet& facet : cell.facets)
    if (std::all_of(f.begin(), f.end(),
                    [&](std::uint32_t v) { return side_of(planes_[facet.plane], *vertices_[v]) * facet.side <= 0; }))
      return false;
  if (!by_plane) return true;
  const Plane& plane = planes_[plane_of(triangle)];
  bool negative = false, positive = false;
  for (const SpacePointRef& v : cell.vertices) {
    const int side = side_of(plane, *v);
    negative |= side < 0;
    positive |= side > 0;
  }
  return negative && positive;
}

std::optional<bool> SolidCrossing::is_inside(const SpacePoint& p) {
  Box ray;
  ray.add(p.near);
  ray.grow(0x1p-50 * std::max({std::abs(p.near.x), std::abs(p.near.y), std::abs(p.near.z)}));
  ray.high.z = 1e300;
  bool known = true, inside = false;
  tree_.for_each(ray, [&](std::uint32_t t) {
    if (!known) return;
    const Plane& plane = planes_[plane_of(t)];
    if (plane.exact[2] == 0) return;  // a vertical triangle: the ray misses it, or goes through an edge of others
    const Face& f = set_.set.faces[t];
    int sides = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const int side = side_seen_along_z(*vertices_[f[k]], *vertices_[f[(k + 1) % 3]], p);
      if (side == 0) known = false;
      sides += side;
    }
    if (!known || std::abs(sides) != 3) return;
    if (side_of(plane, p) * plane.exact[2].sign() < 0) inside = !inside;
  });
  return known ? std::optional(inside) : std::nullopt;
}

std::vector<std::uint32_t> SolidCrossing::crossing(const SolidCell& cell, const std::vector<std::uint32_t>& among) {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t t : among)
    if (crosses(cell, t, false)) found.push_back(t);
  std::erase_if(found,
                [&, many = found.size() > 4 * kFew](std::uint32_t t) { return !many && !crosses(cell, t, true); });
  return found;
}

std::optional<HalvedSolidCell> SolidCrossing::cut(const SolidCell& cell, const std::vector<std::uint32_t>& crossing,
                                                  const SpacePoint& p) {
  const auto centre = [&](std::uint32_t t) {
    const Face& f = set_.set.faces[t];
    return 1.0 / 3 * (vertices_[f[0]]->near + vertices_[f[1]]->near + vertices_[f[2]]->near);
  };
  if (crossing.size() > kFew) {
    Box box;
    for (const std::uint32_t t : crossing) box.add(centre(t));
    const Vec3 size = box.high - box.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::vector<double> at;
    for (const std::uint32_t t : crossing) at.push_back(coordinate(centre(t), axis));
    std::nth_element(at.begin(), at.begin() + static_cast<std::ptrdiff_t>(at.size() / 2), at.end());
    RationalVector normal{0, 0, 0};
    normal[axis] = 1;
    const exact::BigRational v = exact::exact_value(at[at.size() / 2]);
    if (auto halves = halved(cell, planes_.add(normal, {v, v, v}), planes_)) return halves;
  }
  // The nearest ones first; the plane of one that was kept for being one of many may miss the cell.
  std::vector<std::pair<double, std::uint32_t>> order;
  for (const std::uint32_t t : crossing) order.emplace_back(length(centre(t) - p.near), t);
  std::sort(order.begin(), order.end());
  for (const auto& [d, t] : order)
    if (auto halves = halved(cell, plane_of(t), planes_)) return halves;
  return std::nullopt;
}

}  // namespace dymsum::check
