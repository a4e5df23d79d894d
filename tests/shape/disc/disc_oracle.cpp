#include "shape/disc/disc_oracle.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace dymsum::oracles {

namespace {

Rational exactly(double v) { return *Rational::of(v); }

/// Of a segment, squared.
Rational squared_distance(Point p, Point q, Point z) {
  const Rational dx = exactly(q.x) - exactly(p.x), dy = exactly(q.y) - exactly(p.y);
  const Rational zx = exactly(z.x) - exactly(p.x), zy = exactly(z.y) - exactly(p.y);
  const Rational along = dx * zx + dy * zy, length = dx * dx + dy * dy;
  if (along.sign() <= 0) return zx * zx + zy * zy;
  if (along >= length) {
    const Rational ex = zx - dx, ey = zy - dy;
    return ex * ex + ey * ey;
  }
  const Rational across = dx * zy - dy * zx;
  return across * across / length;
}

double near_distance(Point p, Point q, Point z) {
  const double dx = q.x - p.x, dy = q.y - p.y, zx = z.x - p.x, zy = z.y - p.y;
  const double length = dx * dx + dy * dy;
  const double t = length > 0 ? std::clamp((dx * zx + dy * zy) / length, 0.0, 1.0) : 0;
  return std::hypot(zx - t * dx, zy - t * dy);
}

template <class Use>
void for_each_edge(const Region& region, const Use& use) {
  const auto ring = [&](const Ring& r) {
    for (std::size_t i = 0; i < r.size(); ++i) use(r[i], r[(i + 1) % r.size()]);
  };
  for (const Part& part : region.parts()) {
    ring(part.outer);
    for (const Ring& hole : part.holes) ring(hole);
  }
}

template <class Number, class Of>
Number to_boundary(const Region& region, bool all, const Of& of) {
  std::optional<Number> least;
  const auto see = [&](Point p, Point q) {
    const Number d = of(p, q);
    if (!least || d < *least) least = d;
  };
  for_each_edge(region, see);
  if (all) {
    for (const Polyline& line : region.polylines())
      for (std::size_t i = 0; i + 1 < line.size(); ++i) see(line[i], line[i + 1]);
    for (const Point& p : region.points()) see(p, p);
  }
  return *least;
}

/// For points that are not near the boundary, or whose distance from it is small either way.
bool near_in_parts(const Region& region, Point z) {
  bool inside = false;
  for_each_edge(region, [&](Point p, Point q) {
    if ((p.y <= z.y) == (q.y <= z.y)) return;
    const double side = (q.x - p.x) * (z.y - p.y) - (q.y - p.y) * (z.x - p.x);
    if ((side > 0) == (q.y > p.y)) inside = !inside;
  });
  return inside;
}

Point on_arc(const DiscPiece& piece, double r, double fraction) {
  const double angle = piece.from_angle + fraction * piece.sweep;
  return {piece.centre.x + r * std::cos(angle), piece.centre.y + r * std::sin(angle)};
}

template <class Use>
void for_each_ring(const DiscSet& set, const Use& use) {
  for (const DiscPart& part : set.parts) {
    use(part.outer, true);
    for (const DiscRing& hole : part.holes) use(hole, false);
  }
}

/// Points along a ring, dense on arcs.
std::vector<Point> traced(const DiscRing& ring, double r) {
  std::vector<Point> points;
  for (const DiscPiece& piece : ring.pieces) {
    if (piece.of == DiscPiece::Of::edge) {
      points.push_back(piece.from.at);
      continue;
    }
    const int steps = 1 + static_cast<int>(std::abs(piece.sweep) * 200);
    for (int i = 0; i < steps; ++i) points.push_back(on_arc(piece, r, double(i) / steps));
  }
  return points;
}

}  // namespace

bool in_parts(const Region& region, Point z) {
  bool on = false, inside = false;
  for_each_edge(region, [&](Point p, Point q) {
    const Rational side = (exactly(q.x) - exactly(p.x)) * (exactly(z.y) - exactly(p.y)) -
                          (exactly(q.y) - exactly(p.y)) * (exactly(z.x) - exactly(p.x));
    if (side.sign() == 0 && std::min(p.x, q.x) <= z.x && z.x <= std::max(p.x, q.x) && std::min(p.y, q.y) <= z.y &&
        z.y <= std::max(p.y, q.y))
      on = true;
    if ((p.y <= z.y) != (q.y <= z.y) && (side.sign() > 0) == (q.y > p.y)) inside = !inside;
  });
  return on || inside;
}

