#include "spatial/events/sure_overlap.h"

namespace dymsum::spatial {

namespace {

BoxTree tree_of(const SolidOperand& solid, const std::vector<Vec3>& places) {
  std::vector<Box> boxes;
  for (const Triangle& t : solid.triangles) {
    Box box;
    for (const std::uint32_t v : t) box.add(places[v]);
    boxes.push_back(box);
  }
  return BoxTree(std::move(boxes));
}

double det(Vec3 a, Vec3 b, Vec3 c) { return dot(cross(a, b), c); }

/// Whether ab crosses the triangle inside, every sign being beyond the margin.
bool crosses(Vec3 a, Vec3 b, const std::array<Vec3, 3>& t, double margin) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double from = dot(n, a - t[0]), to = dot(n, b - t[0]);
  if (!((from > margin && to < -margin) || (from < -margin && to > margin))) return false;
  const double down = from > 0 ? 1 : -1;
  for (int k = 0; k < 3; ++k)
    if (!(down * det(b - a, t[(k + 1) % 3] - t[k], t[k] - a) > margin)) return false;
  return true;
}

}  // namespace

SureOverlap::SureOverlap(const RotatingPair& pair, const Mat3& matrix) : pair_(pair), places_(pair.places) {
  for (Vec3& v : places_[pair.turning]) v = matrix * v;
  p_tree_ = tree_of(pair.pair.p, places_[0]);
  q_tree_ = tree_of(pair.pair.q, places_[1]);
}

bool SureOverlap::at(Vec3 at, double radius) const {
  // Corners are at most 4 long and off by this along each axis: a determinant of three differences of two by less than
  // 6 times 6 times 8 times 8 of that, and it is rounded by far less.
  const double margin = (radius + 0x1p-43) * 0x1p12;
  Box box;
  box.add(at);
  return p_tree_.any_reflected_pair(q_tree_, box, [&](std::uint32_t i, std::uint32_t j) {
    std::array<Vec3, 3> p, q;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = places_[0][pair_.pair.p.triangles[i][k]];
      q[k] = at - places_[1][pair_.pair.q.triangles[j][k]];
    }
    for (std::size_t k = 0; k < 3; ++k)
      if (crosses(p[k], p[(k + 1) % 3], q, margin) || crosses(q[k], q[(k + 1) % 3], p, margin)) return true;
    return false;
  });
}

}  // namespace dymsum::spatial
