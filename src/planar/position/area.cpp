#include "planar/position/area.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "exact/big.h"
#include "exact/rounding_bound.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {
namespace {

using exact::BigInteger;

/// A fraction with a product of known factors as denominator.
struct Fraction {
  BigInteger numerator, denominator;
};

/// The cross products of edges first .. last - 1 of a ring sum up to numerator / (w(first) denominator w(last)). Two
/// neighbours share one w, so every w enters the denominator once.
Fraction chain_sum(std::span<const Homogeneous> ring, std::size_t first, std::size_t last) {
  const Homogeneous& a = ring[first];
  const Homogeneous& b = ring[last % ring.size()];
  if (last - first == 1) return {a.x * b.y - b.x * a.y, 1};
  const std::size_t midpoint = (first + last) / 2;
  const Fraction left = chain_sum(ring, first, midpoint), right = chain_sum(ring, midpoint, last);
  const BigInteger after = right.denominator * b.w, before = a.w * left.denominator;
  const BigInteger shared = left.denominator * ring[midpoint].w;
  return {left.numerator * after + right.numerator * before, shared * right.denominator};
}

/// Unreduced sum of the rings' cross products.
Fraction ring_sums(std::span<const std::vector<Homogeneous>> rings) {
  if (rings.size() == 1) {
    const std::vector<Homogeneous>& ring = rings[0];
    Fraction sum = chain_sum(ring, 0, ring.size());
    sum.denominator *= ring[0].w * ring[0].w;
    return sum;
  }
  const Fraction left = ring_sums(rings.first(rings.size() / 2)), right = ring_sums(rings.subspan(rings.size() / 2));
  return {left.numerator * right.denominator + right.numerator * left.denominator,
          left.denominator * right.denominator};
}

}  // namespace

Rational ExactArea::to_rational() const { return exact::to_rational(numerator, denominator); }

// The quotient's first 64 bits or more, and a last bit set when something follows: this rounds as the quotient does.
double ExactArea::to_double() const {
  if (numerator.is_zero()) return 0;
  const BigInteger magnitude = abs(numerator);
  const auto shift = static_cast<std::int64_t>(msb(denominator)) - static_cast<std::int64_t>(msb(magnitude)) + 64;
  BigInteger quotient, remainder;
  if (shift >= 0) divide_qr(BigInteger(magnitude << shift), denominator, quotient, remainder);
  else divide_qr(magnitude, BigInteger(denominator << -shift), quotient, remainder);
  quotient <<= 1;
  if (!remainder.is_zero()) quotient += 1;
  if (numerator.sign() < 0) quotient = -quotient;
  const BigInteger scale = BigInteger(1) << (shift >= 0 ? shift + 1 : -shift);
  if (shift >= 0) return exact::round_to_double(exact::BigRational(quotient, scale));
  return exact::round_to_double(exact::BigRational(quotient * scale, 2));
}

namespace {

/// All vertices in units of one power of two, the largest of all denominators: what is left of these is odd. Returns
/// its exponent.
unsigned leave_odd(std::vector<std::vector<Homogeneous>>& rings) {
  unsigned twos = 0;
  for (const auto& ring : rings)
    for (const Homogeneous& v : ring) twos = std::max(twos, static_cast<unsigned>(lsb(v.w)));
  for (auto& ring : rings)
    for (Homogeneous& v : ring) {
      const auto own = static_cast<unsigned>(lsb(v.w));
      v.w >>= own;
      v.x <<= twos - own;
      v.y <<= twos - own;
    }
  return twos;
}

}  // namespace

ExactArea exact_area(const std::vector<std::vector<Position>>& rings) {
  std::vector<std::vector<Homogeneous>> vertices(rings.size());
  for (std::size_t i = 0; i < rings.size(); ++i)
    for (const Position& p : rings[i]) vertices[i].push_back(homogeneous(p));
  return exact_area(std::move(vertices));
}

// The odd factors of the denominator are known; twos are counted.
ExactArea exact_area(std::vector<std::vector<Homogeneous>> rings) {
  std::erase_if(rings, [](const std::vector<Homogeneous>& ring) { return ring.empty(); });
  if (rings.empty()) return {};
  const unsigned twos = 2 * leave_odd(rings) + 1;
  std::vector<BigInteger> factors{1};
  for (const std::vector<Homogeneous>& ring : rings) {
    for (const Homogeneous& v : ring)
      if (v.w != 1) factors.push_back(v.w);
    if (ring[0].w != 1) factors.push_back(ring[0].w);
  }
  Fraction sum = ring_sums(rings);
  if (sum.numerator.is_zero()) return {};
  const BigInteger common = exact::gcd_with_product(factors, sum.numerator);
  const unsigned shared = std::min(twos, static_cast<unsigned>(lsb(abs(sum.numerator))));
  return {BigInteger(sum.numerator / common) >> shared, BigInteger(sum.denominator / common) << (twos - shared)};
}

