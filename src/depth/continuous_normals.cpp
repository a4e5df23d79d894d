// A face's plane cuts the ball around x in a disc of squared radius b about the foot of x. In polar coordinates about
// the foot an integral of k(rho^2) over polygon and disc is the sum over directed edges of K(rho) dtheta, K being the
// integral of k(r^2) r dr up to rho, and the one up to the rim outside of the disc. On an edge dtheta = d / rho^2 ds:
// polynomials of s inside the disc, a constant times an angle outside.
#include "depth/continuous_normals.h"

#include <algorithm>
#include <cmath>

namespace dymsum::depth {
namespace {

using spatial::dot;

/// The integrals of (b - rho^2)^2 and b - rho^2 over a face, and of (b - rho^2)^2 along its edges, times their outward
/// directions.
struct FaceIntegrals {
  double square = 0, linear = 0;
  Vec3 rim;
};

/// The angle under which the foot sees the piece of a line at distance d.
double angle_of(double d, double from, double to) { return std::atan2(d * (to - from), d * d + from * to); }

void add_edge(const SurfaceEdge& e, Vec3 to_start, double b, FaceIntegrals& sum) {
  const double s0 = dot(e.along, to_start), s1 = s0 + e.length, d = dot(e.out, to_start), d2 = d * d;
  const double c2 = b - d2, c = c2 > 0 ? std::sqrt(c2) : 0;
  const double low = std::max(s0, -c), high = std::min(s1, c);
  double outside = 0;
  if (low < high) {
    if (s0 < low) outside += angle_of(d, s0, low);
    if (high < s1) outside += angle_of(d, high, s1);
    const double l2 = low * low, h2 = high * high;
    const double one = high - low, three = (high * h2 - low * l2) / 3, five = (high * h2 * h2 - low * l2 * l2) / 5;
    sum.square += d / 6 * ((3 * b * b - 3 * b * d2 + d2 * d2) * one + (2 * d2 - 3 * b) * three + five);
    sum.linear += d / 4 * ((2 * b - d2) * one - three);
    sum.rim = sum.rim + (c2 * c2 * one - 2 * c2 * three + five) * e.out;
  } else outside = angle_of(d, s0, s1);
  sum.square += b * b * b / 6 * outside, sum.linear += b * b / 4 * outside;
}

bool is_beyond(const SurfaceFace& f, Vec3 x, double l) {
  const auto gap = [](double low, double high, double v) { return std::max({low - v, v - high, 0.0}); };
  const double dx = gap(f.low.x, f.high.x, x.x), dy = gap(f.low.y, f.high.y, x.y), dz = gap(f.low.z, f.high.z, x.z);
  return dx * dx + dy * dy + dz * dz >= l * l;
}

}  // namespace

SmoothedNormal smoothed_normal(const ContinuousSurface& s, double l, Vec3 x) {
  SmoothedNormal sum;
  for (const SurfaceFace& f : s.faces) {
    if (is_beyond(f, x, l)) continue;
    const double z = dot(f.normal, x - s.start(s.edges[f.first])), b = l * l - z * z;
    if (b <= 0) continue;
    FaceIntegrals face;
    for (std::uint32_t k = f.first; k < f.last; ++k) add_edge(s.edges[k], s.start(s.edges[k]) - x, b, face);
    sum.value = sum.value + face.square * f.normal;
    const Vec3 slope = -4 * z * face.linear * f.normal - face.rim;
    sum.derivative[0] = sum.derivative[0] + f.normal.x * slope;
    sum.derivative[1] = sum.derivative[1] + f.normal.y * slope;
    sum.derivative[2] = sum.derivative[2] + f.normal.z * slope;
  }
  return sum;
}

}  // namespace dymsum::depth
