#include "planar/operand/lattice.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>
#include <type_traits>

#include "exact/grid.h"
#include "exact/int.h"
#include "exact/interval.h"
#include "planar/operand/fine_lattice.h"
#include "planar/operand/make_lattice.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {
namespace {

using exact::Big;

// The error of positions in pairs of doubles is this times the sizes of their terms: integers; the quotient, the
// product and the sum.
constexpr double kNearVertex = 2 * exact::kIntegerPairError, kNearCrossing = 8 * base::kPairError;
static_assert(3 * base::kPairError + 8 * exact::kIntegerPairError < kNearCrossing);
using exact::BigRational;

// Widths for coordinates |X| <= 2^B: edge vectors B + 1 bits, pair sums B + 1, their differences B + 2, side and along
// values 2B + 4, cut parameters N / D with 2B + 4 and 2B + 4, mediants one more, sides of positions 4B + 11. Int
// computes and proves them.
/// Numbers whose coordinates are all made at once and kept: others are products of two words, made as they are
/// requested.
template <class C>
constexpr bool kKept = true;
template <int B>
constexpr bool kKept<exact::Int<B>> = (B > 125);

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
  /// `per_double`: the integers per unit of the doubles of the points where these are exact, else 0.
  LatticeOf(LatticeDoubles doubles, double per_double, std::optional<LatticeScale> scale)
      : Lattice(std::move(doubles)), exponent_(grid_exponent), per_double_(per_double), scale_(std::move(scale)) {
    if constexpr (!kKept<C>) {
      if (!scale_) return;
      const C other = exact::narrowed<C>(Big(scale_->den));
      for (std::uint32_t op = 0; op < 2; ++op)
        factor_[op] = op == scale_->op ? Vec{exact::narrowed<C>(Big(scale_->x)), exact::narrowed<C>(Big(scale_->y))}
                                       : Vec{other, other};
    }
  }

  int cross(const Edge& d, const Edge& e) const override {
    if (const auto decided = finely([&](const FineLattice& fine) { return fine.cross(d, e); })) return *decided;
    const EdgeVec a = edge(d), b = edge(e);
    return exact::sign(a.x * b.y - a.y * b.x);
  }
  int dot(const Edge& d, const Edge& e) const override {
    const EdgeVec a = edge(d), b = edge(e);
    return exact::sign(a.x * b.x + a.y * b.y);
  }
  int compare_extent(const Edge& d, const Edge& e, int axis) const override {
    const Point u = vector(d), v = vector(e);
    const double p = axis == 0 ? u.x : u.y, q = axis == 0 ? v.x : v.y, gap = p - q;
    if (const double bound = kScaledEdgeGap * (std::abs(p) + std::abs(q)) + exact::kUnderflow;
        gap > bound || gap < -bound)
      return gap > 0 ? 1 : -1;
    const EdgeVec a = edge(d), b = edge(e);
    return axis == 0 ? exact::sign(a.x - b.x) : exact::sign(a.y - b.y);
  }
  int side(const Segment& s, Pair v) const override {
    if (const auto decided = finely([&](const FineLattice& fine) { return fine.side(s, v); })) return *decided;
    return exact::sign(side_value(s, v));
  }
  int along(const Segment& s, Pair v) const override {
    if (const auto decided = finely([&](const FineLattice& fine) { return fine.along(s, v); })) return *decided;
    return exact::sign(along_value(s, v));
  }
  bool same(Pair a, Pair b) const override {
    const SumVec u = sum(a), v = sum(b);
    return u.x == v.x && u.y == v.y;
  }

  int compare_coordinate(Pair a, Pair b, int axis) const override {
    // Where one vertex is common to both, as to the ends of a segment, the other operand's coordinates as given decide.
    if (!scale_ && (a.p == b.p || a.q == b.q)) {
      const std::uint32_t op = a.p == b.p ? 1 : 0;
      const std::vector<Point>& input = points[op]->input;
      const Point &u = input[op == 1 ? a.q : a.p], &v = input[op == 1 ? b.q : b.p];
      const double x = axis == 0 ? u.x : u.y, y = axis == 0 ? v.x : v.y;
      return (x > y) - (x < y);
    }
    if (const auto decided = finely([&](const FineLattice& fine) { return fine.compare_coordinate(a, b, axis); }))
      return *decided;
    const SumVec u = sum(a), v = sum(b);
    return axis == 0 ? exact::sign(u.x - v.x) : exact::sign(u.y - v.y);
  }

