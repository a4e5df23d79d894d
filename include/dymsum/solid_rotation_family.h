// All sums R(theta) P (+) Q of solids, of any shape, of an interval of angles about an axis as one object: any of them
// in time proportional to its size, and all exact angles at which it changes.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/solid_family.h"
#include "dymsum/solid_rotation_events.h"

namespace dymsum {

/// The sums R(theta) P (+) Q (or P (+) R(theta) Q) for all theta, or those of an interval. Any number of threads
/// may query one family at the same time.
class SolidRotationFamily {
 public:
  /// Finds all events of all angles, or from `from` counter-clockwise to `to`, both included. Errors: as
  /// SolidRotationEvents::create; out_of_range where `from` and `to` are one; cancelled. Cost: that of
  /// SolidRotationEvents::events without changes (docs/design/solid-families.md).
  static Result<SolidRotationFamily> create(const Mesh& p, const Mesh& q, const TurnAxis& axis,
                                            const SolidFamilyOptions& options = {});
  static Result<SolidRotationFamily> create(const Mesh& p, const Mesh& q, const TurnAxis& axis, const AxisTurn& from,
                                            const AxisTurn& to, const SolidFamilyOptions& options = {});
  SolidRotationFamily(SolidRotationFamily&&) noexcept;
  SolidRotationFamily& operator=(SolidRotationFamily&&) noexcept;
  ~SolidRotationFamily();

  const Mesh& p() const;
  const Mesh& q() const;
  const TurnAxis& axis() const;               ///< primitive
  const SolidFamilyOptions& options() const;  ///< with no progress, which is of the making alone
  /// From which angle to which one; nothing of all, from -pi (excluded) to pi.
  using Ends = std::optional<std::array<AxisTurn, 2>>;
  const Ends& ends() const;
  /// In order: the angles at which something meets on the boundary. Cells lie between them. Which of them are visible
  /// is not known: no sums are compared.
  const std::vector<SolidRotationEvent>& events() const;
  SolidFamilyWork work() const;

  /// The sum at an angle of the interval: the faces, vertices and tight features of posed_sum there. What touches on
  /// them is what touches there at some angle of the cell: where faces of both operands are parallel at all angles, as
  /// those across the axis, a sum from scratch may name another pair of them. The first query in a cell, and any at an
  /// event, is a sum from scratch; further ones take O((m + n + k) log k) for m and n vertices of the operands and k of
  /// the sum. Errors: bad_rotation outside the interval; unsupported_operand where coordinates need more than 8,192
  /// bits; cancelled.
  Result<SpatialSum> at(const AxisTurn& theta, const Progress& progress = {}) const;
  /// The first event after an angle of the interval. Requires one: throws std::invalid_argument for others.
  std::optional<SolidRotationEvent> next(const AxisTurn& theta) const;
  /// Requires an angle of the interval, as next().
  SolidFamilyLocation locate(const AxisTurn& theta) const;

 private:
  class State;
  explicit SolidRotationFamily(std::unique_ptr<const State> state);
  std::unique_ptr<const State> state_;
};

}  // namespace dymsum
