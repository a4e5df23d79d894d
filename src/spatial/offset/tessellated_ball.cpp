#include <algorithm>
#include <cmath>
#include <limits>

#include "dymsum/solid_erosion.h"
#include "dymsum/solid_offset.h"
#include "dymsum/solids.h"
#include "exact/big.h"
#include "spatial/mesh/vec3.h"

namespace dymsum {
namespace {

using exact::BigRational;
using spatial::Vec3;

constexpr int kFinest = 96;  // 184320 facets

Vec3 vec(const Point3& p) { return {p.x, p.y, p.z}; }

/// The distance of a geodesic sphere's nearest face from the origin, its radius being 1, in doubles.
double nearest_face(const Mesh& sphere) {
  double nearest = 1;
  for (const Face& f : sphere.faces()) {
    const Vec3 a = vec(sphere.vertices()[f[0]]), b = vec(sphere.vertices()[f[1]]), c = vec(sphere.vertices()[f[2]]);
    const Vec3 n = cross(b - a, c - a);
    nearest = std::min(nearest, dot(n, a) / length(n));
  }
  return nearest;
}

double root(const BigRational& square, double factor) { return std::sqrt(exact::round_to_double(square)) * factor; }

/// The radii between which the surface lies, from exact squares, each rounded outward.
void measure(TessellatedBall& ball) {
  std::vector<std::array<BigRational, 3>> at;
  BigRational farthest = 0;
  for (const Point3& p : ball.mesh.vertices()) {
    at.push_back({exact::exact_value(p.x), exact::exact_value(p.y), exact::exact_value(p.z)});
    const auto& v = at.back();
    farthest = std::max(farthest, BigRational(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
  }
  BigRational nearest = farthest;
  for (const Face& f : ball.mesh.faces()) {
    const auto &a = at[f[0]], &b = at[f[1]], &c = at[f[2]];
    BigRational height = 0, square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      const BigRational n = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
      height += n * a[i];
      square += n * n;
    }
    nearest = std::min(nearest, BigRational(height * height / square));
  }
  // A rounding to a double, a root, and a product.
  ball.low = root(nearest, 1 - 0x1p-50);
  ball.high = root(farthest, 1 + 0x1p-50);
}

Error out_of_range(const char* message) { return {ErrorCode::out_of_range, message, {}}; }

}  // namespace

Result<TessellatedBall> tessellated_ball(double radius, double tolerance, OffsetBound bound) {
  if (!(radius >= 0x1p-300 && radius <= 0x1p300)) return out_of_range("the radius of a ball is from 2^-300 to 2^300");
  if (!(tolerance >= radius * 0x1p-14 && tolerance < std::numeric_limits<double>::infinity()))
    return out_of_range("the tolerance of a ball is at least 2^-14 of its radius");
  // Coordinates are rounded to multiples of a 32nd of the tolerance: no point moves by more than 0.87 of that.
  const double unit = std::ldexp(1.0, std::ilogb(std::min(tolerance, radius)) - 5);
  for (int frequency = 1; frequency <= kFinest; ++frequency) {
    const Mesh sphere = solids::geodesic_sphere(frequency, 1, solids::kDemoSnap);
    // Its own vertices are multiples of 2^-20, off by less than 2^-19.
    const double face = nearest_face(sphere) - 0x1p-18;
    const double size = bound == OffsetBound::inside ? (radius - 2 * unit) / (1 + 0x1p-18) : (radius + 2 * unit) / face;
    if (size * (1 + 0x1p-18 - face) + 3 * unit > tolerance) continue;
    std::vector<Point3> points;
    const auto rounded = [&](double c) { return std::round(c * size / unit) * unit; };
    for (const Point3& v : sphere.vertices()) points.push_back({rounded(v.x), rounded(v.y), rounded(v.z)});
    Result<Mesh> hull = convex_hull(points);
    if (!hull) return hull.error();
    TessellatedBall ball{*std::move(hull), 0, 0};
    measure(ball);
    return ball;
  }
  return out_of_range("the tolerance of a ball is too small");
}

Result<SolidOffset> offset(const SpatialOperand& set, double distance, double tolerance, OffsetBound bound,
                           const SpatialOptions& options) {
  if (distance == 0) return out_of_range("an offset by 0 is the solid itself");
  const bool inward = distance < 0;
  // What is outside of the ball's complement is inside of the offset.
  const bool small = (bound == OffsetBound::inside) != inward;
  const Result<TessellatedBall> ball =
      tessellated_ball(std::abs(distance), tolerance, small ? OffsetBound::inside : OffsetBound::outside);
  if (!ball) return ball.error();
  Result<SpatialSum> solid = inward ? erode(set, ball->mesh, options) : minkowski_sum(set, ball->mesh, options);
  if (!solid) return solid.error();
  return SolidOffset{*std::move(solid), inward ? -ball->high : ball->low, inward ? -ball->low : ball->high,
                     ball->mesh.faces().size()};
}

}  // namespace dymsum
