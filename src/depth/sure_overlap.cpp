#include "depth/sure_overlap.h"

#include <algorithm>
#include <cmath>

namespace dymsum::depth {

using spatial::Box;
using spatial::BoxTree;
using spatial::Triangle;
using spatial::Vec3;

namespace {

constexpr std::size_t kWitnesses = 24;
constexpr int kPairs = 400;

BoxTree triangle_tree(const std::vector<Vec3>& at, const std::vector<Triangle>& triangles) {
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    Box box;
    for (const std::uint32_t v : t) box.add(at[v]);
    boxes.push_back(box);
  }
  return BoxTree(std::move(boxes));
}

double largest(Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Six volumes of tetrahedra with these edges, and the sign where it is sure for edges whose components are off by
/// `off` at most.
int sure_sign(Vec3 a, Vec3 b, Vec3 c, double off) {
  const double A = largest(a) + off, B = largest(b) + off, C = largest(c) + off;
  const double v = spatial::dot(spatial::cross(a, b), c);
  const double error = 6 * off * (A * B + B * C + C * A) + 0x1p-48 * A * B * C;
  return v > error ? 1 : v < -error ? -1 : 0;
}

/// The segment from e to f against the triangle a, b, c: all five volumes are sure, and say that it goes through.
bool goes_through(Vec3 e, Vec3 f, const std::array<Vec3, 3>& t, double off) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0];
  const int s = sure_sign(u, v, e - t[0], off);
  if (s == 0 || sure_sign(u, v, f - t[0], off) != -s) return false;
  const Vec3 d = f - e;
  const int side = sure_sign(t[0] - e, t[1] - e, d, off);
  return side != 0 && sure_sign(t[1] - e, t[2] - e, d, off) == side && sure_sign(t[2] - e, t[0] - e, d, off) == side;
}

}  // namespace

SureOverlap::SureOverlap(const DepthOperands& o)
    : o_(o), p_tree_(triangle_tree(o.p_at, o.p.triangles)), q_tree_(triangle_tree(o.q_at, o.q.triangles)) {}

bool SureOverlap::crosses(std::uint32_t i, std::uint32_t j, Vec3 at, double radius) const {
  std::array<Vec3, 3> a, c;
  for (std::size_t k = 0; k < 3; ++k) {
    a[k] = o_.p_at[o_.p.triangles[i][k]];
    c[k] = at - o_.q_at[o_.q.triangles[j][k]];
  }
  const double off = 2 * (radius + 4 * DepthOperands::kOff * (1 + largest(at)));
  for (std::size_t k = 0; k < 3; ++k) {
    if (goes_through(a[k], a[(k + 1) % 3], c, off)) return true;
    if (goes_through(c[k], c[(k + 1) % 3], a, off)) return true;
  }
  return false;
}

bool SureOverlap::holds(Vec3 at, double radius) {
  for (std::size_t k = 0; k < witnesses_.size(); ++k) {
    if (!crosses(witnesses_[k][0], witnesses_[k][1], at, radius)) continue;
    std::rotate(witnesses_.begin(), witnesses_.begin() + static_cast<std::ptrdiff_t>(k),
                witnesses_.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    return true;
  }
  Box box;
  box.add(at);
  bool found = false;
  int left = kPairs;
  p_tree_.any_reflected_pair(q_tree_, box, [&](std::uint32_t i, std::uint32_t j) {
    found = crosses(i, j, at, radius);
    if (found) witnesses_.insert(witnesses_.begin(), {i, j});
    return found || --left == 0;
  });
  if (witnesses_.size() > kWitnesses) witnesses_.pop_back();
  return found;
}

}  // namespace dymsum::depth
