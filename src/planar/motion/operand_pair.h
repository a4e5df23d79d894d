// What never changes while an operand moves: the operands, their lattice and walks as they were given; where
// everything stands when it is scaled or turned; and the signs as polynomials of a scale.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <variant>
#include <vector>

#include "dymsum/frames.h"
#include "dymsum/orientation.h"
#include "planar/boundary/collision.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"
#include "planar/operand/scale_value.h"
#include "planar/result/planar_sum.h"

namespace dymsum::planar {

/// How the moved operand stands, exactly: scaled, or turned.
using Placement = std::variant<LatticeScale, Orientation>;

/// What numbers a pair may have: all of them for sums at rest, narrow ones (not Lattice::wide) for those that move.
enum class Spread { narrow, any };

class OperandPair : public std::enable_shared_from_this<OperandPair> {
 public:
  /// A pair of operands, with further source vertices after their own that belong to no walk. Errors:
  /// unsupported_operand.
  static Result<std::shared_ptr<const OperandPair>> create(const std::array<std::shared_ptr<const Operand>, 2>& kept,
                                                           const std::array<std::vector<Point>, 2>& further,
                                                           std::uint32_t moved, int min_tier_bits,
                                                           Spread spread = Spread::narrow);

  std::uint32_t moved = 0;  ///< the operand that is scaled or turned
  int min_tier_bits = 0;
  std::shared_ptr<const Lattice> given;    ///< as they were given
  std::shared_ptr<const Lattice> lattice;  ///< the same, or with the moved operand stretched
  std::array<Operand, 2> operands;
  std::array<double, 2> width{}, height{};  ///< of the operands, in the lattice's doubles
  bool regular = true;                      ///< every component has area
  bool connected = true;                    ///< one component each

  /// The same operands with the moved one stretched: its uniform scales s are diag(s x, s y) of the one that was given.
  /// Doubles carry three roundings there. Requires: this is as it was given; x and y from 2^-kFactorBits to 1.
  std::shared_ptr<const OperandPair> stretched(const ScaleValue& x, const ScaleValue& y) const;
  /// Whether doubles stay as moderate when the moved operand is stretched as they are without that.
  bool may_be_stretched() const;
  static constexpr int kFactorBits = 32;

  /// diag(x, y) times the moved operand as it was given.
  LatticeScale lattice_scale(const ScaleValue& x, const ScaleValue& y) const;
  /// s times the moved operand as it is here.
  LatticeScale lattice_scale(const ScaleValue& s) const;
  std::shared_ptr<const Lattice> lattice_at(const Placement& at) const;
  /// The walks with edge vectors of a lattice.
  std::shared_ptr<const Operand> operand_at(std::uint32_t op, const Lattice& at) const;
  PlacedPair placed_on_lattice(std::shared_ptr<const Lattice> at) const;
  PlacedPair placed(const Placement& at) const { return placed_on_lattice(lattice_at(at)); }

 private:
  void place(const std::array<std::shared_ptr<const Operand>, 2>& placed);

  std::array<ScaleValue, 2> factors_;  ///< of the moved operand, along x and y
};

struct PairOptions {
  std::uint32_t moved = 0;                         ///< operand
  bool reflect_q = false;                          ///< P (+) -Q
  std::array<std::vector<Point>, 2> further = {};  ///< source vertices that belong to no walk
  int min_tier_bits = 0;
  Spread spread = Spread::narrow;
};

/// P as operand 0, Q as operand 1. Errors: unsupported_operand; out_of_range for options.
Result<std::shared_ptr<const OperandPair>> pair_of_regions(const Region& p, const Region& q,
                                                           const PairOptions& options = {});
Result<std::shared_ptr<const OperandPair>> pair_of_regions(const Region& p, const Region& q,
                                                           const MovingOptions& options);

// One frame, exactly: the operands where they stand, signs and collision tests there, and the positions of the sum's
// vertices. All of it is made when first requested.

class ExactFrame {
 public:
  ExactFrame(std::shared_ptr<const OperandPair> base, const ScaleValue& s)
      : base_(std::move(base)), value_(s), at_(base_->lattice_scale(s)) {}
  ExactFrame(std::shared_ptr<const OperandPair> base, Orientation theta)
      : base_(std::move(base)), at_(std::move(theta)) {}

  const OperandPair& base() const { return *base_; }
  const Placement& at() const { return at_; }
  const Lattice& lattice();
  const Operand& operand(std::uint32_t op);
  Collision& collision();
  bool has_lattice() const { return lattice_ != nullptr; }
  bool has_collision() const { return collision_ != nullptr; }
  PlacedPair placed();
  /// Whether the face to the right of a sub-edge lies in the open sum: of a segment, from the crossing with one to that
  /// with another, without which it begins or ends with the segment.
  bool inside_right_of(const Segment& on, const std::optional<Segment>& from, const std::optional<Segment>& to);
  std::uint64_t exact_signs = 0;  ///< without those of collision tests
  std::uint64_t all_signs() const { return exact_signs + (has_collision() ? collision_->counts().signs.exact() : 0); }

