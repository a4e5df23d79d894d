#include "io/region/dxf_arc.h"

#include <cmath>
#include <numbers>

namespace dymsum::io {
namespace {

int steps_of(double radians) { return std::max(1, static_cast<int>(std::ceil(std::abs(radians) * kArcSteps))); }

/// The angle in [0, 360), exactly.
double within_a_turn(double degrees) {
  const double rest = std::fmod(degrees, 360.0);
  return rest < 0 ? rest + 360 : rest;
}

Point direction(double degrees) {
  const double angle = within_a_turn(degrees);
  if (angle == 0 || angle == 360) return {1, 0};
  if (angle == 90) return {0, 1};
  if (angle == 180) return {-1, 0};
  if (angle == 270) return {0, -1};
  const double radians = angle * (std::numbers::pi / 180);
  return {std::cos(radians), std::sin(radians)};
}

Point on_circle(Point centre, double radius, double degrees) {
  const Point d = direction(degrees);
  return {centre.x + radius * d.x, centre.y + radius * d.y};
}

}  // namespace

// The chord to the fraction t of an arc of the angle a has sin(t a / 2) / sin(a / 2) of the whole chord's length, and
// is turned from it by (1 - t) a / 2 clockwise. sin(a / 2) = 2 b / (1 + b^2).
void append_bulge(std::vector<Point>& chain, Point from, Point to, double b) {
  if (b == 0 || from == to) return;
  const double half = 2 * std::atan(b), over_sine = (1 / b + b) / 2;
  const int steps = steps_of(2 * half);
  for (int k = 1; k < steps; ++k) {
    const double t = static_cast<double>(k) / steps, ratio = std::sin(t * half) * over_sine, turn = (1 - t) * half;
    const double c = ratio * std::cos(turn), s = ratio * std::sin(turn), dx = to.x - from.x, dy = to.y - from.y;
    chain.push_back({from.x + (c * dx + s * dy), from.y + (c * dy - s * dx)});
  }
}

std::vector<Point> arc_chain(Point centre, double radius, double from_degrees, double to_degrees) {
  const double from = within_a_turn(from_degrees);
  double sweep = within_a_turn(to_degrees) - from;
  if (sweep == 0) return {};
  if (sweep < 0) sweep += 360;
  const int steps = steps_of(sweep * (std::numbers::pi / 180));
  std::vector<Point> chain;
  for (int k = 0; k < steps; ++k) chain.push_back(on_circle(centre, radius, from + sweep * k / steps));
  chain.push_back(on_circle(centre, radius, to_degrees));
  return chain;
}

Ring circle_ring(Point centre, double radius) {
  constexpr int kSteps = 76;  // 2 pi 12 = 75.4; a multiple of 4 has the exact extreme points
  static_assert(kSteps >= 2 * std::numbers::pi * kArcSteps);
  Ring ring;
  for (int k = 0; k < kSteps; ++k) ring.push_back(on_circle(centre, radius, 360.0 * k / kSteps));
  return ring;
}

}  // namespace dymsum::io
