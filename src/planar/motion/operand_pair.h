// What never changes while an operand moves: the operands, their lattice and walks as they were given; and where
// everything stands when it is scaled or turned.
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <variant>

#include "dymsum/frames.h"
#include "dymsum/orientation.h"
#include "planar/boundary/collision.h"
#include "planar/operand/operand.h"
#include "planar/operand/scale_value.h"
#include "planar/result/finish_sum.h"

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

}  // namespace dymsum::planar
