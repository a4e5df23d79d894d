#include "spatial/convex/nearest_positions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/doubles.h"
#include "exact/rounding_bound.h"
#include "spatial/gauss/signs.h"

namespace dymsum::spatial {
namespace {

using base::DoublePair;

/// The error of a coordinate in units of u^2, times the sizes of its terms. A matrix entry is a quotient, times a
/// quotient (3 operations on pairs). A term m x: what x is rounded to, the low part of m times x, m times what x has
/// beyond a double, the product of those two, which is left out (1 each), their sum (2), added to the error of the
/// product (3). The three terms: their errors (3 + 3), those of the two sums (2), both together (5). Adding two
/// coordinates: their low parts (5), the error of the sum (6), the ends of the interval (7).
constexpr double kU = exact::kRoundoff;
constexpr double kCounted = 3 * base::kPairError / (kU * kU) + 4 + 2 + 3 + 3 + 3 + 2 + 5 + 5 + 6 + 7;
/// The bound is doubled for what is beyond first order, and for the sizes, which are added up in doubles.
constexpr double kPositionError = 512 * kU * kU;
static_assert(2 * kCounted <= 512);
/// Coordinates of these sizes neither overflow nor lose error terms: factors are within 2^64 and 2^-64, entries of
/// rotations that are not zero at least 2^-62.
constexpr double kSmallest = 0x1p-400, kLargest = 0x1p400;

DoublePair pair_of(const exact::BigInteger& v) {
  const double high = exact::round_to_double(exact::BigRational(v));
  return {high, exact::round_to_double(exact::BigRational(v - exact::BigInteger(high)))};
}
DoublePair pair_of(std::int64_t v) {
  const auto high = static_cast<double>(v / 4);  // below 2^61, so that what is left is an integer of this type
  return base::exact_sum(4 * high, static_cast<double>(v - 4 * static_cast<std::int64_t>(high)));
}

/// Two halves of at most 26 bits, as products of them are exact (Dekker 1971).
struct Halves {
  double upper, lower;
};
Halves halves_of(double v) {
  const double c = 0x8000001 * v, upper = c - (c - v);
  return {upper, v - upper};
}

/// An entry of a pose's matrix, both halves of its upper part apart.
struct Entry {
  double high = 0, upper = 0, lower = 0, low = 0;
  bool exact = true;
  Entry() = default;
  Entry(DoublePair m, bool exact) : high(m.high), low(m.low), exact(exact) {
    const Halves h = halves_of(m.high);
    upper = h.upper;
    lower = h.lower;
  }
};

std::array<Entry, 9> matrix_of(const SolidPose& pose) {
  const std::array<std::int64_t, 9> n = pose.rotation.matrix();
  const std::int64_t norm = pose.rotation.norm();
  const DoublePair length = pair_of(norm);
  const PoseFactors factors = PoseFactors::of(pose);
  std::array<Entry, 9> m;
  for (std::size_t k = 0; k < 9; ++k) {
    if (n[k] == 0) continue;
    const bool whole = n[k] == norm || n[k] == -norm;
    DoublePair v = whole ? DoublePair{n[k] < 0 ? -1.0 : 1.0, 0} : pair_of(n[k]) / length;
    bool exact = whole;
    if (factors.scaled) {
      const exact::BigInteger &num = factors.num[k % 3], &den = factors.den[k % 3];
      const DoublePair by = pair_of(num) / pair_of(den);
      exact = exact && by.low == 0 && exact::BigRational(by.high) * exact::BigRational(den) == exact::BigRational(num);
      v = exact ? DoublePair{v.high * by.high, 0} : v * by;
    }
    m[k] = Entry(v, exact);
  }
  return m;
}

bool is_ordinary(double c) { return c == 0 || (std::abs(c) >= kSmallest && std::abs(c) <= kLargest); }

struct TwoPair {
  Two high, low;
};
TwoPair exact_sum(Two a, Two b) {
  const Two s = a + b, t = s - a;
  return {s, (a - (s - t)) + (b - t)};
}

/// One posed coordinate of two vertices.
struct TwoCoordinates {
  Two high, low, size;
};
TwoCoordinates coordinate(const Entry* row, const std::array<Two, 3>& upper, const std::array<Two, 3>& lower,
                          const std::array<Two, 3>& rest) {
  std::array<Two, 3> product, low;
  for (std::size_t k = 0; k < 3; ++k) {
    const Entry& m = row[k];
    const Two x = upper[k] + lower[k];
    product[k] = m.high * x;
    const Two lost = ((m.upper * upper[k] - product[k]) + m.upper * lower[k] + m.lower * upper[k]) + m.lower * lower[k];
    low[k] = lost + (m.low * x + m.high * rest[k]);
  }
  const TwoPair two = exact_sum(product[0], product[1]), all = exact_sum(two.high, product[2]);
  return {all.high, (two.low + all.low) + ((low[0] + low[1]) + low[2]),
          magnitude(product[0]) + magnitude(product[1]) + magnitude(product[2])};
}

Two load(const std::vector<double>& from, std::size_t i) { return Two{from[i], from[i + 1]}; }
Two load(const std::array<double, 4>& from, std::size_t i) { return Two{from[i], from[i + 1]}; }

/// Two coordinates of a vertex of a sum. Rounding is monotone: where both ends of the interval round to one double, the
/// exact value between them does. Negative zeros become zero.
struct Rounded {
  Two at;
  bool decided;
};
Rounded rounded_sum(Two a_high, Two a_low, Two a_error, Two b_high, Two b_low, Two b_error) {
  const TwoPair sum = exact_sum(a_high, b_high);
  const Two low = sum.low + (a_low + b_low), error = a_error + b_error;
  const Two below = sum.high + (low - error), above = sum.high + (low + error);
  return {above + both(0), every(below == above)};
}

}  // namespace

NearestPositions::NearestPositions(const ConvexOperands& source,
                                   const std::array<std::span<const std::uint32_t>, 2>& vertices)
    : source_(&source) {
  for (std::size_t op = 0; op < 2; ++op) take(operand_[op], source.operand[op], vertices[op]);
}

void NearestPositions::take(Operand& operand, const ConvexOperands::Operand& source,
                            std::span<const std::uint32_t> vertices) {
  operand.vertex.assign(vertices.begin(), vertices.end());
  const std::size_t n = vertices.size() + vertices.size() % 2;  // taken by twos
  operand.posed.resize(n);
  for (std::size_t k = 0; k < 3; ++k) {
    operand.upper[k].assign(n, 0);
    operand.lower[k].assign(n, 0);
    if (!source.exact.empty()) operand.rest[k].assign(n, 0);
  }
  const exact::BigRational unit = exact::exact_value(std::ldexp(1.0, std::clamp(source.exponent, -1000, 1000)));
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    std::array<DoublePair, 3> at;
    if (source.exact.empty()) {
      const Point3& v = source.vertices[vertices[i]];
      at = {DoublePair{v.x, 0}, {v.y, 0}, {v.z, 0}};
    } else {
      const exact::Vector3<exact::Big>& v = source.exact[vertices[i]];
      std::size_t k = 0;
      for (const exact::Big* c : {&v.x, &v.y, &v.z}) {
        const exact::BigRational value = exact::BigRational(c->value()) * unit;
        const double high = exact::round_to_double(value);
        operand.decides &= std::isfinite(high);
        if (!operand.decides) return;
        at[k++] = {high, exact::round_to_double(exact::BigRational(value - exact::exact_value(high)))};
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      operand.decides &= is_ordinary(at[k].high);
      if (!operand.decides) return;
      const Halves h = halves_of(at[k].high);
      operand.upper[k][i] = h.upper;
      operand.lower[k][i] = h.lower;
      if (!operand.rest[k].empty()) operand.rest[k][i] = at[k].low;
    }
  }
  operand.decides &= source.exponent >= -1000 && source.exponent <= 1000;
}

std::size_t NearestPositions::bytes() const {
  std::size_t total = 0;
  for (const Operand& o : operand_) {
    total += o.vertex.capacity() * sizeof(std::uint32_t) + o.posed.capacity() * sizeof(Posed);
    for (const auto* parts : {&o.upper, &o.lower, &o.rest})
      for (const std::vector<double>& part : *parts) total += part.capacity() * sizeof(double);
  }
  return total;
}

void NearestPositions::pose(const SolidPose& p, const SolidPose& q) {
  for (std::size_t op = 0; op < 2; ++op) {
    const SolidPose& to = op == 0 ? p : q;
    if (operand_[op].pose == to) continue;
    exactly_.reset();
    operand_[op].pose = to;
    if (operand_[op].decides) pose(operand_[op], to);
  }
}

void NearestPositions::pose(Operand& operand, const SolidPose& pose) {
  const std::array<Entry, 9> m = matrix_of(pose);
  const bool has_rest = !operand.rest[0].empty();
  for (std::size_t r = 0; r < 3; ++r) {
    const auto row = m.begin() + static_cast<std::ptrdiff_t>(3 * r);
    // One product and nothing else.
    operand.exact[r] = !has_rest && std::count_if(row, row + 3, [](const Entry& e) { return e.high != 0; }) == 1 &&
                       std::all_of(row, row + 3, [](const Entry& e) { return e.exact; });
  }
  for (std::size_t i = 0; i < operand.posed.size(); i += 2) {
    std::array<Two, 3> upper, lower, rest{};
    for (std::size_t k = 0; k < 3; ++k) {
      upper[k] = load(operand.upper[k], i);
      lower[k] = load(operand.lower[k], i);
      if (has_rest) rest[k] = load(operand.rest[k], i);
    }
    for (std::size_t r = 0; r < 3; ++r) {
      const TwoCoordinates c = coordinate(&m[3 * r], upper, lower, rest);
      for (std::size_t lane = 0; lane < 2; ++lane) {
        Posed& at = operand.posed[i + lane];
        at.high[r] = c.high[lane];
        at.low[r] = c.low[lane];
        at.error[r] = kPositionError * c.size[lane];
      }
    }
  }
}

void NearestPositions::position(std::span<const VertexPair> pairs, std::span<Point3> at) {
  decided_exactly_ = 0;
  const bool decides = operand_[0].decides && operand_[1].decides;
  const Posed *p = operand_[0].posed.data(), *q = operand_[1].posed.data();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (pairs[i].p == kNoPair.p) {
      at[i] = {};
      continue;
    }
    const Posed &a = p[pairs[i].p], &b = q[pairs[i].q];
    const Rounded xy = rounded_sum(load(a.high, 0), load(a.low, 0), load(a.error, 0), load(b.high, 0), load(b.low, 0),
                                   load(b.error, 0));
    const Rounded z = rounded_sum(load(a.high, 2), load(a.low, 2), load(a.error, 2), load(b.high, 2), load(b.low, 2),
                                  load(b.error, 2));
    at[i] = decides && xy.decided && z.decided ? Point3{xy.at[0], xy.at[1], z.at[0]} : in_doubt(pairs[i]);
  }
}

