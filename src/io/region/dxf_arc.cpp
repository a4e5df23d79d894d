#include "io/region/dxf_arc.h"

#include <cmath>
#include <numbers>

namespace dymsum::io {
namespace {

constexpr double kRadian = std::numbers::pi / 180;

/// The angle in [0, 360), exactly.
double within_a_turn(double degrees) {
  const double rest = std::fmod(degrees, 360.0);
  return rest < 0 ? rest + 360 : rest;
}

}  // namespace

Point direction(double degrees) {
  const double angle = within_a_turn(degrees);
  if (angle == 0 || angle == 360) return {1, 0};
  if (angle == 90) return {0, 1};
  if (angle == 180) return {-1, 0};
  if (angle == 270) return {0, -1};
  return {std::cos(angle * kRadian), std::sin(angle * kRadian)};
}

Point on_circle(Point centre, double radius, double degrees) {
  const Point d = direction(degrees);
  return {centre.x + radius * d.x, centre.y + radius * d.y};
}

// The centre lies on the chord's bisector, (1 / b - b) / 4 chords to its left.
EllipseArc bulge_arc(Point from, Point to, double b) {
  const double dx = to.x - from.x, dy = to.y - from.y, height = (1 / b - b) / 4;
  const Point u{dy * height - dx / 2, -dx * height - dy / 2};
  return {from, u, {-u.y, u.x}, 4 * std::atan(b)};
}

std::optional<EllipseArc> degree_arc(Point centre, double radius, double from_degrees, double to_degrees) {
  const double from = within_a_turn(from_degrees);
  double sweep = within_a_turn(to_degrees) - from;
  if (sweep == 0) return std::nullopt;
  if (sweep < 0) sweep += 360;
  const Point d = direction(from);
  const Point u{radius * d.x, radius * d.y};
  return EllipseArc{on_circle(centre, radius, from), u, {-u.y, u.x}, sweep * kRadian};
}

ChordChain ellipse_ring(Point centre, Point u, Point v, const CurveOptions& options) {
  const Point axes[] = {u, v, {-u.x, -u.y}, {-v.x, -v.y}};
  ChordChain ring;
  ring.add({centre.x + u.x, centre.y + u.y});
  for (int k = 0; k < 4; ++k) {
    const Point from = axes[k], to = axes[(k + 1) % 4];
    append_arc(ring, {ring.back(), from, to, std::numbers::pi / 2}, {centre.x + to.x, centre.y + to.y}, options);
  }
  ring.pop_back();
  ring.curves = 1;
  return ring;
}

}  // namespace dymsum::io
