#include "depth/proved_overlap.h"

#include <algorithm>
#include <cmath>

#include "depth/proved_sign.h"

namespace dymsum::depth {

using spatial::Box;
using spatial::Triangle;
using spatial::Vec3;

namespace {

constexpr std::size_t kWitnesses = 8, kInner = 96;
constexpr int kPairs = 600;

/// How far along a ray a triangle lies, about; 8 where it misses.
double distance_along(Vec3 from, Vec3 way, const std::vector<Vec3>& at, const Triangle& t) {
  const Vec3 a = at[t[0]] - from, b = at[t[1]] - from, c = at[t[2]] - from;
  const double u = spatial::dot(spatial::cross(a, b), way), v = spatial::dot(spatial::cross(b, c), way),
               w = spatial::dot(spatial::cross(c, a), way);
  if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) return 8;
  const Vec3 n = spatial::cross(b - a, c - a);
  const double s = spatial::dot(n, a) / spatial::dot(n, way);
  return s > 0 ? s : 8;
}

/// The segment from e to f against the triangle a, b, c: all five volumes are proved, and say that it goes through.
bool goes_through(Vec3 e, Vec3 f, const std::array<Vec3, 3>& t, double off) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0];
  const int s = proved_sign(u, v, e - t[0], off);
  if (s == 0 || proved_sign(u, v, f - t[0], off) != -s) return false;
  const Vec3 d = f - e;
  const int side = proved_sign(t[0] - e, t[1] - e, d, off);
  return side != 0 && proved_sign(t[1] - e, t[2] - e, d, off) == side &&
         proved_sign(t[2] - e, t[0] - e, d, off) == side;
}

}  // namespace

/// Positions half-way from the centre of some triangles to what lies behind them.
ProvedOverlap::Solid::Solid(const spatial::SolidOperand& operand, const std::vector<Vec3>& positions)
    : solid(operand), at(positions), tree(spatial::boxes_of(positions, operand.triangles, 0)) {
  const std::size_t count = solid.triangles.size(), step = count / kInner + 1;
  for (std::size_t k = 0; k < count; k += step) {
    const Triangle& t = solid.triangles[k];
    const Vec3 centre = (1.0 / 3) * (at[t[0]] + at[t[1]] + at[t[2]]);
    const Vec3 n = spatial::cross(at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]);
    const Vec3 inward = (-1 / spatial::length(n)) * n;
    double behind = 8;
    for (std::size_t j = 0; j < count; ++j)
      if (j != k) behind = std::min(behind, distance_along(centre, inward, at, solid.triangles[j]));
    const Vec3 position = centre + (0.5 * behind) * inward;
    if (behind < 8 && contains(position, 0x1p-30)) inner.push_back(position);
  }
}

bool ProvedOverlap::Solid::contains(Vec3 position, double margin) const {
  Box ray;
  ray.add(position);
  ray.grow(2 * margin);
  ray.high.z = 8;
  bool inside = false, known = true;
  tree.for_each(ray, [&](std::uint32_t j) {
    if (!known) return;
    const Triangle& t = solid.triangles[j];
    const int pass = spatial::passes_upward(position, at[t[0]], at[t[1]], at[t[2]], margin);
    known = pass >= 0;
    inside ^= pass == 1;
  });
  return known && inside;
}

ProvedOverlap::ProvedOverlap(const DepthOperands& o) : o_(o), p_(o.p, o.p_at), q_(o.q, o.q_at) {}

bool ProvedOverlap::some_inside(Solid& of, const Solid& other, Vec3 at, double margin) {
  const std::size_t count = of.inner.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = (of.last + k) % count;
    if (!other.contains(at - of.inner[i], margin)) continue;
    of.last = i;
    return true;
  }
  return false;
}

bool ProvedOverlap::crosses(std::uint32_t i, std::uint32_t j, Vec3 at, double radius) const {
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

bool ProvedOverlap::holds(Vec3 at, double radius) {
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
  p_.tree.any_reflected_pair(q_.tree, box, [&](std::uint32_t i, std::uint32_t j) {
    found = crosses(i, j, at, radius);
    if (found) witnesses_.insert(witnesses_.begin(), {i, j});
    return found || --left == 0;
  });
  if (witnesses_.size() > kWitnesses) witnesses_.pop_back();
  const double margin = radius + 8 * DepthOperands::kOff * (1 + largest(at));
  return found || some_inside(p_, q_, at, margin) || some_inside(q_, p_, at, margin);
}

}  // namespace dymsum::depth
