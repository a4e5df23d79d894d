#include "planar/lattice.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <type_traits>

#include "exact/grid.h"
#include "exact/int.h"

namespace dymsum::planar {
namespace {

using exact::Big;
using exact::BigRational;

// Widths for coordinates |X| <= 2^B: edge vectors B + 1 bits, pair sums B + 1, their differences B + 2, side and along values
// 2B + 4, cut parameters N / D with 2B + 4 and 2B + 4, mediants one more, sides of places 4B + 11. Int computes and proves them.
template <class C>
class LatticeOf final : public Lattice {
  struct Vec {
    C x, y;
  };
  using EdgeC = decltype(C{} - C{});
  struct EdgeVec {
    EdgeC x, y;
  };
  using DiffC = decltype((C{} + C{}) - (C{} + C{}));
  using Value = decltype(EdgeC{} * DiffC{} - EdgeC{} * DiffC{});
  using Wide = decltype(Value{} + Value{});
  struct Ratio {
    Value n, d;  // d > 0
  };
  struct WideRatio {
    Wide n, d;
  };

 public:
  LatticeOf(int exponent, std::array<Point, 2> origin, std::optional<LatticeScale> scale)
      : exponent_(exponent), origin_(origin), scale_(std::move(scale)) {
    if constexpr (!std::is_same_v<C, Big>) {
      if (!scale_) return;
      const C other = exact::narrowed<C>(Big(scale_->den));
      for (std::uint32_t op = 0; op < 2; ++op)
        factor_[op] = op == scale_->op ? Vec{exact::narrowed<C>(Big(scale_->x)), exact::narrowed<C>(Big(scale_->y))} : Vec{other, other};
    }
  }

  int cross(const Edge& d, const Edge& e) const override {
    const EdgeVec a = edge(d), b = edge(e);
    return exact::sign(a.x * b.y - a.y * b.x);
  }
  int dot(const Edge& d, const Edge& e) const override {
    const EdgeVec a = edge(d), b = edge(e);
    return exact::sign(a.x * b.x + a.y * b.y);
  }
  int compare_extent(const Edge& d, const Edge& e, int axis) const override {
    const EdgeVec a = edge(d), b = edge(e);
    return axis == 0 ? exact::sign(a.x - b.x) : exact::sign(a.y - b.y);
  }
  int side(const Segment& s, Pair v) const override { return exact::sign(side_value(s, v)); }
  int along(const Segment& s, Pair v) const override { return exact::sign(along_value(s, v)); }
  bool same(Pair a, Pair b) const override {
    const SumVec u = sum(a), v = sum(b);
    return u.x == v.x && u.y == v.y;
  }

  int compare_coordinate(Pair a, Pair b, int axis) const override {
    const SumVec u = sum(a), v = sum(b);
    return axis == 0 ? exact::sign(u.x - v.x) : exact::sign(u.y - v.y);
  }

  // x = on.start + d N / D, so D (d_s x (x - s.start)) = D (d_s x (on.start - s.start)) + N (d_s x d_on).
  int side(const Segment& s, const Place& x) const override {
    const EdgeVec a = edge(s.edge), b = edge(x.on.edge);
    const Value at_start = side_value(s, start_of(x.on));
    const Value slope = widen(a.x * b.y - a.y * b.x);
    return sign_at(x, at_start, slope);
  }
  int along(const Segment& s, const Place& x) const override {
    const EdgeVec a = edge(s.edge), b = edge(x.on.edge);
    const Value at_start = along_value(s, start_of(x.on));
    const Value slope = widen(a.x * b.x + a.y * b.y);
    return sign_at(x, at_start, slope);
  }

  // D (v - start) - N d.
  int height(Pair v, const Place& x) const override {
    const WideRatio t = ratio(x);
    return exact::sign(t.d * (sum(v).y - sum(start_of(x.on)).y) - t.n * edge(x.on.edge).y);
  }

  int compare(const Segment& on, const Cut& a, const Cut& b) const override {
    const Ratio s = parameter(on, a), t = parameter(on, b);
    return exact::sign(s.n * t.d - t.n * s.d);
  }

  // start + d N / D over one denominator each, then crosswise.
  int compare_coordinate(const Place& a, const Place& b, int axis) const override {
    const WideRatio s = ratio(a), t = ratio(b);
    const SumVec from_a = sum(start_of(a.on)), from_b = sum(start_of(b.on));
    const EdgeVec d = edge(a.on.edge), e = edge(b.on.edge);
    const auto u = axis == 0 ? from_a.x * s.d + d.x * s.n : from_a.y * s.d + d.y * s.n;
    const auto v = axis == 0 ? from_b.x * t.d + e.x * t.n : from_b.y * t.d + e.y * t.n;
    return exact::sign(u * t.d - v * s.d);
  }