  /// What a scaling has: the scale, the parameter of a window whose operand `moving` moves, and what the window's
  /// coordinates are multiplied by.
  const ScaleValue& value() const { return value_; }
  const LatticeScale& scale() const { return std::get<LatticeScale>(at_); }
  double tau(std::uint32_t moving) const;
  double blow_up(std::uint32_t moving) const { return moving == base_->moved ? 1 : value_.approx; }

 private:
  std::shared_ptr<const OperandPair> base_;
  ScaleValue value_;
  Placement at_;
  std::shared_ptr<const Lattice> lattice_;
  std::array<std::shared_ptr<const Operand>, 2> operands_;
  std::unique_ptr<Collision> collision_;
};

/// Exact positions of the vertices of a frame's sum. The operands are placed when first requested. Most comparisons of
/// coordinates are decided without them.
class FrameSource final : public ExactSource {
 public:
  FrameSource(std::shared_ptr<const OperandPair> base, Placement at) : base_(std::move(base)), at_(std::move(at)) {}
  Position position(const SumVertex& vertex) const override { return source().position(vertex); }
  Homogeneous homogeneous(const SumVertex& vertex) const override { return source().homogeneous(vertex); }
  std::optional<NearFrame> near_frame() const override { return source().near_frame(); }
  NearPosition near(const SumVertex& vertex) const override { return source().near(vertex); }
  int compare_x(const SumVertex& a, const SumVertex& b) const override { return compare(a, b, 0); }
  int compare_y(const SumVertex& a, const SumVertex& b) const override { return compare(a, b, 1); }

 private:
  int compare(const SumVertex& a, const SumVertex& b, int axis) const;
  bool on_common_line(const SumVertex& a, const SumVertex& b, int axis) const;
  std::optional<int> compare_corners(const SumVertex& a, const SumVertex& b, int axis) const;
  const SumSource& source() const;

  std::shared_ptr<const OperandPair> base_;
  Placement at_;
  mutable std::once_flag made_;
  mutable std::unique_ptr<const SumSource> source_;
};

// The signs of the convolution as polynomials of the scale s: linear, with integer coefficients.
// docs/design/scaling-sum.md, "Numbers".

/// a + b s.
struct ExactForm {
  exact::BigInteger a = 0, b = 0;
  bool always_zero() const { return a == 0 && b == 0; }
  /// The one positive scale at which it vanishes, if it is not constant.
  std::optional<exact::BigRational> root() const {
    if (b == 0 || a.sign() * b.sign() >= 0) return std::nullopt;
    return exact::ratio(exact::Big(exact::BigInteger(-a)), exact::Big(b));
  }
  int sign_at(const exact::BigRational& s) const {
    return exact::BigInteger(a * denominator(s) + b * numerator(s)).sign();
  }
};

class ExactForms {
 public:
  explicit ExactForms(const OperandPair& base);

  /// d x (v - start) for the unscaled edge d of the segment.
  ExactForm side(const Segment& s, Pair v) const;
  /// d . (v - start): with the scale's square, as both d and v scale; the sign of d . (v - start) over the edge's own
  /// length.
  ExactForm along(const Segment& s, Pair v) const;
  /// Vanishes where the lines of three segments meet in a point. Requires: no two of them parallel.
  ExactForm concurrent(const Segment& a, const Segment& b, const Segment& c) const;
  /// A hash of the line of a segment as it moves with s, and of its direction: equal for segments whose lines coincide
  /// at every scale.
  std::uint64_t line_hash(const Segment& s) const;

 private:
  struct Vec {
    exact::BigInteger x, y;
  };
  Vec edge(const Edge& e) const;
  ExactForm cross(const Vec& d, Pair v) const;

