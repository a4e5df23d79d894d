// What a result of Boolean operations stands for: rings as they were given, and the operations on them; inputs made
// one operand.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dymsum/fill.h"
#include "dymsum/planar_boolean.h"
#include "planar/operand/operand.h"
#include "planar/position/exact_source.h"
#include "planar/region/region.h"

namespace dymsum::planar {

/// A set bounded by closed rings, with closed polylines and points that have no interior.
struct RingSet {
  std::vector<Ring> rings;
  Fill fill = Fill::positive;
  std::vector<Polyline> lines;
  std::vector<Point> points;
  /// Of all vertices - rings, then lines, then points - where some are no doubles: those have the nearest doubles then.
  /// Otherwise none.
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

/// An operand as an expression; what has no interior is left out for regular semantics.
BooleanTerms terms_of(const PlanarOperand& operand, Semantics semantics);

// The inputs of a Boolean expression as one operand of a sum, and which input every segment of it belongs to.

/// What the segments of an operand's walk are.
struct SegmentInputs {
  enum class Kind : std::uint8_t {
    ring,        ///< of a ring
    line,        ///< of a polyline, there or back
    from_point,  ///< from a point to some other vertex, so that the point is a node of the graph
    to_point,    ///< the same segment back
  };
  std::vector<std::uint32_t> input;  ///< by segments
  std::vector<Kind> kind;
  bool thin = false;  ///< there are others than rings
  bool is_of_input(std::uint32_t segment) const { return kind[segment] == Kind::ring || kind[segment] == Kind::line; }
};

/// Every ring as a part of its own, every polyline as one, and one of two vertices from every point. Vertices have the
/// indices that planar_boolean.h says; the other end of a point's polyline has one beyond these.
struct JoinedInputs {
  EngineRegion region;
  std::vector<std::uint32_t> input;       ///< of the region's vertices in their order
  std::vector<SegmentInputs::Kind> kind;  ///< of the segments that begin there
};
JoinedInputs joined_inputs(const BooleanTerms& terms);

/// Of the walk edges of the operand made of that region.
SegmentInputs segments_of(const JoinedInputs& joined, const Operand& operand);

}  // namespace dymsum::planar