  Position position(const Place& x) const override {
    const SumVec s = sum(start_of(x.on));
    const EdgeVec d = edge(x.on.edge);
    const WideRatio t = ratio(x);
    const BigRational r(number(t.n), number(t.d));
    return in_input(BigRational(number(s.x)) + r * BigRational(number(d.x)), BigRational(number(s.y)) + r * BigRational(number(d.y)));
  }
  const SharedIntegers& unscaled_integers() const override { return unscaled(); }
  Position position(Pair v) const override {
    const SumVec s = sum(v);
    return in_input(BigRational(number(s.x)), BigRational(number(s.y)));
  }

 private:
  template <class T>
  static Value widen(const T& v) {
    return Value(v);
  }
  template <class T>
  static boost::multiprecision::cpp_int number(const T& v) {
    if constexpr (std::is_same_v<T, Big>) {
      return v.value();
    } else {
      return exact::to_big(v).value();
    }
  }
  Position in_input(const BigRational& gx, const BigRational& gy) const {
    BigRational unit = unit_rational();
    std::array<BigRational, 2> x{exact::exact_value(origin_[0].x), exact::exact_value(origin_[1].x)};
    std::array<BigRational, 2> y{exact::exact_value(origin_[0].y), exact::exact_value(origin_[1].y)};
    if (scale_) {
      x[scale_->op] *= BigRational(scale_->x, scale_->den);
      y[scale_->op] *= BigRational(scale_->y, scale_->den);
      unit /= scale_->den;
    }
    return {BigRational(gx * unit + x[0] + x[1]), BigRational(gy * unit + y[0] + y[1])};
  }
  BigRational unit_rational() const {
    boost::multiprecision::cpp_int power = 1;
    power <<= std::abs(exponent_);
    return exponent_ >= 0 ? BigRational(power) : BigRational(boost::multiprecision::cpp_int(1), power);
  }

  Vec at(std::uint32_t op, std::uint32_t i) const {
    if constexpr (std::is_same_v<C, exact::Int<29>>) {
      // Up to 53 bits the doubles are the integers.
      if (!scale_)
        return {C::from_int64(static_cast<std::int64_t>(x[op][i])), C::from_int64(static_cast<std::int64_t>(y[op][i]))};
    }
    if constexpr (!std::is_same_v<C, Big>) {
      if (scale_) {
        // The product fits: the tier was chosen for it.
        const SharedIntegers& shared = unscaled();
        const auto& v = shared.at[op][i];
        const Vec& f = factor_[op];
        return {C::from_raw(static_cast<typename C::Raw>(static_cast<typename C::Raw>(v[0]) * f.x.raw())),
                C::from_raw(static_cast<typename C::Raw>(static_cast<typename C::Raw>(v[1]) * f.y.raw()))};
      }
    }
    std::call_once(filled_, [this] { fill(); });
    return integers_[op][i];
  }
  const SharedIntegers& unscaled() const {
    std::call_once(integers->made, [this] {
      for (int op = 0; op < 2; ++op)
        for (const Point& v : input[op])
          integers->at[op].push_back({exact::grid_coordinate<exact::Int<125>>(v.x, origin_[op].x, exponent_).raw(),
                                      exact::grid_coordinate<exact::Int<125>>(v.y, origin_[op].y, exponent_).raw()});
    });
    return *integers;
  }
  // Integers are made when a filter has failed for the first time; most problems never ask.
  void fill() const {
    for (std::uint32_t op = 0; op < 2; ++op)
      for (const Point& v : input[op]) {
        integers_[op].push_back({exact::grid_coordinate<C>(v.x, origin_[op].x, exponent_),
                                 exact::grid_coordinate<C>(v.y, origin_[op].y, exponent_)});
        if constexpr (std::is_same_v<C, Big>) {
          if (!scale_) continue;
          Vec& w = integers_[op].back();
          const bool scaled = op == scale_->op;
          w.x = w.x * Big(scaled ? scale_->x : scale_->den);
          w.y = w.y * Big(scaled ? scale_->y : scale_->den);
        }
      }
  }
  struct SumVec {
    decltype(C{} + C{}) x, y;
  };
  SumVec sum(Pair v) const {
    const Vec a = at(0, v.p), b = at(1, v.q);
    return {a.x + b.x, a.y + b.y};
  }

