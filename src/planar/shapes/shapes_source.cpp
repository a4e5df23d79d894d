#include "planar/shapes/shapes_source.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace dymsum::shapes {
namespace {

/// tan x by Lambert's continued fraction x / (1 - x^2 / (3 - x^2 / (5 - ...))). For |x| <= pi/8 the tenth level is
/// below
/// the last bit.
double small_tangent(double x) {
  double below = 21;
  for (int odd = 19; odd >= 1; odd -= 2) below = odd - x * x / below;
  return x / below;
}

Point at_eighth(std::int64_t k, std::int64_t n) {
  const double t = small_tangent(std::numbers::pi * static_cast<double>(k) / static_cast<double>(n));
  return {(1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)};
}

}  // namespace

Point circle_point(std::int64_t k, std::int64_t n) {
  require(n > 0 && k >= 0 && k < n, "circle_point");
  const std::int64_t quarter = 4 * k / n;         // 0..3
  const std::int64_t rest = 4 * k - quarter * n;  // angle in the quarter = rest / 4n of a turn, rest < n
  // Beyond the diagonal the point is the mirror image of the one before it.
  const bool beyond = 2 * rest > n;
  Point p = at_eighth(beyond ? n - rest : rest, 4 * n);
  if (beyond) std::swap(p.x, p.y);
  switch (quarter) {
    case 0:
      return p;
    case 1:
      return {0.0 - p.y, p.x};
    case 2:
      return {0.0 - p.x, 0.0 - p.y};
    default:
      return {p.y, 0.0 - p.x};
  }
}

std::uint64_t Bits::next() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double Bits::unit() { return std::ldexp(static_cast<double>(next() >> 11), -53); }

double on_grid(double x, int bits) { return std::ldexp(std::floor(std::ldexp(x, bits) + 0.5), -bits); }

Ring on_grid(Ring ring, int bits) {
  for (Point& p : ring) p = {on_grid(p.x, bits), on_grid(p.y, bits)};
  return ring;
}

int grid_bits(double size) {
  int exponent = 0;
  std::frexp(size, &exponent);
  return 24 - exponent;
}

void require(bool condition, std::string_view shape) {
  if (!condition) throw std::invalid_argument(std::string(shape) + ": these arguments give no valid region");
}

Region made(std::string_view shape, Ring outer, std::vector<Ring> holes) {
  RegionData data;
  data.parts.push_back({std::move(outer), std::move(holes)});
  Result<Region> region = Region::create(std::move(data));
  if (!region.ok()) throw std::invalid_argument(std::string(shape) + ": " + region.error().to_string());
  return std::move(region).value();
}

Ring smooth(const Ring& outline, int count) {
  const std::size_t n = outline.size();
  std::vector<double> until(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = outline[i], b = outline[(i + 1) % n];
    until[i + 1] = until[i] + std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
  }
  Ring result;
  std::size_t i = 0;
  for (int k = 0; k < count; ++k) {
    const double s = until[n] * k / count;
    while (i + 1 < n && until[i + 1] <= s) ++i;
    const double u = (s - until[i]) / (until[i + 1] - until[i]);
    const Point a = outline[(i + n - 1) % n], b = outline[i], c = outline[(i + 1) % n], d = outline[(i + 2) % n];
    const auto along = [u](double a1, double b1, double c1, double d1) {
      return b1 + 0.5 * u * (c1 - a1 + u * (2 * a1 - 5 * b1 + 4 * c1 - d1 + u * (3 * (b1 - c1) + d1 - a1)));
    };
    result.push_back({along(a.x, b.x, c.x, d.x), along(a.y, b.y, c.y, d.y)});
  }
  return result;
}

Ring mirrored(const Ring& right_half) {
  Ring result = right_half;
  for (auto p = right_half.rbegin(); p != right_half.rend(); ++p) {
    if (p->x != 0) result.push_back({-p->x, p->y});
  }
  return result;
}

Ring scaled_ring(Ring ring, double factor) {
  for (Point& p : ring) p = {factor * p.x, factor * p.y};
  return ring;
}

Ring counter_clockwise(Ring ring) {
  double doubled_area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()];
    doubled_area += a.x * b.y - b.x * a.y;
  }
  if (doubled_area < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

}  // namespace dymsum::shapes
