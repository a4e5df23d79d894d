// Whether positions lie in the sum of two solids, by definition. Fractions are looked at in units of their common
// denominator.
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include "dymsum/spatial_sum.h"
#include "exact/big.h"
#include "spatial/boundary/collision.h"
#include "spatial/boundary/thin_crossings.h"

namespace dymsum {

namespace {

using exact::BigInteger;
using exact::BigRational;
using spatial::Collision;
using spatial::Flag;
using spatial::PointSource;
using spatial::SolidOperand;
using spatial::SumSpace;

using Rationals = std::array<BigRational, 3>;

std::optional<double> double_of(const BigRational& value) {
  const double nearest = exact::round_to_double(value);
  if (!std::isfinite(nearest) || exact::exact_value(nearest) != value) return std::nullopt;
  return nearest;
}

/// A position as the sum of two that doubles hold.
struct SplitPosition {
  Point3 p, q;
};

std::optional<std::array<double, 2>> split(const BigRational& value) {
  const double high = exact::round_to_double(value);
  if (!std::isfinite(high)) return std::nullopt;
  const std::optional<double> low = double_of(value - exact::exact_value(high));
  return low ? std::optional(std::array{high, *low}) : std::nullopt;
}

std::optional<SplitPosition> split(const Rationals& at, const BigInteger& scale) {
  const auto x = split(BigRational(at[0] * scale)), y = split(BigRational(at[1] * scale)),
             z = split(BigRational(at[2] * scale));
  if (!x || !y || !z) return std::nullopt;
  return SplitPosition{{(*x)[0], (*y)[0], (*z)[0]}, {(*x)[1], (*y)[1], (*z)[1]}};
}

/// The vertices times a number, where doubles hold them.
std::optional<std::vector<Point3>> times(const std::vector<Point3>& vertices, const BigInteger& scale) {
  if (scale == 1) return vertices;
  std::vector<Point3> result;
  for (const Point3& v : vertices) {
    const auto x = double_of(exact::exact_value(v.x) * scale), y = double_of(exact::exact_value(v.y) * scale),
               z = double_of(exact::exact_value(v.z) * scale);
    if (!x || !y || !z) return std::nullopt;
    result.push_back({*x, *y, *z});
  }
  return result;
}

/// The smallest odd number whose fractions the coordinates are, up to powers of two.
BigInteger odd_denominator(const Rationals& at) {
  BigInteger all = 1;
  for (const BigRational& c : at) {
    const BigInteger below = denominator(c);
    all = lcm(all, BigInteger(below >> lsb(below)));
  }
  return all;
}

Error error_of(const char* message) { return {ErrorCode::unsupported_operand, message, {}}; }

class Membership {
 public:
  Membership(const Mesh& p, const Mesh& q, Semantics semantics)
      : p_(p),
        q_(q),
        open_(semantics == Semantics::open),
        a_(spatial::solid_operand(p.data(), p.thin_faces(), spatial::FlatFeatures::kept)),
        b_(spatial::solid_operand(q.data(), q.thin_faces(), spatial::FlatFeatures::kept)) {}

  /// Positions in fractions of one number.
  Result<std::vector<bool>> run(const std::vector<Rationals>& positions, const BigInteger& scale) const {
    std::optional<std::vector<Point3>> p = times(p_.vertices(), scale), q = times(q_.vertices(), scale);
    if (!p || !q)
      return error_of(
          "no doubles hold the operands' coordinates times this position's denominator: ask for a position of doubles");
    // Each is the sum of one more vertex of both, of which no triangle knows.
    const auto first_p = static_cast<std::uint32_t>(p->size()), first_q = static_cast<std::uint32_t>(q->size());
    for (const Rationals& at : positions) {
      const std::optional<SplitPosition> parts = split(at, scale);
      if (!parts) return error_of("no two doubles add up to a coordinate of this position");
      p->push_back(parts->p);
      q->push_back(parts->q);
    }
    try {
      return answers(*spatial::make_sum_space(*p, *q), first_p, first_q, static_cast<std::uint32_t>(positions.size()));
    } catch (const std::invalid_argument& e) {
      return error_of(e.what());
    }
  }

 private:
  Result<std::vector<bool>> answers(const SumSpace& space, std::uint32_t first_p, std::uint32_t first_q,
                                    std::uint32_t count) const {
    if (p_.has_thin_parts() && q_.has_thin_parts() && spatial::find_thin_crossing(space, a_, b_))
      return error_of("both operands have parts without volume that can cross");
    const Collision collision(space, a_, b_);
    std::vector<bool> inside;
    for (std::uint32_t k = 0; k < count; ++k) {
      const Flag flag{{PointSource::Kind::sum, first_p + k, first_q + k, 0}, 0, 0, 0, 0, 0};
      inside.push_back(open_ ? collision.overlaps(flag) : collision.touches(flag));
    }
    return inside;
  }

  const Mesh &p_, &q_;
  bool open_;
  SolidOperand a_, b_;
};

Error at_position(Error error, const RationalPoint3& z) {
  error.evidence.x = z.x.to_double(), error.evidence.y = z.y.to_double(), error.evidence.z = z.z.to_double();
  return error;
}

}  // namespace

Result<std::vector<bool>> contains_each(const Mesh& p, const Mesh& q, std::span<const RationalPoint3> positions,
                                        Semantics semantics) {
  std::vector<bool> inside(positions.size());
  if (p.empty() || q.empty()) return inside;
  if (p.has_thin_parts() && q.has_thin_parts() && semantics != Semantics::open)
    return error_of("both operands have parts without volume: only the open sum of such can be asked");
  std::map<BigInteger, std::vector<std::size_t>> same;  // indices by denominators
  std::vector<Rationals> at;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const RationalPoint3& z = positions[k];
    at.push_back({exact::exact_value(z.x), exact::exact_value(z.y), exact::exact_value(z.z)});
    same[odd_denominator(at.back())].push_back(k);
  }
  const Membership membership(p, q, semantics);
  for (const auto& [scale, indices] : same) {
    std::vector<Rationals> some;
    for (const std::size_t k : indices) some.push_back(at[k]);
    const Result<std::vector<bool>> together = membership.run(some, scale);
    for (std::size_t k = 0; k < indices.size(); ++k) {
      // One position may need a grid that is too fine for another one.
      const Result<std::vector<bool>> single =
          together ? Result<std::vector<bool>>(std::vector<bool>{(*together)[k]}) : membership.run({some[k]}, scale);
      if (!single) return at_position(single.error(), positions[indices[k]]);
      inside[indices[k]] = (*single)[0];
    }
  }
  return inside;
}

Result<bool> contains(const Mesh& p, const Mesh& q, const Point3& z, Semantics semantics) {
  const Result<Rational> x = Rational::of(z.x), y = Rational::of(z.y), height = Rational::of(z.z);
  if (!x || !y || !height) return false;
  const RationalPoint3 at{*x, *y, *height};
  const Result<std::vector<bool>> inside = contains_each(p, q, std::span(&at, 1), semantics);
  if (!inside) return inside.error();
  return (*inside)[0];
}

}  // namespace dymsum