  EdgeVec edge(const Edge& e) const {
    const Vec a = at(e.op, e.from), b = at(e.op, e.to);
    return {b.x - a.x, b.y - a.y};
  }
  auto difference(const Segment& s, Pair v) const {
    const SumVec a = sum(v), o = sum(start_of(s));
    struct {
      DiffC x, y;
    } d{a.x - o.x, a.y - o.y};
    return d;
  }
  Value side_value(const Segment& s, Pair v) const {
    const EdgeVec e = edge(s.edge);
    const auto d = difference(s, v);
    return e.x * d.y - e.y * d.x;
  }
  Value along_value(const Segment& s, Pair v) const {
    const EdgeVec e = edge(s.edge);
    const auto d = difference(s, v);
    return e.x * d.x + e.y * d.y;
  }

  // The parameter of a cut on `on`, 0 at its start and 1 at its end.
  Ratio parameter(const Segment& on, const Cut& cut) const {
    const EdgeVec d = edge(on.edge);
    Ratio r;
    if (cut.kind == Cut::Kind::crossing) {
      const EdgeVec b = edge(cut.by.edge);
      r.n = side_value(cut.by, start_of(on));
      r.d = widen(d.x * b.y - d.y * b.x);  // = -(b x d)
    } else {
      const auto v = difference(on, cut.pair);
      if (exact::sign(d.x) != 0) {
        r.n = widen(v.x);
        r.d = widen(d.x);
      } else {
        r.n = widen(v.y);
        r.d = widen(d.y);
      }
    }
    if (exact::sign(r.d) < 0) {
      r.n = -r.n;
      r.d = -r.d;
    }
    return r;
  }
  WideRatio ratio(const Place& x) const {
    const Ratio a = parameter(x.on, x.first);
    if (!x.between) return {Wide(a.n), Wide(a.d)};
    const Ratio b = parameter(x.on, x.second);
    return {a.n + b.n, a.d + b.d};
  }
  int sign_at(const Place& x, const Value& at_start, const Value& slope) const {
    const WideRatio t = ratio(x);
    return exact::sign(t.d * at_start + t.n * slope);
  }