Rational squared_distance(const Region& region, Point z) {
  if (in_parts(region, z)) return {};
  return to_boundary<Rational>(region, true, [&](Point p, Point q) { return squared_distance(p, q, z); });
}
Rational squared_depth(const Region& region, Point z) {
  if (!in_parts(region, z)) return 0;
  return to_boundary<Rational>(region, false, [&](Point p, Point q) { return squared_distance(p, q, z); });
}
double distance(const Region& region, Point z) {
  if (near_in_parts(region, z)) return 0;
  return to_boundary<double>(region, true, [&](Point p, Point q) { return near_distance(p, q, z); });
}
double depth(const Region& region, Point z) {
  if (!near_in_parts(region, z)) return 0;
  return to_boundary<double>(region, false, [&](Point p, Point q) { return near_distance(p, q, z); });
}

int winding(const DiscSet& set, Point z) {
  double angle = 0;
  for_each_ring(set, [&](const DiscRing& ring, bool) {
    const std::vector<Point> points = traced(ring, set.radius);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point a = points[i], b = points[(i + 1) % points.size()];
      const double ax = a.x - z.x, ay = a.y - z.y, bx = b.x - z.x, by = b.y - z.y;
      angle += std::atan2(ax * by - ay * bx, ax * bx + ay * by);
    }
  });
  return static_cast<int>(std::lround(angle / (2 * std::numbers::pi)));
}

std::vector<BoundaryPosition> midpoints(const DiscSet& set) {
  std::vector<BoundaryPosition> positions;
  for_each_ring(set, [&](const DiscRing& ring, bool) {
    for (std::size_t i = 0; i < ring.pieces.size(); ++i) {
      const DiscPiece& piece = ring.pieces[i];
      if (piece.of == DiscPiece::Of::edge) {
        const Point a = piece.from.at, b = ring.pieces[(i + 1) % ring.pieces.size()].from.at;
        positions.push_back({{(a.x + b.x) / 2, (a.y + b.y) / 2},
                             {-std::sin(piece.heading), std::cos(piece.heading)},
                             std::hypot(b.x - a.x, b.y - a.y)});
      } else {
        const Point at = on_arc(piece, set.radius, 0.5);
        const double inwards = (piece.sweep > 0 ? -1 : 1) / set.radius;
        positions.push_back({at,
                             {inwards * (at.x - piece.centre.x), inwards * (at.y - piece.centre.y)},
                             set.radius * std::abs(piece.sweep)});
      }
    }
  });
  return positions;
}

void check_form(const DiscSet& set) {
  const double slack = 16 * set.at_error + 1e-12;
  for_each_ring(set, [&](const DiscRing& ring, bool outer) {
    ASSERT_FALSE(ring.pieces.empty());
    double twice = 0, length = 0;
    for (std::size_t i = 0; i < ring.pieces.size(); ++i) {
      const DiscPiece &piece = ring.pieces[i], &next = ring.pieces[(i + 1) % ring.pieces.size()];
      const Point a = piece.from.at, b = next.from.at;
      if (piece.of == DiscPiece::Of::edge) {
        const double along = (b.x - a.x) * std::cos(piece.heading) + (b.y - a.y) * std::sin(piece.heading);
        const double across = (b.y - a.y) * std::cos(piece.heading) - (b.x - a.x) * std::sin(piece.heading);
        EXPECT_GT(along, -slack);
        EXPECT_NEAR(across, 0, slack) << "segment of edge " << piece.index << " leaves its direction";
      } else if (piece.from.kind != DiscCorner::Kind::none) {
        const Point from = on_arc(piece, set.radius, 0), to = on_arc(piece, set.radius, 1);
        EXPECT_NEAR(std::hypot(from.x - a.x, from.y - a.y), 0, slack) << "arc about " << piece.index << " at its start";
        EXPECT_NEAR(std::hypot(to.x - b.x, to.y - b.y), 0, slack) << "arc about " << piece.index << " at its end";
      }
    }
    const std::vector<Point> points = traced(ring, set.radius);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point a = points[i], b = points[(i + 1) % points.size()];
      twice += (a.x - points[0].x) * (b.y - points[0].y) - (a.y - points[0].y) * (b.x - points[0].x);
      length += std::hypot(b.x - a.x, b.y - a.y);
    }
    // Of slivers as thin as what positions are rounded by the doubles say nothing.
    if (std::abs(twice) > slack * length) {
      EXPECT_EQ(twice > 0, outer);
    }
  });
}

}  // namespace dymsum::oracles