  // x = on.start + d N / D, so D (d_s x (x - s.start)) = D (d_s x (on.start - s.start)) + N (d_s x d_on).
  int side(const Segment& s, const SegmentPosition& x) const override {
    if (is_vertex(x)) return side(s, x.first.pair);
    if (const auto decided = finely([&](const FineLattice& fine) { return fine.side(s, x); })) return *decided;
    const EdgeVec a = edge(s.edge), b = edge(x.on.edge);
    const Value at_start = side_value(s, start_of(x.on));
    const Value slope = widen(a.x * b.y - a.y * b.x);
    return sign_at(x, at_start, slope);
  }
  int along(const Segment& s, const SegmentPosition& x) const override {
    if (is_vertex(x)) return along(s, x.first.pair);
    if (const auto decided = finely([&](const FineLattice& fine) { return fine.along(s, x); })) return *decided;
    const EdgeVec a = edge(s.edge), b = edge(x.on.edge);
    const Value at_start = along_value(s, start_of(x.on));
    const Value slope = widen(a.x * b.x + a.y * b.y);
    return sign_at(x, at_start, slope);
  }

  // D (v - start) - N d.
  int compare_coordinate(Pair v, const SegmentPosition& x, int axis) const override {
    if (is_vertex(x)) return compare_coordinate(v, x.first.pair, axis);
    if (const auto decided = finely([&](const FineLattice& fine) { return fine.compare_coordinate(v, x, axis); }))
      return *decided;
    const WideRatio t = ratio(x);
    const SumVec at = sum(v), from = sum(start_of(x.on));
    const EdgeVec d = edge(x.on.edge);
    return axis == 0 ? exact::sign(t.d * (at.x - from.x) - t.n * d.x) : exact::sign(t.d * (at.y - from.y) - t.n * d.y);
  }

  int compare(const Segment& on, const Cut& a, const Cut& b) const override {
    if (const auto decided = finely([&](const FineLattice& fine) { return fine.compare(on, a, b); })) return *decided;
    const Ratio s = parameter(on, a), t = parameter(on, b);
    return exact::sign(s.n * t.d - t.n * s.d);
  }

  // start + d N / D over one denominator each, then crosswise.
  int compare_coordinate(const SegmentPosition& a, const SegmentPosition& b, int axis) const override {
    if (const auto decided = finely([&](const FineLattice& fine) { return fine.compare_coordinate(a, b, axis); }))
      return *decided;
    const WideRatio s = ratio(a), t = ratio(b);
    const SumVec from_a = sum(start_of(a.on)), from_b = sum(start_of(b.on));
    const EdgeVec d = edge(a.on.edge), e = edge(b.on.edge);
    const auto u = axis == 0 ? from_a.x * s.d + d.x * s.n : from_a.y * s.d + d.y * s.n;
    const auto v = axis == 0 ? from_b.x * t.d + e.x * t.n : from_b.y * t.d + e.y * t.n;
    return exact::sign(u * t.d - v * s.d);
  }

  // start + d N / D and the origin, over D.
  Homogeneous homogeneous(const SegmentPosition& x) const override {
    const SumVec s = sum(start_of(x.on));
    const EdgeVec d = edge(x.on.edge);
    const WideRatio t = ratio(x);
    const exact::BigInteger n = number(t.n), w = number(t.d);
    return in_input((number(s.x) + origin()[0]) * w + number(d.x) * n,
                    (number(s.y) + origin()[1]) * w + number(d.y) * n, w);
  }
  Homogeneous homogeneous(Pair v) const override {
    const SumVec s = sum(v);
    return in_input(number(s.x) + origin()[0], number(s.y) + origin()[1], 1);
  }