namespace {

using base::DoublePair;
using exact::BigRational;

template <class Visit>
void each_ring(const PlanarSum& sum, Visit visit) {
  for (const SumPart& part : sum.parts) {
    visit(part.outer);
    for (const SumRing& hole : part.holes) visit(hole);
  }
}

const ExactSource& source_of(const PlanarSum& sum) {
  if (!exact_source(sum)) throw std::logic_error("PlanarSum: vertices without exact positions");
  return *exact_source(sum);
}

BigRational exact_value(DoublePair v) { return exact::exact_value(v.high) + exact::exact_value(v.low); }

/// Twice the area in pairs of doubles, with its error. The cross product of positions a and b that err by e and f errs
/// by (|ax| + |ay|) f + (|bx| + |by|) e + 2 e f, and each of its operations by kPairError of its result, or less
/// than kUnderflow where that underflows. The error is added up in doubles, hence the factor in the end: fewer than
/// 16 roundings for each of at most 2^32 vertices.
class PairSum {
 public:
  explicit PairSum(const ExactSource& source) : source_(source) {}

  void add(const SumRing& ring) {
    const ExactSource::NearPosition first = source_.near(ring.vertices[0]);
    ExactSource::NearPosition a = first;
    for (std::size_t k = 1; k < ring.vertices.size(); ++k) {
      const ExactSource::NearPosition b = source_.near(ring.vertices[k]);
      add(a, b);
      a = b;
    }
    add(a, first);
  }

  DoublePair twice() const { return twice_; }
  double error() const { return error_ * kAddedUp; }

 private:
  static constexpr double kAddedUp = 1 + 0x1p-10;
  static_assert((std::uint64_t{1} << 32) * 16 * exact::kRoundoff < (kAddedUp - 1) / 2);

  void add(const ExactSource::NearPosition& a, const ExactSource::NearPosition& b) {
    const DoublePair left = a.x * b.y, right = b.x * a.y;
    twice_ = twice_ + (left - right);
    error_ += (std::abs(a.x.high) + std::abs(a.y.high)) * b.error +
              (std::abs(b.x.high) + std::abs(b.y.high)) * a.error + 2 * a.error * b.error +
              base::kPairError * (2 * (std::abs(left.high) + std::abs(right.high)) + std::abs(twice_.high)) +
              exact::kUnderflow;
  }

  const ExactSource& source_;
  DoublePair twice_;
  double error_ = 0;
};

/// The range by pairs of doubles, relative to where the source measures from: the area does not depend on it.
std::optional<AreaRange> pair_range(const PlanarSum& sum) {
  const std::optional<ExactSource::NearFrame> frame = exact_source(sum)->near_frame();
  if (!frame) return std::nullopt;
  PairSum total(*exact_source(sum));
  each_ring(sum, [&](const SumRing& ring) { total.add(ring); });
  if (!std::isfinite(total.twice().high) || !std::isfinite(total.error())) return std::nullopt;
  const BigRational twice = exact_value(total.twice()), error = exact::exact_value(total.error());
  const BigRational half = frame->unit * frame->unit / 2;
  return AreaRange{(twice - error) * half, (twice + error) * half};
}

/// The largest coordinate of a vertex, roughly: more only makes units coarser.
double largest_coordinate(const PlanarSum& sum) {
  double largest = sum.at_error;
  each_ring(sum, [&](const SumRing& ring) {
    for (const SumVertex& v : ring.vertices) largest = std::max({largest, std::abs(v.at.x), std::abs(v.at.y)});
  });
  return largest;
}

/// Positions rounded down to multiples of 2^-shift.
class Multiples {
 public:
  Multiples(const ExactSource& source, int shift) : source_(source), shift_(shift) {}

  struct Vertex {
    BigInteger x, y;
  };
  Vertex at(const SumVertex& v) {
    ExactSource::Homogeneous p = source_.homogeneous(v);
    if (shift_ < 0) p.w <<= -shift_;
    return {multiple(std::move(p.x), p.w), multiple(std::move(p.y), p.w)};
  }
  bool exact() const { return exact_; }
  const BigInteger& largest() const { return largest_; }

