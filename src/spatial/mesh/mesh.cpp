// What a mesh reports about itself, and moving meshes.
#include "dymsum/rotation.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <string>

#include "base/doubles.h"
#include "dymsum/mesh.h"
#include "dymsum/volume_text.h"
#include "exact/big.h"
#include "exact/int.h"
#include "spatial/mesh/mesh_canonical.h"
#include "spatial/mesh/mesh_orient.h"
#include "spatial/mesh/mesh_validate.h"

namespace dymsum::spatial {
namespace {

// A double and a power of two: measures that may lie outside the range of doubles.

struct ScaledNumber {
  double value = 0;
  int exponent = 0;

  /// The nearest double, where the value is not subnormal.
  double nearest() const { return std::ldexp(value, exponent); }
  /// 17 digits.
  std::string text() const {
    const exact::BigInteger power = exact::BigInteger(1) << static_cast<unsigned>(std::abs(exponent));
    const exact::BigRational v = exact::exact_value(value);
    return exact::decimal_text(exponent < 0 ? exact::BigRational(v / power) : exact::BigRational(v * power), 17);
  }
};

}  // namespace
}  // namespace dymsum::spatial

namespace dymsum {

// What a mesh reports about itself, and moving meshes.

namespace {

/// Every vertex through f; with `reverse`, faces run the other way round from the same first vertex.
template <class F>
MeshData mapped(const Mesh& mesh, F f, bool reverse) {
  MeshData data = mesh.data();
  std::transform(data.vertices.begin(), data.vertices.end(), data.vertices.begin(), f);
  if (!reverse) return data;
  for (Face& face : data.faces) std::reverse(face.begin() + 1, face.end());
  return data;
}

/// Validated as the mesh was.
Result<Mesh> checked_like(const Mesh& mesh, MeshData data) {
  return mesh.has_thin_parts() ? Mesh::with_thin_parts(std::move(data)) : Mesh::create(std::move(data));
}

/// Twice the area of a face whose coordinates are at most 1 in magnitude.
double doubled_area(const std::vector<Point3>& vertices, const Face& face, int exponent) {
  const auto from_first = [&](std::uint32_t v) {
    const Point3 &p = vertices[v], &first = vertices[face[0]];
    const auto unit = [exponent](double a, double b) { return std::scalbn(a, -exponent) - std::scalbn(b, -exponent); };
    return Point3{unit(p.x, first.x), unit(p.y, first.y), unit(p.z, first.z)};
  };
  if (face.size() < 3) return 0;
  Point3 sum, a = from_first(face[1]);
  for (std::size_t i = 2; i < face.size(); ++i) {
    const Point3 b = from_first(face[i]);
    sum = {sum.x + (a.y * b.z - a.z * b.y), sum.y + (a.z * b.x - a.x * b.z), sum.z + (a.x * b.y - a.y * b.x)};
    a = b;
  }
  return base::hypot3(sum.x, sum.y, sum.z);
}

spatial::ScaledNumber surface_of(const Mesh& mesh) {
  double largest = 0;
  for (const double v : bounds(mesh)) largest = std::max(largest, std::abs(v));
  if (largest == 0) return {};
  // a power of two keeps products within the double range
  const int exponent = std::ilogb(largest) + 1;
  double doubled = 0;
  for (const Face& face : mesh.faces()) doubled += doubled_area(mesh.vertices(), face, exponent);
  return {doubled / 2, 2 * exponent};
}

}  // namespace

std::size_t Mesh::edge_count() const {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const Face& face : faces()) {
    for (std::size_t k = 0; face.size() > 1 && k < face.size(); ++k)
      pairs.push_back(std::minmax(face[k], face[(k + 1) % face.size()]));
  }
  std::sort(pairs.begin(), pairs.end());
  return static_cast<std::size_t>(std::unique(pairs.begin(), pairs.end()) - pairs.begin());
}

std::size_t Mesh::triangle_count() const {
  std::size_t count = 0;
  for (const Face& face : faces()) count += std::max<std::size_t>(face.size(), 2) - 2;
  return count;
}

double volume(const Mesh& mesh) { return exact::round_to_double(spatial::exact_volume(spatial::solid_part(mesh))); }

double surface_area(const Mesh& mesh) { return surface_of(mesh).nearest(); }

std::string volume_text(const Mesh& mesh) {
  return exact::decimal_text(spatial::exact_volume(spatial::solid_part(mesh)), 17);
}

std::string surface_text(const Mesh& mesh) { return surface_of(mesh).text(); }

std::array<double, 6> bounds(const Mesh& mesh) {
  if (mesh.empty()) return {};
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Point3 low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (const Point3& p : mesh.vertices()) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  // Zero has no sign.
  return {low.x + 0.0, low.y + 0.0, low.z + 0.0, high.x + 0.0, high.y + 0.0, high.z + 0.0};
}

Mesh negated(const Mesh& mesh) {
  // Subtracting from zero leaves no negative zeros. A reflection through a point turns every face over.
  const auto reflect = [](const Point3& p) { return Point3{0 - p.x, 0 - p.y, 0 - p.z}; };
  return spatial::trusted_mesh(mapped(mesh, reflect, true), mesh.shell_count(), mesh.thin_faces());
}

Result<Mesh> translated(const Mesh& mesh, double dx, double dy, double dz) {
  return checked_like(mesh, mapped(
                                mesh,
                                [=](const Point3& p) {
                                  return Point3{p.x + dx, p.y + dy, p.z + dz};
                                },
                                false));
}

