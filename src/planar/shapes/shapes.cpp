// The regular shapes: plates, wheels, combs, letters.
#include "dymsum/shapes.h"

#include <algorithm>
#include <cmath>

#include "planar/shapes/shapes_source.h"
#include "planar/shapes/snap.h"

namespace dymsum::shapes {
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

}  // namespace dymsum::shapes
