#include "planar/shapes/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "dymsum/shapes.h"

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

// The regular shapes: plates, wheels, combs, letters.

namespace {

Ring box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

Ring reversed(Ring ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

Point on_circle(std::int64_t k, std::int64_t n, double radius) {
  const Point p = circle_point(k, n);
  return {radius * p.x, radius * p.y};
}

Ring snapped(std::string_view shape, Ring ring, double snap) {
  const Snap to(shape, snap);
  for (Point& p : ring) p = {to(p.x), to(p.y)};
  return ring;
}

}  // namespace

double demo_snap(double size) { return std::ldexp(1, -grid_bits(size)); }

Region rectangle(double x0, double y0, double x1, double y1) { return made("rectangle", box(x0, y0, x1, y1)); }

Region disc(int vertices, double radius, double snap) {
  require(vertices >= 3 && radius > 0, "disc");
  Ring ring;
  for (int k = 0; k < vertices; ++k) ring.push_back(on_circle(k, vertices, radius));
  return made("disc", snapped("disc", std::move(ring), snap));
}

Region gear(int teeth, double inner, double outer, double snap) {
  require(teeth >= 3 && inner > 0 && outer > inner, "gear");
  Ring ring;
  for (int k = 0; k < 4 * teeth; ++k) {
    const bool top = k % 4 == 1 || k % 4 == 2;
    ring.push_back(on_circle(k, 4 * teeth, top ? outer : inner));
  }
  return made("gear", snapped("gear", std::move(ring), snap));
}

Region grate(int bars, double pitch, double bar, double length) {
  require(bars >= 2 && bar > 0 && pitch > bar && length > 2 * bar, "grate");
  std::vector<Ring> holes;
  for (int i = 0; i + 1 < bars; ++i) {
    holes.push_back(reversed(box(i * pitch + bar, bar, (i + 1) * pitch, length - bar)));
  }
  return made("grate", box(0, 0, (bars - 1) * pitch + bar, length), std::move(holes));
}

Region comb(int teeth, double pitch, double tooth, double length) {
  require(teeth >= 2 && tooth > 0 && pitch > tooth && length > 0, "comb");
  Ring ring{{0, -tooth}, {(teeth - 1) * pitch + tooth, -tooth}};
  for (int i = teeth - 1; i >= 0; --i) {
    const double left = i * pitch, right = left + tooth;
    if (i < teeth - 1) ring.push_back({right, 0});
    ring.push_back({right, length});
    ring.push_back({left, length});
    if (i > 0) ring.push_back({left, 0});
  }
  return made("comb", std::move(ring));
}

Region star(int points, double inner, double outer, double snap) {
  require(points >= 2 && inner > 0 && outer > inner, "star");
  Ring ring;
  for (int k = 0; k < 2 * points; ++k) ring.push_back(on_circle(k, 2 * points, k % 2 == 0 ? outer : inner));
  return made("star", snapped("star", std::move(ring), snap));
}

Region spiral(int turns, int vertices_per_turn, double pitch, double width, double snap) {
  require(turns >= 1 && vertices_per_turn >= 5 && width > 0 && pitch > width, "spiral");
  Ring outer, inner;
  const int n = vertices_per_turn;
  for (int k = 0; k <= turns * n; ++k) {
    const double radius = pitch * (0.5 + static_cast<double>(k) / n);
    outer.push_back(on_circle(k % n, n, radius + width));
    inner.push_back(on_circle(k % n, n, radius));
  }
  outer.insert(outer.end(), inner.rbegin(), inner.rend());
  return made("spiral", snapped("spiral", std::move(outer), snap));
}

Region letter_u(double width, double height, double thickness) {
  require(thickness > 0 && width > 2 * thickness && height > thickness, "letter_u");
  const double t = thickness, w = width, h = height;
  return made("letter_u", {{0, 0}, {w, 0}, {w, h}, {w - t, h}, {w - t, t}, {t, t}, {t, h}, {0, h}});
}

Region letter_l(double width, double height, double thickness) {
  require(thickness > 0 && width > thickness && height > thickness, "letter_l");
  const double t = thickness;
  return made("letter_l", {{0, 0}, {width, 0}, {width, t}, {t, t}, {t, height}, {0, height}});
}

Region pockets(int holes, double size, double snap) {
  require(holes >= 1 && size > 0, "pockets");
  // A plate of square cells as near to a square as the number allows; hole i fills (i + 1) / (holes + 1) of its cell.
  int columns = 1;
  while (columns * columns < holes) ++columns;
  const int rows = (holes + columns - 1) / columns;
  const double cell = size / columns;
  const Snap to("pockets", snap);
  std::vector<Ring> squares;
  for (int i = 0; i < holes; ++i) {
    const double half = to(cell * (i + 1) / (2 * (holes + 1)));
    const double x = to((i % columns + 0.5) * cell), y = to((i / columns + 0.5) * cell);
    squares.push_back(reversed(box(x - half, y - half, x + half, y + half)));
  }
  return made("pockets", box(0, 0, to(size), to(rows * cell)), std::move(squares));
}

// The random shapes. Every coordinate is a small integer times a power of two, so growing them needs no rounding.

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