  std::optional<NearFrame> near_frame() const override {
    // A crossing's parameter is then a quotient of numbers below 2^804, and no error term of a product underflows.
    if (!(span * integers_per_unit <= 0x1p400)) return std::nullopt;
    const Homogeneous zero = in_input(origin()[0], origin()[1], 1), one = in_input(1, 0, 1);
    return NearFrame{{one.x, one.w}, {zero.x, zero.w}, {zero.y, zero.w}};
  }
  NearPosition near(const SegmentPosition& x) const override {
    using exact::integer_pair;
    const SumVec s = sum(start_of(x.on));
    const EdgeVec d = edge(x.on.edge);
    const WideRatio r = ratio(x);
    const base::DoublePair t = integer_pair(r.n) / integer_pair(r.d);
    const base::DoublePair sx = integer_pair(s.x), sy = integer_pair(s.y), dx = integer_pair(d.x) * t,
                           dy = integer_pair(d.y) * t;
    const double reach = std::abs(sx.high) + std::abs(sy.high) + std::abs(dx.high) + std::abs(dy.high);
    return {sx + dx, sy + dy, reach * kNearCrossing};
  }
  NearPosition near(Pair v) const override {
    const SumVec s = sum(v);
    const base::DoublePair x = exact::integer_pair(s.x), y = exact::integer_pair(s.y);
    return {x, y, (std::abs(x.high) + std::abs(y.high)) * kNearVertex};
  }

  const SharedIntegers& unscaled_integers() const override { return unscaled(); }

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
  // (x / w, y / w) integers from the input's origin, in input coordinates.
  Homogeneous in_input(exact::BigInteger x, exact::BigInteger y, exact::BigInteger w) const {
    if (exponent_ >= 0) {
      x <<= exponent_;
      y <<= exponent_;
    } else {
      w <<= -exponent_;
    }
    if (scale_) w *= scale_->den;
    return {std::move(x), std::move(y), std::move(w)};
  }
  // The origin of the integers: both offsets, in integers from the input's origin.
  const std::array<exact::BigInteger, 2>& origin() const {
    std::call_once(origin_made_, [this] {
      for (std::uint32_t op = 0; op < 2; ++op) {
        const exact::BigInteger x = exact::grid_coordinate<Big>(points[op]->offset.x, exponent_).value();
        const exact::BigInteger y = exact::grid_coordinate<Big>(points[op]->offset.y, exponent_).value();
        const bool scaled = scale_ && op == scale_->op;
        const exact::BigInteger one = 1,
                                &factor_x = scaled   ? scale_->x
                                            : scale_ ? scale_->den
                                                     : one,
                                &factor_y = scaled ? scale_->y : factor_x;
        origin_[0] += x * factor_x;
        origin_[1] += y * factor_y;
        if (const auto& turned = points[op]->turned; scaled && turned != nullptr) {
          origin_[0] += turned->low[0] - y * scale_->turn;
          origin_[1] += turned->low[1] + x * scale_->turn;
        }
      }
    });
    return origin_;
  }

  // Long integers are asked where pairs of doubles leave a sign open.
  template <class F>
  std::optional<int> finely(F f) const {
    if constexpr (!kKept<C>) {
      return std::nullopt;
    } else {
      std::call_once(fine_made_, [this] { fine_.emplace(*this, scale_); });
      return f(*fine_);
    }
  }

