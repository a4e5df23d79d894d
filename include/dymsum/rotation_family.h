// All sums R(theta) P (+) Q of a whole rotation as one object: any of them in time proportional to its size, all exact
// angles at which it changes, and what holds for all angles of an interval and for some.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "dymsum/cspace_obstacle.h"
#include "dymsum/family.h"
#include "dymsum/orientation.h"
#include "dymsum/planar_sum.h"

namespace dymsum {

/// The sums R(theta) P (+) Q (or P (+) R(theta) Q) for all theta, as the slices of a configuration-space obstacle. Two
/// threads may query one family at the same time.
class RotationFamily {
 public:
  /// The moving operand rotates about the origin of its coordinates. Errors: as CspaceObstacle::create;
  /// unsupported_operand for polylines and points; cancelled; out_of_memory. Cost: that of the obstacle.
  static Result<RotationFamily> create(const Region& p, const Region& q, const FamilyOptions& options = {});
  /// The moving operand rotates about another point. Errors: also unsupported_operand where a vertex less that point,
  /// or a vertex of the other operand and that point, is no double.
  static Result<RotationFamily> create(const Region& p, const Region& q, Point centre,
                                       const FamilyOptions& options = {});

  RotationFamily(RotationFamily&&) noexcept;
  RotationFamily& operator=(RotationFamily&&) noexcept;
  ~RotationFamily();

  /// The operands, less the centre, and the options, without a progress.
  const Region& p() const;
  const Region& q() const;
  const FamilyOptions& options() const;
  /// The exact angles at which the sum changes, by increasing theta in (-pi, pi]. Cell k lies between angles k and
  /// k + 1, the last one passes pi; without angles there is one cell.
  const std::vector<EventAngle>& angles() const;
  const FamilyWork& work() const;

  /// The sum at an orientation: equal to rotated_sum there, with its tight features at the angles of changes. Between
  /// them in O(n) for n vertices; at one of them, and for operands whose rings touch, from scratch. Stats hold nothing
  /// where no sum is computed from scratch.
  Result<PlanarSum> at(const Orientation& theta) const;
  /// The cell of an orientation; nothing at the angle of a change.
  std::optional<std::uint32_t> cell_of(const Orientation& theta) const;
  /// The first angle of a change after theta, round the circle.
  std::optional<EventAngle> next(const Orientation& theta) const;
  /// The edges of the boundary, by their contacts. Where last_cell < first_cell they pass pi. No other features.
  std::vector<Lifetime> lifetimes() const;

  /// A set that holds the sums at all angles from a counter-clockwise to b, and lies within `tolerance` of their union:
  /// the sums of so many orientations, grown by how far a point of the rotating operand is away from the next one.
  /// Errors: out_of_range for a tolerance that is not positive, or takes more than 4096 orientations; and as sums.
  Result<PlanarSum> outer(const Orientation& a, const Orientation& b, double tolerance) const;
  /// A set that lies in the sums at all these angles: of so many orientations, the sums of the rotating operand shrunk
  /// by at most `tolerance`. What is thinner than that is lost. Errors: as outer.
  Result<PlanarSum> inner(const Orientation& a, const Orientation& b, double tolerance) const;

 private:
  class State;
  explicit RotationFamily(std::unique_ptr<const State> state);
  std::unique_ptr<const State> state_;
};

/// RotationFamily::outer and inner without a family, for a few intervals: no obstacle is computed.
Result<PlanarSum> outer_rotated_sum(const Region& p, const Region& q, const Orientation& a, const Orientation& b,
                                    double tolerance, const FamilyOptions& options = {});
Result<PlanarSum> inner_rotated_sum(const Region& p, const Region& q, const Orientation& a, const Orientation& b,
                                    double tolerance, const FamilyOptions& options = {});

}  // namespace dymsum
