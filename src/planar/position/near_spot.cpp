#include "planar/position/near_spot.h"

#include "exact/orient.h"

namespace dymsum::planar {
namespace {

Spot spot_of(const NearSpot& s) { return s.exact == nullptr ? make_spot(s.at) : Spot{*s.exact, s.at}; }

int compare_near(double a, int off_a, double b, int off_b) {
  if (a != b) return a < b ? -1 : 1;
  return (off_a > off_b) - (off_a < off_b);
}

}  // namespace

NearSpot near_spot(Position p, std::deque<Position>& kept) {
  NearSpot s;
  s.at = {exact::round_to_double(p.x), exact::round_to_double(p.y)};
  s.off_x = static_cast<std::int8_t>(compare(p.x, exact::exact_value(s.at.x)));
  s.off_y = static_cast<std::int8_t>(compare(p.y, exact::exact_value(s.at.y)));
  if (s.off_x != 0 || s.off_y != 0) s.exact = &kept.emplace_back(std::move(p));
  return s;
}

int compare_x(const NearSpot& a, const NearSpot& b) {
  const int order = compare_near(a.at.x, a.off_x, b.at.x, b.off_x);
  return order != 0 || a.off_x == 0 ? order : compare(a.exact->x, b.exact->x);
}

int compare_y(const NearSpot& a, const NearSpot& b) {
  const int order = compare_near(a.at.y, a.off_y, b.at.y, b.off_y);
  return order != 0 || a.off_y == 0 ? order : compare(a.exact->y, b.exact->y);
}

int orientation(const NearSpot& a, const NearSpot& b, const NearSpot& c) {
  if (a.exact == nullptr && b.exact == nullptr && c.exact == nullptr) return exact::orient_sign(a.at, b.at, c.at);
  const int sign = orientation_filtered(a.at, b.at, c.at);
  return sign != 0 ? sign : orientation(spot_of(a), spot_of(b), spot_of(c));
}

bool on_segment(const NearSpot& a, const NearSpot& b, const NearSpot& c) {
  return compare_x(a, c) * compare_x(c, b) >= 0 && compare_y(a, c) * compare_y(c, b) >= 0 && orientation(a, b, c) == 0;
}

}  // namespace dymsum::planar