Point3 NearestPositions::in_doubt(VertexPair pair) {
  if (!operand_[0].decides || !operand_[1].decides) return exactly(pair);
  std::array<double, 3> at;
  for (std::size_t r = 0; r < 3; ++r) {
    const std::optional<double> decided = exact_in_doubles(pair, r);
    if (!decided) return exactly(pair);
    at[r] = *decided;
  }
  return {at[0], at[1], at[2]};
}

/// The nearest double where all parts are exact, and so are their sums but the last, which then rounds once. Half-way
/// cases of solids that keep an axis are of this kind.
std::optional<double> NearestPositions::exact_in_doubles(VertexPair pair, std::size_t r) const {
  const Posed &a = operand_[0].posed[pair.p], &b = operand_[1].posed[pair.q];
  const DoublePair high = base::exact_sum(a.high[r], b.high[r]), low = base::exact_sum(a.low[r], b.low[r]);
  const DoublePair rest = base::exact_sum(high.low, low.high);
  const double error = a.error[r] + b.error[r];
  const double below = high.high + (high.low + low.high - error), above = high.high + (high.low + low.high + error);
  if (below == above) return above + 0.0;
  const bool a_exact = operand_[0].exact[r] || a.error[r] == 0, b_exact = operand_[1].exact[r] || b.error[r] == 0;
  if (!a_exact || !b_exact || low.low != 0 || rest.low != 0) return std::nullopt;
  return high.high + rest.high + 0.0;
}

