// What a result of Boolean operations stands for: rings as they were given, and the operations on them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dymsum/fill.h"
#include "dymsum/planar_boolean.h"
#include "planar/position/exact_source.h"

namespace dymsum::planar {

/// A set bounded by closed rings.
struct RingSet {
  std::vector<Ring> rings;
  Fill fill = Fill::positive;
  /// The exact positions of all vertices, ring after ring, where some are no doubles: `rings` has the nearest doubles
  /// then. Otherwise none.
  std::vector<exact::HomogeneousPoint> fractions;
};

/// Whether a cell - a face, an edge, a node - lies in a set: in its closure, in its interior. Faces lie in both or in
/// none.
struct Membership {
  bool closed = false, open = false;
};

/// An expression in postfix order: an index of an input is a step, or one of the operations.
struct BooleanTerms {
  static constexpr std::int32_t kNot = -1, kAnd = -2, kOr = -3;

  std::vector<std::shared_ptr<const RingSet>> inputs;  ///< each once
  std::vector<std::int32_t> steps;

  /// Appends the steps of another expression, with its inputs among those of this one.
  void append(const BooleanTerms& other);
  /// The membership of a cell, given that in every input. The complement of a closed set is open. `stack` is scratch.
  Membership evaluate(std::span<const Membership> inputs, std::vector<Membership>& stack) const;
};

/// The source of a result that keeps what it stands for.
class BooleanSource final : public ExactSource {
 public:
  BooleanSource(std::shared_ptr<const ExactSource> positions, BooleanTerms terms)
      : positions_(std::move(positions)), terms_(std::move(terms)) {}
  const BooleanTerms& terms() const { return terms_; }

  Position position(const SumVertex& v) const override { return positions_->position(v); }
  Homogeneous homogeneous(const SumVertex& v) const override { return positions_->homogeneous(v); }
  std::optional<NearFrame> near_frame() const override { return positions_->near_frame(); }
  NearPosition near(const SumVertex& v) const override { return positions_->near(v); }
  std::optional<Point> rounded_once(const SumVertex& v) const override { return positions_->rounded_once(v); }
  int compare_x(const SumVertex& a, const SumVertex& b) const override { return positions_->compare_x(a, b); }
  int compare_y(const SumVertex& a, const SumVertex& b) const override { return positions_->compare_y(a, b); }

 private:
  std::shared_ptr<const ExactSource> positions_;
  BooleanTerms terms_;
};

/// a and not b.
void append_difference(const BooleanTerms& a, const BooleanTerms& b, BooleanTerms& to);

/// What an expression stands for. Errors: as the operations of planar_boolean.h.
Result<PlanarSum> evaluate(BooleanTerms terms, const SumOptions& options);

/// The parts of an operand by their rings, also of a result that keeps what made it: indices are the operand's own.
BooleanTerms terms_of_parts(const PlanarOperand& operand);

/// An operand as an expression; polylines and points are left out for regular semantics. Errors: as the operations of
/// planar_boolean.h.
Result<BooleanTerms> terms_of(const PlanarOperand& operand, Semantics semantics);

}  // namespace dymsum::planar