  Vec at(std::uint32_t op, std::uint32_t i) const {
    if constexpr (std::is_same_v<C, exact::Int<29>> || std::is_same_v<C, exact::Int<61>>) {
      if (per_double_ != 0) {
        const PlacedPoints& o = *points[op];
        return {C::from_int64(static_cast<std::int64_t>(o.x[i] * per_double_)),
                C::from_int64(static_cast<std::int64_t>(o.y[i] * per_double_))};
      }
    }
    if constexpr (!kKept<C>) {
      if (const TurnedPoints* turned = points[op]->turned.get(); turned != nullptr)
        return {C::from_raw(static_cast<typename C::Raw>(turned->at[i][0])),
                C::from_raw(static_cast<typename C::Raw>(turned->at[i][1]))};
      if (scale_) {
        // The product fits: the tier was chosen for it.
        const auto& v = unscaled().at[op][i];
        const Vec& f = factor_[op];
        return {C::from_raw(static_cast<typename C::Raw>(static_cast<typename C::Raw>(v[0]) * f.x.raw())),
                C::from_raw(static_cast<typename C::Raw>(static_cast<typename C::Raw>(v[1]) * f.y.raw()))};
      }
    }
    if (!filled_.load(std::memory_order_acquire)) {
      // Most problems ask about few vertices.
      if (points[op]->turned == nullptr &&
          queried_.fetch_add(1, std::memory_order_relaxed) < points[0]->input.size() + points[1]->input.size())
        return scale_ ? scaled_integer(op, i) : integer(op, i);
      fill();
    }
    return integers_[op][i];
  }
  // A vertex of an operand that is not scaled.
  Vec integer(std::uint32_t op, std::uint32_t i) const {
    const Point &v = points[op]->input[i], &origin = points[op]->offset;
    if constexpr (kKept<C>) {
      const auto on_grid = [&](double a, double from) {
        return exact::narrowed<C>(exact::grid_coordinate<Big>(a, from, exponent_));
      };
      return {on_grid(v.x, origin.x), on_grid(v.y, origin.y)};
    } else {
      return {exact::grid_coordinate<C>(v.x, origin.x, exponent_), exact::grid_coordinate<C>(v.y, origin.y, exponent_)};
    }
  }
  // A vertex where one operand is scaled: the other one counts in fractions of its units.
  Vec scaled_integer(std::uint32_t op, std::uint32_t i) const {
    if constexpr (kKept<C>) {
      const bool scaled = op == scale_->op;
      const Point &v = points[op]->input[i], &origin = points[op]->offset;
      const auto times = [&](double a, double from, const exact::BigInteger& factor) {
        return exact::narrowed<C>(exact::grid_coordinate<Big>(a, from, exponent_) * Big(factor));
      };
      return {times(v.x, origin.x, scaled ? scale_->x : scale_->den),
              times(v.y, origin.y, scaled ? scale_->y : scale_->den)};
    } else {
      return integer(op, i);  // never: such numbers are products made where they are needed
    }
  }
  const SharedIntegers& unscaled() const {
    // Asked for every coordinate: looking at a flag of this lattice's own costs less than call_once.
    if (const SharedIntegers* made = unscaled_.load(std::memory_order_acquire); made != nullptr) return *made;
    std::call_once(integers->made, [this] {
      for (int op = 0; op < 2; ++op)
        for (const Point& v : points[op]->input)
          integers->at[op].push_back(
              {exact::grid_coordinate<exact::Int<125>>(v.x, points[op]->offset.x, exponent_).raw(),
               exact::grid_coordinate<exact::Int<125>>(v.y, points[op]->offset.y, exponent_).raw()});
    });
    unscaled_.store(integers.get(), std::memory_order_release);
    return *integers;
  }
  // All integers are made when as many have been requested.
  void fill() const {
    const std::lock_guard lock(filling_);
    if (filled_.load(std::memory_order_relaxed)) return;
    for (std::uint32_t op = 0; op < 2; ++op) {
      if constexpr (kKept<C>) {
        const auto add = [&](const Big& x, const Big& y) {
          integers_[op].push_back({exact::narrowed<C>(x), exact::narrowed<C>(y)});
        };
        if (const TurnedPoints* turned = points[op]->turned.get(); turned != nullptr) {
          for (std::uint32_t i = 0; i < turned->size(); ++i)
            if (turned->at.empty()) add(Big(turned->big[i][0]), Big(turned->big[i][1]));
            else add(exact::to_big(turned->at[i][0]), exact::to_big(turned->at[i][1]));
          continue;
        }
      }
      for (std::uint32_t i = 0; i < points[op]->input.size(); ++i)
        integers_[op].push_back(scale_ ? scaled_integer(op, i) : integer(op, i));
    }
    filled_.store(true, std::memory_order_release);
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

  // Whether a position is a sum of two vertices, which tells everything without a parameter.
  static bool is_vertex(const SegmentPosition& x) { return !x.between && x.first.kind == Cut::Kind::pair; }
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
  WideRatio made_ratio(const SegmentPosition& x) const {
    const Ratio a = parameter(x.on, x.first);
    if (!x.between) return {Wide(a.n), Wide(a.d)};
    const Ratio b = parameter(x.on, x.second);
    return {a.n + b.n, a.d + b.d};
  }
  // Whoever asks about a position asks about many segments, one after the other: each thread remembers the last place.
  // By the lattice's own number, as another one may have its address later.
  WideRatio ratio(const SegmentPosition& x) const {
    // Small numbers are made sooner than looked up.
    if constexpr (std::is_same_v<C, Big> || std::is_same_v<C, exact::Int<29>>) {
      return made_ratio(x);
    } else {
      struct Last {
        std::uint64_t lattice = 0;
        Segment on;
        Cut first, second;
        bool between = false;
        WideRatio ratio;
      };
      static thread_local Last last;
      if (last.lattice != number_ || last.between != x.between || !same_segment(last.on, x.on) ||
          !same_cut(last.first, x.first) || (x.between && !same_cut(last.second, x.second)))
        last = {number_, x.on, x.first, x.second, x.between, made_ratio(x)};
      return last.ratio;
    }
  }
  static bool same_segment(const Segment& a, const Segment& b) {
    return a.edge.op == b.edge.op && a.edge.from == b.edge.from && a.edge.to == b.edge.to && a.vertex == b.vertex;
  }
  static bool same_cut(const Cut& a, const Cut& b) {
    return a.kind == b.kind && (a.kind == Cut::Kind::pair ? a.pair == b.pair : same_segment(a.by, b.by));
  }
  static std::uint64_t next_number() {
    static std::atomic<std::uint64_t> last = 0;
    return last.fetch_add(1, std::memory_order_relaxed) + 1;
  }
  int sign_at(const SegmentPosition& x, const Value& at_start, const Value& slope) const {
    const WideRatio t = ratio(x);
    return exact::sign(t.d * at_start + t.n * slope);
  }

  std::uint64_t number_ = next_number();
  int exponent_;
  double per_double_;
  std::optional<LatticeScale> scale_;
  std::array<Vec, 2> factor_{};  // of the integers, where scaled
  mutable std::atomic<std::size_t> queried_ = 0;
  mutable std::mutex filling_;
  mutable std::atomic<bool> filled_ = false;
  mutable std::atomic<const SharedIntegers*> unscaled_ = nullptr;  ///< `integers`, once they are made
  mutable std::array<std::vector<Vec>, 2> integers_;
  mutable std::once_flag fine_made_;
  mutable std::optional<FineLattice> fine_;  // where numbers are kept
  mutable std::once_flag origin_made_;
  mutable std::array<exact::BigInteger, 2> origin_;
};

}  // namespace

