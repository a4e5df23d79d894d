#include "nesting/strip_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "exact/big.h"
#include "planar/motion/orientation.h"

namespace dymsum::nesting {
namespace {

using exact::BigInteger;
using exact::BigRational;

/// Coordinates as integers: multiples of 2^unit.
class IntegerGrid {
 public:
  explicit IntegerGrid(const std::vector<Point>& points) {
    for (const Point p : points)
      for (const double v : {p.x, p.y})
        if (v != 0) unit_ = std::min(unit_.value_or(exponent_of(v)), exponent_of(v));
  }
  int unit() const { return unit_.value_or(0); }
  BigInteger integer(double v) const {
    if (v == 0) return 0;
    int exponent = 0;
    const BigInteger digits = static_cast<std::int64_t>(std::ldexp(std::frexp(v, &exponent), kDigits));
    return digits << (exponent - kDigits - unit());
  }

 private:
  static constexpr int kDigits = 53;
  static int exponent_of(double v) {
    int exponent = 0;
    std::frexp(v, &exponent);
    return exponent - kDigits;
  }
  std::optional<int> unit_;
};

std::vector<Point> outer_vertices(const Region& part) {
  std::vector<Point> all = part.points();
  for (const Part& piece : part.parts()) all.insert(all.end(), piece.outer.begin(), piece.outer.end());
  for (const Polyline& line : part.polylines()) all.insert(all.end(), line.begin(), line.end());
  return all;
}

struct Extent {
  BigRational least_x, least_y, most_y;
};

/// The extent of the part, turned. R = (d^2 - n^2, -2 n d; 2 n d, d^2 - n^2) / (d^2 + n^2).
Extent extent_of(const Region& part, const Orientation& theta) {
  const auto [n, d] = planar::tan_half_of(theta);
  const BigInteger cosine = d * d - n * n, sine = 2 * n * d, w = d * d + n * n;
  const std::vector<Point> points = outer_vertices(part);
  const IntegerGrid grid(points);
  std::optional<BigInteger> least_x, least_y, most_y;
  for (const Point p : points) {
    const BigInteger px = grid.integer(p.x), py = grid.integer(p.y);
    const BigInteger x = cosine * px - sine * py, y = sine * px + cosine * py;
    if (!least_x || x < *least_x) least_x = x;
    if (!least_y || y < *least_y) least_y = y;
    if (!most_y || y > *most_y) most_y = y;
  }
  const int unit = grid.unit();
  const auto value = [&](const BigInteger& v) {
    return unit >= 0 ? BigRational(BigInteger(v << unit), w) : BigRational(v, BigInteger(w << -unit));
  };
  return {value(*least_x), value(*least_y), value(*most_y)};
}

}  // namespace

TableAnswer strip_answer(const NfpTable::State& table, const TableRow& row) {
  const Extent extent = extent_of(table.input.items[row.moving].shape, table.angles[row.angle].orientation);
  const BigRational margin = exact::exact_value(table.input.margin), left = margin - extent.least_x,
                    low = margin - extent.least_y,
                    high = exact::exact_value(*table.input.strip_height) - extent.most_y - margin;
  TableAnswer answer;
  answer.strip.emplace();
  if (low > high) return answer;
  const StripFit fit{true, exact::round_to_double(left), exact::round_to_double(low), exact::round_to_double(high)};
  if (!std::isfinite(fit.x_min) || !std::isfinite(fit.y_min) || !std::isfinite(fit.y_max)) {
    answer.status = TableAnswer::Status::refused;
    answer.error =
        Error{ErrorCode::rounding_changed_topology, "a position in the strip leaves the range of doubles", {}};
    return answer;
  }
  answer.strip = fit;
  const bool exact = exact::exact_value(fit.x_min) == left && exact::exact_value(fit.y_min) == low &&
                     exact::exact_value(fit.y_max) == high;
  answer.rounding = exact ? TableAnswer::Rounding::none : TableAnswer::Rounding::nearest;
  return answer;
}

}  // namespace dymsum::nesting
