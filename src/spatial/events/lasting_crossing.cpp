#include "spatial/events/lasting_crossing.h"

#include <algorithm>
#include <cmath>

namespace dymsum::spatial {

namespace {

double sum_of_sizes(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// A border as place + l way, l from 0 to `length` at a scale.
struct Line {
  Vec3 place, way;
  double length;
};
Line line_of(const MovingFacets& all, const MovingBorder& border, double s) {
  const bool scales = border.of_p == (all.moving() == 0);
  return {all.at(border.a, s),
          scales ? all.moved(border.b) - all.moved(border.a) : all.fixed(border.b) - all.fixed(border.a),
          scales ? s : 1};
}

/// How far along a line something is: -1 surely before its beginning, 1 surely behind its end.
int beyond(double l, double error, double length) {
  return l < -error ? -1 : l > length * (1 + 0x1p-50) + error ? 1 : 0;
}

}  // namespace

bool LastingCrossing::stays_beside(const PlaneRow& row) const {
  if (!known) return false;
  const Vec3 n{row[0], row[1], row[2]};
  int sides[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const double v = dot(n, at[k]) + row[3] * scale[k] - row[4];
    const double size = sum_of_sizes(n) * sum_of_sizes(at[k]) + std::abs(row[3] * scale[k]) + std::abs(row[4]);
    const double error = 2 * sum_of_sizes(n) * blur + size * 0x1p-48;
    sides[k] = v > error ? 1 : v < -error ? -1 : 0;
  }
  return sides[0] * sides[1] > 0;
}

// a + l d = b + m h for the gap from a to b: gap x h = l (d x h) and gap x d = m (d x h).
LastingCrossing lasting_crossing_of(const MovingFacets& all, const MovingBorder& one, const MovingBorder& other,
                                    double low, double high) {
  LastingCrossing result;
  result.scale = {low, high};
  int ends[2][2];
  // Components of ways, places and gaps are off by less than this; it is more than what rounding adds to products.
  const double off = all.span(high) * 0x1p-49;
  for (std::size_t k = 0; k < 2; ++k) {
    const Line e = line_of(all, one, result.scale[k]), h = line_of(all, other, result.scale[k]);
    const Vec3 gap = h.place - e.place, n = cross(e.way, h.way);
    const double E = sum_of_sizes(e.way), H = sum_of_sizes(h.way), G = sum_of_sizes(gap), N = sum_of_sizes(n);
    const double square = dot(n, n), square_error = 16 * off * (E + H) * N + 16 * off * off * (E + H) * (E + H);
    if (!(square > 2 * square_error)) return result;
    const auto along = [&](Vec3 across, double A, double& error) {
      const double l = dot(cross(gap, across), n) / square;
      error = 32 * off * ((G + A + off) * N + (G + off) * (A + off) * (E + H + off)) + 2 * std::abs(l) * square_error;
      error = error / (square - square_error) + std::abs(l) * 0x1p-48;
      return l;
    };
    double l_error = 0, m_error = 0;
    const double l = along(h.way, H, l_error), m = along(e.way, E, m_error);
    ends[0][k] = beyond(l, l_error, e.length), ends[1][k] = beyond(m, m_error, h.length);
    result.at[k] = e.place + l * e.way;
    result.blur = std::max(result.blur, E * l_error + 4 * (1 + std::abs(l)) * off);
  }
  result.known = true;
  result.misses = ends[0][0] * ends[0][1] > 0 || ends[1][0] * ends[1][1] > 0;
  return result;
}

}  // namespace dymsum::spatial
