#include "spatial/moving/inner_window.h"

#include <algorithm>
#include <cmath>

#include "spatial/frames/pose_angles.h"

namespace dymsum::spatial {

Mat3 linear_map(const SolidPose& pose) {
  Mat3 m = matrix_of(relative_rotation(Rotation(), pose.rotation));
  const Vec3 s = scale_factors(pose);
  for (Vec3& row : m) row = {row.x * s.x, row.y * s.y, row.z * s.z};
  return m;
}

double radius_about_middle(const std::vector<Point3>& vertices) {
  Box box;
  for (const Point3& v : vertices) box.add(Vec3{v.x, v.y, v.z});
  return vertices.empty() ? 0 : 0.5 * length(box.high - box.low) * (1 + 0x1p-40);
}

double displacement(const SolidPose& from, const SolidPose& to, double radius) {
  if (from == to) return 0;
  const Mat3 a = linear_map(from), b = linear_map(to);
  double squares = 0, size = 0;
  for (std::size_t r = 0; r < 3; ++r) {
    const Vec3 d = b[r] - a[r];
    squares += dot(d, d), size += dot(a[r], a[r]) + dot(b[r], b[r]);
  }
  return radius * (std::sqrt(squares) + std::sqrt(size) * 0x1p-42);
}

InnerWindow::InnerWindow(const SolidPair& pair, const PosePair& poses, int across, double share)
    : across_(across),
      poses_(poses),
      radius_{radius_about_middle(pair.p.vertices), radius_about_middle(pair.q.vertices)},
      at_(posed_space(pair, poses)) {
  Box p, q;
  for (const Vec3& v : at_.space->p()) p.add(v);
  for (const Vec3& v : at_.space->q()) q.add(v);
  const Vec3 size = (p.high - p.low) + (q.high - q.low);
  own_sweep_ = share * std::min({size.x, size.y, size.z}) / across;
  // The space's units are those of positions times the common denominator.
  const double unit =
      std::ldexp(1.0, at_.space->line(0).exponent) / exact::round_to_double(exact::BigRational(at_.scale));
  sweep_ = own_sweep_ * unit * (1 - 0x1p-40);
}

void InnerWindow::fill(const SolidPair& pair, StageWatch& watch) {
  cells_.emplace(*at_.space, pair.p, pair.q, across_, watch, own_sweep_);
}

double InnerWindow::moved_to(const PosePair& poses) const {
  return displacement(poses_.p, poses.p, radius_[0]) + displacement(poses_.q, poses.q, radius_[1]);
}

}  // namespace dymsum::spatial
