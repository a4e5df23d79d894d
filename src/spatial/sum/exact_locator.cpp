#include "spatial/sum/exact_locator.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "spatial/sum/vertex_signs.h"

namespace dymsum::spatial {

using exact::BigRational;

namespace {

using Vector = std::array<BigRational, 3>;

Vector difference(const ExactPosition& a, const ExactPosition& b) {
  return {BigRational(a[0] - b[0]), BigRational(a[1] - b[1]), BigRational(a[2] - b[2])};
}
BigRational dot_of(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross_of(const Vector& a, const Vector& b) {
  return {BigRational(a[1] * b[2] - a[2] * b[1]), BigRational(a[2] * b[0] - a[0] * b[2]),
          BigRational(a[0] * b[1] - a[1] * b[0])};
}
Vector normal_of(const ExactTriangle& t) { return cross_of(difference(t[1], t[0]), difference(t[2], t[0])); }

Vec3 near(const ExactPosition& x) {
  return {exact::round_to_double(x[0]), exact::round_to_double(x[1]), exact::round_to_double(x[2])};
}

/// The side of the line from a to b on which x lies, seen along z, x being moved by an infinitesimal along x and a
/// smaller one along y; 0 where the line is a point.
int side_along_z(const ExactPosition& a, const ExactPosition& b, const ExactPosition& x) {
  const BigRational ux = b[0] - a[0], uy = b[1] - a[1];
  const BigRational area = ux * (x[1] - a[1]) - uy * (x[0] - a[0]);
  if (area.sign() != 0) return area.sign();
  return uy.sign() != 0 ? -uy.sign() : ux.sign();
}

/// Whether the triangle lies above x, which is not on it, after that movement.
bool is_above(const ExactPosition& x, const ExactTriangle& t) {
  const int side = side_along_z(t[0], t[1], x);
  if (side == 0 || side_along_z(t[1], t[2], x) != side || side_along_z(t[2], t[0], x) != side) return false;
  const Vector n = normal_of(t);
  return dot_of(n, difference(x, t[0])).sign() * n[2].sign() < 0;
}

}  // namespace

int lexicographic_order(const ExactPosition& x, const ExactPosition& y) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (const int order = x[axis].compare(y[axis])) return order < 0 ? -1 : 1;
  return 0;
}

ExactPosition position_between(const ExactPosition& a, const ExactPosition& b, const BigRational& t) {
  ExactPosition at;
  for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = a[axis] + t * (b[axis] - a[axis]);
  return at;
}

bool lies_on_segment(const ExactPosition& a, const ExactPosition& b, const ExactPosition& x) {
  if (a == b) return x == a;
  const Vector along = difference(b, a), gap = difference(x, a);
  for (const BigRational& c : cross_of(along, gap))
    if (c.sign() != 0) return false;
  const BigRational far = dot_of(along, gap);
  return far.sign() >= 0 && far <= dot_of(along, along);
}

bool lies_on(const ExactPosition& x, const ExactTriangle& triangle) {
  const Vector n = normal_of(triangle);
  if (dot_of(n, difference(x, triangle[0])).sign() != 0) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const ExactPosition &a = triangle[k], &b = triangle[(k + 1) % 3];
    if (dot_of(cross_of(difference(b, a), difference(x, a)), n).sign() < 0) return false;
  }
  return true;
}

ExactLocator::ExactLocator(const SpatialSum& sum) {
  for (const Triangle& t : triangulated(sum).triangles) add(sum, t);
  first_tight_ = triangles_.size();
  for (const auto& t : sum.tight_triangles()) add(sum, t);
  make_tree();
}

ExactLocator::ExactLocator(std::vector<ExactTriangle> triangles, std::size_t first_tight)
    : triangles_(std::move(triangles)), first_tight_(first_tight) {
  make_tree();
}

void ExactLocator::make_tree() {
  std::vector<Box> boxes;
  double largest = 0;
  for (const ExactTriangle& t : triangles_) {
    Box& box = boxes.emplace_back();
    for (const ExactPosition& corner : t) box.add(near(corner));
    for (const double c : {box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z})
      largest = std::max(largest, std::abs(c));
  }
  slack_ = largest * 0x1p-50 + 0x1p-1000;
  tree_ = BoxTree(std::move(boxes));
}

void ExactLocator::add(const SpatialSum& sum, const std::array<std::uint32_t, 3>& triangle) {
  const SpatialPositions& positions = SpatialSumInternals::positions(sum);
  triangles_.push_back({positions.at(triangle[0]), positions.at(triangle[1]), positions.at(triangle[2])});
}

Box ExactLocator::box_around(const ExactPosition& x) const {
  Box box;
  const Vec3 at = near(x);
  box.add(at);
  box.grow(slack_ + 0x1p-50 * std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}));
  return box;
}

ExactLocator::Where ExactLocator::of(const ExactPosition& x) const {
  Box ray = box_around(x);
  ray.high.z = 1e300;
  bool on = false, inside = false;
  tree_.for_each(ray, [&](std::uint32_t t) {
    if (on || t >= first_tight_) return;
    if (lies_on(x, triangles_[t])) on = true;
    else if (is_above(x, triangles_[t])) inside = !inside;
  });
  return on ? Where::boundary : inside ? Where::inside : Where::outside;
}

bool ExactLocator::on_tight_face(const ExactPosition& x) const {
  bool on = false;
  tree_.for_each(box_around(x), [&](std::uint32_t t) { on = on || (t >= first_tight_ && lies_on(x, triangles_[t])); });
  return on;
}

std::vector<BigRational> ExactLocator::cuts(const ExactPosition& from, const ExactPosition& to) const {
  std::vector<BigRational> all;
  const Vector along = difference(to, from);
  const auto cut = [&](const Vector& normal, const ExactPosition& at) {  // by a plane
    const BigRational rise = dot_of(normal, along);
    if (rise.sign() == 0) return false;
    const BigRational t = dot_of(normal, difference(at, from)) / rise;
    if (t > 0 && t < 1) all.push_back(t);
    return true;
  };
  Box box = box_around(from);
  box.add(box_around(to));
  tree_.for_each(box, [&](std::uint32_t k) {
    const ExactTriangle& t = triangles_[k];
    const Vector n = normal_of(t);
    if (cut(n, t[0])) return;
    // It runs along the plane: what ends there are the triangle's sides.
    for (std::size_t c = 0; c < 3; ++c) cut(cross_of(n, difference(t[(c + 1) % 3], t[c])), t[c]);
  });
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace dymsum::spatial