  int exponent_;
  std::array<Point, 2> origin_;  // exact, where `offset` is rounded after scaling
  std::optional<LatticeScale> scale_;
  std::array<Vec, 2> factor_{};  // of the integers, where scaled
  mutable std::once_flag filled_;
  mutable std::array<std::vector<Vec>, 2> integers_;
};

}  // namespace

Point Lattice::to_input(double gx, double gy) const {
  return {std::ldexp(gx, double_exponent) + (offset[0].x + offset[1].x),
          std::ldexp(gy, double_exponent) + (offset[0].y + offset[1].y)};
}

namespace {

// The smallest corner of the bounding box: its coordinates are coordinates of vertices, hence on the grid.
Point low_corner(std::span<const Point> points) {
  if (points.empty()) return {};
  Point low = points[0];
  for (const Point& p : points) low = {std::min(low.x, p.x), std::min(low.y, p.y)};
  return low;
}

// The smallest k with n <= 2^k, for n > 0.
int factor_bits(const exact::BigInteger& n) {
  const int top = static_cast<int>(msb(n));
  return (n & (n - 1)) == 0 ? top : top + 1;
}

struct GridOf {
  std::array<Point, 2> offset;  // exact
  std::array<double, 2> extent{};
  int exponent = 0;
};

std::unique_ptr<Lattice> build(std::span<const Point> p, std::span<const Point> q, const GridOf& grid,
                               std::optional<LatticeScale> scale, std::shared_ptr<SharedIntegers> integers, int min_tier_bits) {
  const std::array<Point, 2>& offset = grid.offset;
  const std::array<double, 2>& extent = grid.extent;
  const int exponent = grid.exponent;
  // One unit in the last place covers the rounding of the differences.
  const auto bits_of = [&](double e) { return exact::bits_needed(std::nextafter(e, INFINITY), exponent); };
  const double longest = std::max(extent[0], extent[1]);
  const int plain_bits = bits_of(longest);
  int bits = plain_bits;
  if (scale) {
    bits = 0;
    for (std::uint32_t op = 0; op < 2; ++op)
      bits = std::max(bits, bits_of(extent[op]) + (op == scale->op ? std::max(factor_bits(scale->x), factor_bits(scale->y))
                                                                  : factor_bits(scale->den)));
  }
  const exact::Tier tier = exact::choose_tier(bits, min_tier_bits);
  const bool dyadic = !scale || (scale->den & (scale->den - 1)) == 0;
  Point factor{1, 1};
  if (scale)
    factor = {exact::round_to_double(BigRational(scale->x, scale->den)), exact::round_to_double(BigRational(scale->y, scale->den))};
  const std::uint32_t scaled_op = scale ? scale->op : 2;
  const double den = scale ? exact::round_to_double(BigRational(scale->den)) : 1;
  std::unique_ptr<Lattice> lattice;
  switch (tier) {
    case exact::Tier::b29: lattice = std::make_unique<LatticeOf<exact::Int<29>>>(exponent, offset, std::move(scale)); break;
    case exact::Tier::b61: lattice = std::make_unique<LatticeOf<exact::Int<61>>>(exponent, offset, std::move(scale)); break;
    case exact::Tier::b512: lattice = std::make_unique<LatticeOf<exact::Int<125>>>(exponent, offset, std::move(scale)); break;
    case exact::Tier::arbitrary: lattice = std::make_unique<LatticeOf<Big>>(exponent, offset, std::move(scale)); break;
  }
  lattice->tier_bits = static_cast<int>(tier);
  // Sides have at most 2 B + 4 bits; doubles hold 53. A power of two below scaled coordinates changes nothing.
  lattice->exact_doubles = bits <= 24 && dyadic;
  // Doubles count grid units while these fit well, else 2^-60 of the extent, so that nothing overflows.
  lattice->double_exponent = plain_bits <= 61 ? std::max(exponent, -1000) : std::ilogb(longest) - 60;
  lattice->per_unit = std::ldexp(1.0, -lattice->double_exponent);
  lattice->input = {std::vector<Point>(p.begin(), p.end()), std::vector<Point>(q.begin(), q.end())};
  lattice->integers_per_unit = std::ldexp(den, lattice->double_exponent - exponent);
  lattice->offset = offset;
  lattice->grid_exponent = exponent;
  lattice->integers = std::move(integers);
  for (std::uint32_t op = 0; op < 2; ++op) {
    double reach = 0;
    lattice->x[op].reserve(lattice->input[op].size());
    lattice->y[op].reserve(lattice->input[op].size());
    if (op == scaled_op) {
      lattice->stretch[op] = factor;
      lattice->offset[op] = {offset[op].x * factor.x, offset[op].y * factor.y};
      // The factor and the product are rounded.
      lattice->offset_error = 0x1p-51 * (std::abs(lattice->offset[op].x) + std::abs(lattice->offset[op].y));
    }
    const Point f = lattice->stretch[op];
    for (const Point& v : lattice->input[op]) {
      // The difference of two doubles is rounded once; the power of two is exact.
      lattice->x[op].push_back((v.x - offset[op].x) * lattice->per_unit * f.x);
      lattice->y[op].push_back((v.y - offset[op].y) * lattice->per_unit * f.y);
      reach = std::max({reach, lattice->x[op].back(), lattice->y[op].back()});
    }
    lattice->span += reach;
  }
  return lattice;
}

}  // namespace

std::unique_ptr<Lattice> make_lattice(std::span<const Point> p, std::span<const Point> q, int min_tier_bits) {
  GridOf grid;
  grid.offset = {low_corner(p), low_corner(q)};
  std::vector<double> all;
  all.reserve(2 * (p.size() + q.size()));
  for (int op = 0; op < 2; ++op)
    for (const Point& v : op == 0 ? p : q) {
      all.push_back(v.x);
      all.push_back(v.y);
      grid.extent[op] = std::max({grid.extent[op], v.x - grid.offset[op].x, v.y - grid.offset[op].y});
    }
  grid.exponent = exact::common_exponent(all);
  return build(p, q, grid, std::nullopt, std::make_shared<SharedIntegers>(), min_tier_bits);
}

std::unique_ptr<Lattice> make_scaled_lattice(const Lattice& unscaled, const LatticeScale& scale, int min_tier_bits) {
  GridOf grid;
  grid.offset = unscaled.offset;
  grid.exponent = unscaled.grid_exponent;
  for (int op = 0; op < 2; ++op)
    for (const Point& v : unscaled.input[op])
      grid.extent[op] = std::max({grid.extent[op], v.x - grid.offset[op].x, v.y - grid.offset[op].y});
  return build(unscaled.input[0], unscaled.input[1], grid, scale, unscaled.integers, min_tier_bits);
}

}  // namespace dymsum::planar