Lattice::Position Lattice::position(const SegmentPosition& x) const { return reduced(homogeneous(x)); }

Lattice::Position Lattice::position(Pair v) const { return reduced(homogeneous(v)); }

std::shared_ptr<const Lattice> build_lattice(LatticePoints points, std::optional<LatticeScale> scale,
                                             int min_tier_bits) {
  const int points_bits = points.bits;
  const exact::Tier tier = exact::choose_tier(points_bits, min_tier_bits);
  const double per_double = integers_per_double(points, scale);
  LatticeDoubles doubles = lattice_doubles(points, scale);
  doubles.tier_bits = static_cast<int>(tier);
  if (tier == exact::Tier::b29) doubles.to_integers = per_double;
  switch (tier) {
    case exact::Tier::b29:
      return std::make_shared<LatticeOf<exact::Int<29>>>(std::move(doubles), per_double, std::move(scale));
    case exact::Tier::b61:
      return std::make_shared<LatticeOf<exact::Int<61>>>(std::move(doubles), per_double, std::move(scale));
    case exact::Tier::b512:
      return std::make_shared<LatticeOf<exact::Int<125>>>(std::move(doubles), per_double, std::move(scale));
    case exact::Tier::arbitrary:
      break;
  }
  // What scales and angles of events make of short coordinates: numbers of a fixed width, without an allocation each.
  constexpr int kEvents = 381;
  if (points_bits <= kEvents && min_tier_bits <= static_cast<int>(exact::Tier::b512))
    return std::make_shared<LatticeOf<exact::Int<kEvents>>>(std::move(doubles), per_double, std::move(scale));
  return std::make_shared<LatticeOf<Big>>(std::move(doubles), per_double, std::move(scale));
}

void round_position(const Lattice& lattice, SegmentPosition& position) {
  const Pair start = start_of(position.on);
  const Lattice::Position at = lattice.position(position), from = lattice.position(start);
  const PlacedPoints &p = *lattice.points[0], &q = *lattice.points[1];
  const exact::BigRational unit = exact::exact_value(lattice.unit);
  position.x = p.x[start.p] + q.x[start.q] + exact::round_to_double(exact::BigRational((at.x - from.x) / unit));
  position.y = p.y[start.p] + q.y[start.q] + exact::round_to_double(exact::BigRational((at.y - from.y) / unit));
  position.error = kRoundedPosition * lattice.span;
}

}  // namespace dymsum::planar
