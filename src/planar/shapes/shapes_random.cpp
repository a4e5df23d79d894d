// The random shapes. Every coordinate is a small integer times a power of two, so growing them needs no rounding.
#include <algorithm>
#include <cmath>

#include "dymsum/shapes.h"
#include "planar/shapes/shapes_source.h"

namespace dymsum::shapes {
namespace {

/// Random polygons grow on the integers in [-2^20, 2^20]; differences fit 22 bits and their cross products 45.
constexpr std::int64_t kHalfWidth = std::int64_t{1} << 20;
constexpr double kUnit = kHalfWidth;

struct Site {
  std::int64_t x, y;
};

int side(Site a, Site b, Site c) {
  const std::int64_t cross = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  return (cross > 0) - (cross < 0);
}

/// Whether closed segments ab and cd have a point in common; also true for all segments on one line.
bool meet_or_touch(Site a, Site b, Site c, Site d) {
  const int abc = side(a, b, c), abd = side(a, b, d), cda = side(c, d, a), cdb = side(c, d, b);
  if (abc == 0 && abd == 0) return true;
  return abc * abd <= 0 && cda * cdb <= 0;
}

/// Whether c lies in the closed triangle abp, whatever its orientation.
bool in_triangle(Site a, Site b, Site p, Site c) {
  const int s = side(a, b, p);
  return s * side(a, b, c) >= 0 && s * side(b, p, c) >= 0 && s * side(p, a, c) >= 0;
}

/// Whether replacing edge i by the two edges over p keeps the ring simple.
bool fits(const std::vector<Site>& ring, std::size_t i, Site p) {
  const std::size_t n = ring.size(), j = (i + 1) % n;
  const Site a = ring[i], b = ring[j];
  if (side(a, b, p) == 0) return false;
  for (std::size_t k = 0; k < n; ++k) {
    if (k == i) continue;
    const Site c = ring[k], d = ring[(k + 1) % n];
    if (k != j && in_triangle(a, b, p, c)) return false;
    if (k != j && meet_or_touch(p, b, c, d)) return false;
    if ((k + 1) % n != i && meet_or_touch(a, p, c, d)) return false;
    // The edges next to edge i share one corner with the triangle: they may not run along its new side.
    if (k == j && side(b, p, d) == 0) return false;
    if ((k + 1) % n == i && side(a, p, c) == 0) return false;
  }
  return true;
}

std::int64_t extent(Site a, Site b) { return std::max(std::llabs(a.x - b.x), std::llabs(a.y - b.y)); }

/// Grows a triangle: a random edge, the longest of a few, is bent over a random position near it when the ring stays
/// simple.
std::vector<Site> grow(int vertices, Bits& bits) {
  std::vector<Site> ring{{-kHalfWidth / 2, -kHalfWidth / 2}, {kHalfWidth / 2, -kHalfWidth / 3}, {0, kHalfWidth / 2}};
  while (static_cast<int>(ring.size()) < vertices) {
    const std::size_t n = ring.size();
    const auto length = [&](std::size_t i) { return extent(ring[i], ring[(i + 1) % n]); };
    std::size_t edge = bits.below(n);
    for (int more = 0; more < 3; ++more) {
      const std::size_t other = bits.below(n);
      if (length(other) > length(edge)) edge = other;
    }
    const Site a = ring[edge], b = ring[(edge + 1) % n];
    const std::int64_t reach = std::max<std::int64_t>(extent(a, b), 8);
    const auto offset = [&] { return static_cast<std::int64_t>(bits.below(2 * reach)) - reach; };
    Site p{(a.x + b.x) / 2 + offset(), (a.y + b.y) / 2 + offset()};
    p = {std::clamp(p.x, -kHalfWidth, kHalfWidth), std::clamp(p.y, -kHalfWidth, kHalfWidth)};
    if (fits(ring, edge, p)) ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(edge + 1), p);
  }
  return ring;
}

bool inside(const Ring& ring, Point z) {
  bool odd = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()];
    if ((a.y > z.y) != (b.y > z.y) && z.x < a.x + (z.y - a.y) / (b.y - a.y) * (b.x - a.x)) odd = !odd;
  }
  return odd;
}

double squared_distance(const Ring& ring, Point z) {
  double least = 1e300;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()];
    const double ex = b.x - a.x, ey = b.y - a.y;
    const double t = std::clamp(((z.x - a.x) * ex + (z.y - a.y) * ey) / (ex * ex + ey * ey), 0.0, 1.0);
    const double dx = a.x + t * ex - z.x, dy = a.y + t * ey - z.y;
    least = std::min(least, dx * dx + dy * dy);
  }
  return least;
}

/// A small clockwise polygon around the roomiest of some random positions inside the part.
Ring hole_in(const Ring& outer, const std::vector<Ring>& holes, Bits& bits) {
  Point best;
  double room = 0;
  for (int attempt = 0; attempt < 200; ++attempt) {
    const Point z{bits.between(-1, 1), bits.between(-1, 1)};
    if (!inside(outer, z)) continue;
    double least = squared_distance(outer, z);
    for (const Ring& hole : holes) least = inside(hole, z) ? 0 : std::min(least, squared_distance(hole, z));
    if (least > room) {
      room = least;
      best = z;
    }
  }
  const double radius = 0.75 * std::sqrt(room);
  Ring hole;
  const auto corners = static_cast<std::int64_t>(5 + bits.below(5));
  for (std::int64_t k = corners - 1; k >= 0; --k) {
    const Point p = circle_point(k, corners);
    const double r = radius * bits.between(0.5, 1);
    hole.push_back({best.x + r * p.x, best.y + r * p.y});
  }
  return on_grid(std::move(hole), 24);
}

}  // namespace

Region noisy_star(int vertices, double noise, std::uint64_t seed) {
  require(vertices >= 3 && noise >= 0 && noise < 1, "noisy_star");
  Bits bits(seed);
  Ring ring;
  for (int k = 0; k < vertices; ++k) {
    const Point p = circle_point(k, vertices);
    const double radius = 1 - noise * bits.unit();
    ring.push_back({radius * p.x, radius * p.y});
  }
  return made("noisy_star", on_grid(std::move(ring), 24));
}

Region random_polygon(int vertices, int holes, std::uint64_t seed) {
  require(vertices >= 3 && holes >= 0, "random_polygon");
  Bits bits(seed);
  Ring outer;
  for (const Site s : grow(vertices, bits)) {
    outer.push_back({static_cast<double>(s.x) / kUnit, static_cast<double>(s.y) / kUnit});
  }
  outer = counter_clockwise(std::move(outer));
  std::vector<Ring> inner;
  for (int i = 0; i < holes; ++i) inner.push_back(hole_in(outer, inner, bits));
  return made("random_polygon", std::move(outer), std::move(inner));
}

}  // namespace dymsum::shapes