 private:
  BigInteger multiple(BigInteger n, const BigInteger& w) {
    if (shift_ > 0) n <<= shift_;
    BigInteger quotient, remainder;
    divide_qr(n, w, quotient, remainder);  // towards zero
    exact_ = exact_ && remainder.is_zero();
    if (const BigInteger magnitude = abs(quotient); magnitude > largest_) largest_ = magnitude;
    return quotient;
  }

  const ExactSource& source_;
  int shift_;
  bool exact_ = true;
  BigInteger largest_ = 0;
};

/// The range by multiples of 2^-bits of the largest coordinate. Coordinates X err by less than 1, so each of n cross
/// products by less than 4 max |X| + 2.
AreaRange multiple_range(const PlanarSum& sum, int bits) {
  const double largest = largest_coordinate(sum);
  const int shift = bits - (largest > 0 ? std::ilogb(largest) : 0);
  Multiples multiples(*exact_source(sum), shift);
  BigInteger twice = 0;
  each_ring(sum, [&](const SumRing& ring) {
    const Multiples::Vertex first = multiples.at(ring.vertices[0]);
    Multiples::Vertex a = first;
    for (std::size_t k = 1; k <= ring.vertices.size(); ++k) {
      const Multiples::Vertex b = k < ring.vertices.size() ? multiples.at(ring.vertices[k]) : first;
      twice += a.x * b.y - b.x * a.y;
      a = b;
    }
  });
  const BigInteger error =
      multiples.exact() ? BigInteger(0) : BigInteger(sum.vertex_count() * (4 * multiples.largest() + 2));
  const int scale = 2 * shift + 1;
  const auto value = [&](const BigInteger& n) {
    return scale >= 0 ? BigRational(n, BigInteger(1) << scale) : BigRational(BigInteger(n << -scale));
  };
  return {value(twice - error), value(twice + error)};
}

/// The position in lowest terms. Powers of two, which is what corners have, need no greatest common divisor.
ExactSource::Homogeneous lowest(ExactSource::Homogeneous p) {
  const auto shared = [&](const BigInteger& n) { return n.is_zero() ? lsb(p.w) : std::min(lsb(abs(n)), lsb(p.w)); };
  const auto twos = std::min(shared(p.x), shared(p.y));
  p.x >>= twos;
  p.y >>= twos;
  p.w >>= twos;
  if (msb(p.w) == lsb(p.w)) return p;
  const BigInteger common = gcd(gcd(p.x, p.w), p.y);
  return {p.x / common, p.y / common, p.w / common};
}

/// The bits that a denominator brings to the product of all, powers of two apart.
std::size_t odd_bits(const BigInteger& w) { return msb(w) == lsb(w) ? 0 : msb(w) - lsb(w) + 1; }

/// The exact area where the denominators have no more than `bits` bits together.
std::optional<ExactArea> area_of(const PlanarSum& sum, std::size_t bits) {
  std::vector<std::vector<ExactSource::Homogeneous>> rings;
  std::size_t total = 0;
  each_ring(sum, [&](const SumRing& ring) {
    std::vector<ExactSource::Homogeneous>& to = rings.emplace_back();
    to.reserve(ring.vertices.size());
    for (std::size_t k = 0; k < ring.vertices.size() && total <= bits; ++k) {
      to.push_back(lowest(exact_source(sum)->homogeneous(ring.vertices[k])));
      total += odd_bits(to.back().w);
    }
  });
  if (total > bits) return std::nullopt;
  return exact_area(std::move(rings));
}

constexpr std::size_t kAnyLength = std::numeric_limits<std::size_t>::max();

}  // namespace

void narrow_area(const PlanarSum& sum, const std::function<bool(const AreaRange&)>& decide) {
  if (sum.parts.empty()) {
    decide({0, 0});
    return;
  }
  source_of(sum);
  if (const std::optional<AreaRange> range = pair_range(sum); range && decide(*range)) return;
  for (const int bits : {256, 1024})
    if (decide(multiple_range(sum, bits))) return;
  const ExactArea area = *area_of(sum, kAnyLength);
  const BigRational value(area.numerator, area.denominator);
  decide({value, value});
}

double nearest_area(const PlanarSum& sum) {
  double area = 0;
  narrow_area(sum, [&](const AreaRange& range) {
    area = exact::round_to_double(range.first);
    return exact::round_to_double(range.second) == area;
  });
  return area;
}

Rational area_fraction(const PlanarSum& sum) { return *area_within(sum, kAnyLength); }

std::optional<Rational> area_within(const PlanarSum& sum, std::size_t bits) {
  if (sum.parts.empty()) return Rational();
  source_of(sum);
  const std::optional<ExactArea> area = area_of(sum, bits);
  if (!area) return std::nullopt;
  return area->to_rational();
}

}  // namespace dymsum::planar