Point3 NearestPositions::exactly(VertexPair pair) {
  if (!exactly_) exactly_.emplace(*source_, *operand_[0].pose, *operand_[1].pose);
  ++decided_exactly_;
  const BigVector a = exactly_->of(0, operand_[0].vertex[pair.p]), b = exactly_->of(1, operand_[1].vertex[pair.q]);
  const auto rounded = [&](std::size_t k) {
    return exact::round_to_double(exact::BigRational(exact::BigInteger(a[k] + b[k])) * exactly_->unit());
  };
  return {rounded(0), rounded(1), rounded(2)};
}

namespace {

double coordinate(const Point3& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

class PositionOrder {
 public:
  PositionOrder(const ConvexOperands& operands, const SolidPose& p, const SolidPose& q,
                std::span<const ConvexSum::Vertex> vertices, std::span<const Point3> nearest)
      : operands_(operands), poses_{p, q}, vertices_(vertices), nearest_(nearest) {
    for (std::size_t op = 0; op < 2; ++op) {
      const std::array<std::int64_t, 9> rotation = poses_[op].rotation.matrix();
      for (std::size_t k = 0; k < 9; ++k) depends_[op][k / 3] |= rotation[k] != 0 ? 1U << k % 3 : 0U;
    }
    const bool still = p == SolidPose() && q == SolidPose();
    sums_of_doubles_ = still && operands.operand[0].exact.empty() && operands.operand[1].exact.empty();
  }

  bool less(std::uint32_t a, std::uint32_t b) {
    const Apart apart{apart_along(0, vertices_[a].p, vertices_[b].p), apart_along(1, vertices_[a].q, vertices_[b].q)};
    const Point3 &u = nearest_[a], &v = nearest_[b];
    if (const int x = order(a, b, 0, u.x, v.x, apart)) return x < 0;
    if (const int y = order(a, b, 1, u.y, v.y, apart)) return y < 0;
    return order(a, b, 2, u.z, v.z, apart) < 0;
  }

 private:
  using Apart = std::array<unsigned, 2>;

  /// The order along an axis, from the nearest doubles: rounding keeps the order.
  int order(std::uint32_t a, std::uint32_t b, std::size_t axis, double u, double v, const Apart& apart) {
    if (u != v) return u < v ? -1 : 1;
    // Nearly all ties are of this kind. Others may be ties as well.
    if ((apart[0] & depends_[0][axis]) == 0 && (apart[1] & depends_[1][axis]) == 0) return 0;
    return order_of_rests(a, b, static_cast<int>(axis));
  }
  int order_of_rests(std::uint32_t a, std::uint32_t b, int axis) {
    if (!sums_of_doubles_ || !std::isfinite(coordinate(nearest_[a], axis))) return exact_order(a, b, axis);
    const double u = rest(a, axis), v = rest(b, axis);
    return (u > v) - (u < v);
  }

  /// The axes along which two vertices of an operand lie apart, as bits; all of them where that is not looked at.
  unsigned apart_along(std::size_t op, std::uint32_t a, std::uint32_t b) const {
    if (a == b) return 0;
    const ConvexOperands::Operand& operand = operands_.operand[op];
    if (!operand.exact.empty()) return 7;
    const Point3 &u = operand.vertices[a], &v = operand.vertices[b];
    return (u.x != v.x ? 1U : 0U) | (u.y != v.y ? 2U : 0U) | (u.z != v.z ? 4U : 0U);
  }

  /// What the nearest double of a sum of two doubles leaves out: a double, exactly.
  double rest(std::uint32_t vertex, int axis) const {
    const double a = coordinate(operands_.operand[0].vertices[vertices_[vertex].p], axis),
                 b = coordinate(operands_.operand[1].vertices[vertices_[vertex].q], axis), sum = a + b, taken = sum - a;
    return (a - (sum - taken)) + (b - taken);
  }

  int exact_order(std::uint32_t a, std::uint32_t b, int axis) {
    const auto at = [&](std::uint32_t v) {
      return exact::BigInteger(position(0, vertices_[v].p)[static_cast<std::size_t>(axis)] +
                               position(1, vertices_[v].q)[static_cast<std::size_t>(axis)]);
    };
    return at(a).compare(at(b));
  }

  /// Made where it is needed first: vertices of the sum share those of the operands.
  const BigVector& position(std::size_t op, std::uint32_t v) {
    if (!exactly_) {
      exactly_.emplace(operands_, poses_[0], poses_[1]);
      for (std::size_t k = 0; k < 2; ++k) positions_[k].resize(operands_.operand[k].size());
    }
    std::optional<BigVector>& known = positions_[op][v];
    if (!known) known = exactly_->of(static_cast<int>(op), v);
    return *known;
  }

  const ConvexOperands& operands_;
  std::array<SolidPose, 2> poses_;
  std::span<const ConvexSum::Vertex> vertices_;
  std::span<const Point3> nearest_;
  std::array<std::array<unsigned, 3>, 2> depends_{};  // of each operand, each coordinate: on which of its own, as bits
  bool sums_of_doubles_;
  std::optional<ExactPositions> exactly_;
  std::array<std::vector<std::optional<BigVector>>, 2> positions_;
};

}  // namespace

std::vector<Point3> nearest_positions(const ConvexOperands& operands, const SolidPose& p, const SolidPose& q,
                                      std::span<const ConvexSum::Vertex> vertices) {
  std::array<std::vector<std::uint32_t>, 2> used, position;  // vertices of the sum, and where these stand among them
  for (std::size_t op = 0; op < 2; ++op) position[op].assign(operands.operand[op].size(), kNoPair.p);
  const auto position_of = [&](std::size_t op, std::uint32_t v) {
    if (position[op][v] == kNoPair.p) {
      position[op][v] = static_cast<std::uint32_t>(used[op].size());
      used[op].push_back(v);
    }
    return position[op][v];
  };
  std::vector<VertexPair> pairs;
  pairs.reserve(vertices.size());
  for (const ConvexSum::Vertex& v : vertices) pairs.push_back({position_of(0, v.p), position_of(1, v.q)});
  NearestPositions positions(operands, {used[0], used[1]});
  positions.pose(p, q);
  std::vector<Point3> at(pairs.size());
  positions.position(pairs, at);
  return at;
}

std::vector<std::uint32_t> order_by_position(const ConvexOperands& operands, const SolidPose& p, const SolidPose& q,
                                             std::span<const ConvexSum::Vertex> vertices,
                                             std::span<const Point3> nearest) {
  // What sorts vertices by x first, side by side with the indices; then come intervals of one x, most of one vertex.
  struct Key {
    double x;
    std::uint32_t vertex;
  };
  std::vector<Key> keys;
  keys.reserve(vertices.size());
  for (std::uint32_t v = 0; v < vertices.size(); ++v) keys.push_back({nearest[v].x, v});
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) { return a.x < b.x; });
  PositionOrder positions(operands, p, q, vertices, nearest);
  std::vector<std::uint32_t> order;
  order.reserve(keys.size());
  for (const Key& key : keys) order.push_back(key.vertex);
  for (std::size_t first = 0, last = 0; first < keys.size(); first = last) {
    for (last = first + 1; last < keys.size() && keys[last].x == keys[first].x;) ++last;
    if (last - first == 1) continue;
    std::sort(order.begin() + static_cast<std::ptrdiff_t>(first), order.begin() + static_cast<std::ptrdiff_t>(last),
              [&](std::uint32_t a, std::uint32_t b) { return positions.less(a, b); });
  }
  return order;
}

}  // namespace dymsum::spatial