  std::uint32_t scaled_;
  std::array<std::vector<Vec>, 2> at_;  ///< relative to the operands' offsets
};

// What doubles lose in a window of scales.
//
// In units u of roundoff, for c(tau) = f + tau m in the window's frame, with L = |edge vector|_1, F the extent of the
// operand that stands still, M that of the moving one and S = F + 2 tau1 M the span. Fractions of a segment are
// multiples of its unscaled edge vector; within a piece they are at most max(1, tau). Coordinates and components of
// edge vectors carry 3 each: their own, and of an operand that is stretched (OperandPair::stretched) the factor's and
// the product's.
//   point    f and m carry 3 each, tau 1, the product and the sum 1 each: 4 F + 6 tau M <= 4 S. A position on a segment
//            carries 5 more: the edge vector, the product with the fraction, and the sum.
//   side     d x (v - w): two points and their difference 9, the edge vector 3, the product and the last difference 1
//            each: 14 L S. With the shift of the frame, whose sum is one more of at most F + tau1 M, a point has one
//            more. Ends of cut pieces carry 6 more: the edge vector, the products with its length and with the
//            fraction, and the sum.
//   share    numerator / denominator: what a side and the denominator lose, and the quotient (see fraction_error()).

/// The error of a sum's coordinate, or of one of a position on a segment, is this times the span.
inline constexpr double kWindowPoint = exact::rounding_bound(4 + 5, 16);
/// The error of a side is this times L and the span: with the shift, and both positions at cuts.
inline constexpr int kSideRoundings = 14;
inline constexpr double kWindowSide = exact::rounding_bound(kSideRoundings + 2 * 1 + 2 * 6, 32);
/// The error of a side of an edge that is scaled where it stands is this times |e|_1 and the span: two products with a
/// rounded tau (5 each, of parts of the span), their sum, the difference, edge vector (3), product and difference.
inline constexpr double kSearchSide = exact::rounding_bound(12, 32);

/// The error of a fraction a + b tau where it is evaluated is this times max(1, tau): product, sum and tau; a and b
/// that cancel are covered by the error of the fraction, which counts roundings of their size.
inline constexpr double kFraction = exact::rounding_bound(3, 16);
/// The same for two shares and their difference.
inline constexpr double kFractionGap = exact::rounding_bound(7, 32);
/// The error of a fraction by a scalar product of sums with an edge vector over its square is this times max(1, tau1):
/// 6 of the product, 8 of the square, the quotient and the evaluation. Besides, what the sums err by, times |d|_1 and
/// the span over the square: a side, and for a position farther on the same line a vector, its product and the sum.
inline constexpr int kProjectionRoundings = 6 + 8 + 1 + 3, kProjectedRoundings = kSideRoundings + 6;
inline constexpr double kProjection = exact::rounding_bound(kProjectionRoundings, 64),
                        kProjectedSums = exact::rounding_bound(kProjectedRoundings, 64);
/// The same for the difference of two.
inline constexpr double kProjectionGap = exact::rounding_bound(2 * kProjectionRoundings, 128),
                        kProjectedGap = exact::rounding_bound(2 * kProjectedRoundings, 128);

/// The error of -a / b, relatively: the quotient, and the sum that makes it an end of a range.
inline constexpr double kRoot = exact::rounding_bound(2, 16);
/// The error of tau is this times tau1: it is the double nearest to the scale.
inline constexpr double kTau = exact::rounding_bound(1, 8);

/// The error of a fraction of two crossing lines where it is evaluated is this times the sizes of what a and b make:
/// products, sums and tau.
inline constexpr double kFollowed = exact::rounding_bound(5, 8);
/// The errors of the weights of a mediant, relatively: a length alone; a cross product, over its own part of
/// cancellation, with the three factors that it is multiplied with; the sum and the quotient.
inline constexpr double kLengthWeight = exact::rounding_bound(3, 8), kCrossWeight = exact::rounding_bound(8 + 4, 32),
                        kMediant = exact::rounding_bound(3, 8);

/// The error of a position in input coordinates is this times the span: evaluation (3), the blow-up and the last sum;
/// times the offsets: the factor and its product, the scale, products and sums.
inline constexpr double kKeptPosition = exact::rounding_bound(6, 16), kKeptOffsets = exact::rounding_bound(7, 8);

/// Denominators d that are known to this fraction of themselves at most may be divided by.
inline constexpr double kKnownDenominator = 0.25;

/// The error of a fraction n / d: n errs by `numerator`, d by `relative` of itself, fractions that matter are at most
/// half of `reach`. A fraction t errs by (numerator / |d| + |t| relative) / (1 - relative) and three roundings; outside
/// of `reach` a wrong fraction cannot become a right one. Requires relative < kKnownDenominator.
inline double fraction_error(double numerator, double d, double relative, double reach) {
  constexpr double kDivided = 2, kRounded = exact::rounding_bound(3, 32);
  static_assert(kDivided >= 1 / (1 - kKnownDenominator));
  // Lists rely on more than twice what is counted (PieceLists::look_at_neighbours).
  static_assert(kDivided * kWindowSide > 2 / (1 - kKnownDenominator) * exact::rounding_bound(kSideRoundings, 16));
  return kDivided * (numerator / d + reach * relative) + kRounded * reach;
}

/// How far from the root of a + b tau its sign may still be wrong, when a + b tau is known up to `error`.
inline double root_error(double root, double slope, double error, double tau1) {
  return error / std::abs(slope) * exact::kOutwards + kRoot * std::abs(root) + kTau * tau1;
}

}  // namespace dymsum::planar