Result<Mesh> scaled(const Mesh& mesh, double sx, double sy, double sz) {
  for (const double s : {sx, sy, sz}) {
    if (std::isfinite(s) && s != 0) continue;
    return Error{ErrorCode::unsupported_operand, "a scale factor is zero or not finite", {}};
  }
  const bool reflects = (sx < 0) != ((sy < 0) != (sz < 0));
  return checked_like(mesh, mapped(
                                mesh,
                                [=](const Point3& p) {
                                  return Point3{p.x * sx, p.y * sy, p.z * sz};
                                },
                                reflects));
}

namespace {

using exact::i128;
constexpr std::int64_t kMost = std::int64_t{1} << Rotation::kBits;

// Half turns have two quaternions of opposite sign like all rotations: the first component that is not zero is made
// positive.
void make_leading_positive(std::array<i128, 4>& q) {
  for (const i128 c : q) {
    if (c == 0) continue;
    if (c < 0)
      for (i128& d : q) d = -d;
    return;
  }
}

i128 magnitude(const std::array<i128, 4>& q) {
  i128 most = 0;
  for (const i128 c : q) most = std::max(most, c < 0 ? -c : c);
  return most;
}

i128 gcd(i128 a, i128 b) {
  while (b != 0) {
    const i128 r = a % b;
    a = b;
    b = r;
  }
  return a < 0 ? -a : a;
}

void reduce(std::array<i128, 4>& q) {
  i128 d = 0;
  for (const i128 c : q) d = gcd(d, c);
  if (d > 1)
    for (i128& c : q) c /= d;
}

// Rounds to components of at most kMost: each changes by at most one half after a scaling that keeps the direction.
std::array<i128, 4> rounded(std::array<i128, 4> q) {
  const i128 most = magnitude(q);
  if (most <= kMost) return q;
  for (i128& c : q) {
    const bool negative = c < 0;
    // |c| <= most < 2^64 here: products of two quaternions have components of at most 2^62.
    const i128 scaled = ((negative ? -c : c) * kMost + most / 2) / most;
    c = negative ? -scaled : scaled;
  }
  reduce(q);
  return q;
}

Result<Rotation> make(std::array<i128, 4> q) {
  make_leading_positive(q);
  return Rotation::of(static_cast<std::int64_t>(q[0]), static_cast<std::int64_t>(q[1]), static_cast<std::int64_t>(q[2]),
                      static_cast<std::int64_t>(q[3]));
}

}  // namespace

Result<Rotation> Rotation::of(std::int64_t w, std::int64_t x, std::int64_t y, std::int64_t z) {
  std::array<i128, 4> q{w, x, y, z};
  if (magnitude(q) == 0) return Error{ErrorCode::bad_rotation, "a quaternion of zeros is no rotation", {}};
  reduce(q);
  if (magnitude(q) > kMost) return Error{ErrorCode::bad_rotation, "a component of the quaternion is beyond 2^30", {}};
  make_leading_positive(q);
  Rotation r;
  for (int i = 0; i < 4; ++i) r.q_[i] = static_cast<std::int64_t>(q[i]);
  return r;
}

Result<Rotation> Rotation::nearest(double w, double x, double y, double z) {
  const double most = std::max({std::abs(w), std::abs(x), std::abs(y), std::abs(z)});
  const std::array<double, 4> d{w, x, y, z};
  if (!(most > 0) || !std::all_of(d.begin(), d.end(), [](double c) { return std::isfinite(c); }))
    return Error{ErrorCode::bad_rotation, "a rotation needs finite numbers that are not all zero", {}};
  std::array<i128, 4> q;
  for (int i = 0; i < 4; ++i)
    q[i] = static_cast<std::int64_t>(std::nearbyint(d[i] / most * static_cast<double>(kMost)));
  reduce(q);
  return make(q);
}

Result<Rotation> Rotation::about(Point3 axis, double radians) {
  const double most = std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)});
  if (!(most > 0) || !std::isfinite(axis.x) || !std::isfinite(axis.y) || !std::isfinite(axis.z) ||
      !std::isfinite(radians))
    return Error{ErrorCode::bad_rotation, "a rotation needs an axis that is not zero, and finite numbers", {}};
  const double x = axis.x / most, y = axis.y / most, z = axis.z / most;
  const double c = std::cos(radians / 2), s = std::sin(radians / 2) / std::sqrt(x * x + y * y + z * z);
  return nearest(c, s * x, s * y, s * z);
}

Rotation operator*(const Rotation& a, const Rotation& b) {
  const auto [aw, ax, ay, az] = std::array<i128, 4>{a.q_[0], a.q_[1], a.q_[2], a.q_[3]};
  const auto [bw, bx, by, bz] = std::array<i128, 4>{b.q_[0], b.q_[1], b.q_[2], b.q_[3]};
  std::array<i128, 4> q{aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by,
                        aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw};
  reduce(q);
  return *make(rounded(q));
}

Rotation Rotation::inverse() const { return *of(q_[0], -q_[1], -q_[2], -q_[3]); }

std::array<std::int64_t, 9> Rotation::matrix() const {
  const auto [w, x, y, z] = q_;
  return {w * w + x * x - y * y - z * z, 2 * (x * y - w * z),           2 * (x * z + w * y),
          2 * (x * y + w * z),           w * w - x * x + y * y - z * z, 2 * (y * z - w * x),
          2 * (x * z - w * y),           2 * (y * z + w * x),           w * w - x * x - y * y + z * z};
}

std::int64_t Rotation::norm() const {
  const auto [w, x, y, z] = q_;
  return w * w + x * x + y * y + z * z;
}

double Rotation::angle() const {
  const double v =
      std::sqrt(double(q_[1]) * double(q_[1]) + double(q_[2]) * double(q_[2]) + double(q_[3]) * double(q_[3]));
  return 2 * std::atan2(v, std::abs(double(q_[0])));
}

}  // namespace dymsum
