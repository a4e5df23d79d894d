#include "spatial/boolean/winding_number.h"

#include "spatial/boundary/collision_query.h"

namespace dymsum::spatial {

namespace {

std::vector<Box> boxes_around(const SumSpace& space, const std::vector<Triangle>& triangles) {
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    Box box;
    for (const std::uint32_t v : t) box.add(space.approx({v, 0}));
    box.grow(space.sum_radius());
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace

WindingNumber::WindingNumber(const SumSpace& space, const std::vector<Triangle>& triangles)
    : space_(space), triangles_(triangles), tree_(boxes_around(space, triangles)) {}

int WindingNumber::at(const Flag& x) const {
  const FlagQuery query(space_, x);
  Box ray = query.box();
  ray.grow(4 * space_.sum_radius());
  ray.high.z = 1e300;
  int winding = 0;
  tree_.for_each(ray, [&](std::uint32_t t) {
    const Triangle& c = triangles_[t];
    int turn = 0;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = c[k], b = c[(k + 1) % 3];
      const PlaneSource upright{{a, 0}, {DirectionSource::Of::p, a, b}, {DirectionSource::Of::axis, 2, 0}, false};
      int s = query.side(upright, space_.p()[b] - space_.p()[a], {0, 0, 1});
      // As if the position were moved by an infinitesimal along x, and a smaller one along y.
      for (int axis = 0; axis < 2 && s == 0; ++axis) s = space_.exact_normal(upright, axis);
      if (s == 0 || (k > 0 && s != turn)) return;
      turn = s;
    }
    const PlaneSource plane{
        {c[0], 0}, {DirectionSource::Of::p, c[0], c[1]}, {DirectionSource::Of::p, c[0], c[2]}, false};
    const int up = space_.exact_normal(plane, 2);
    const Vec3 &a = space_.p()[c[0]], &b = space_.p()[c[1]], &d = space_.p()[c[2]];
    if (query.side(plane, b - a, d - a) * up < 0) winding += up;
  });
  return winding;
}

}  // namespace dymsum::spatial
