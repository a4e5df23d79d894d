// All sums s P (+) Q of solids, of any shape, of an interval of scales as one object: any of them in time proportional
// to its size, all exact scales at which it changes, what lives how long, and the volume as polynomials.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "dymsum/event.h"
#include "dymsum/mesh.h"
#include "dymsum/scale.h"
#include "dymsum/solid_family.h"

namespace dymsum {

/// The sums s P (+) Q (or P (+) s Q) for all s of an interval. Any number of threads may query one family at the same
/// time.
class SolidScalingFamily {
 public:
  /// Finds all events in [low, high]. Solids without thin parts. Errors: bad_scale where low > high; as
  /// SolidScaleEvents::create and events; cancelled. Cost: that of SolidScaleEvents::events
  /// (docs/design/solid-families.md).
  static Result<SolidScalingFamily> create(const Mesh& p, const Mesh& q, const Scale& low, const Scale& high,
                                           const SolidFamilyOptions& options = {});
  SolidScalingFamily(SolidScalingFamily&&) noexcept;
  SolidScalingFamily& operator=(SolidScalingFamily&&) noexcept;
  ~SolidScalingFamily();

  const Mesh& p() const;
  const Mesh& q() const;
  const SolidFamilyOptions& options() const;  ///< with no progress, which is of the making alone
  const Scale& low() const;
  const Scale& high() const;
  /// In order, each scale once; every visible one is among them. At others what touches on a face may change. Cells lie
  /// between them. Of convex operands there are none.
  const std::vector<ScaleEvent>& events() const;
  SolidFamilyWork work() const;

  /// The sum at a scale of the interval: the faces, vertices and tight features of minkowski_sum there, and what
  /// touches. The first query in a cell, and any at an event, is a sum from scratch; further ones take O((m + n + k)
  /// log k) for m and n vertices of the operands and k of the sum. Stats of these hold bits and numbers of facets
  /// alone. Errors: bad_scale outside the interval; unsupported_operand where coordinates need more than 8,192 bits;
  /// cancelled.
  Result<SpatialSum> at(const Scale& s, const Progress& progress = {}) const;
  /// The events in [a, b] that are visible, or change the topology.
  std::vector<ScaleEvent> changes(const Scale& a, const Scale& b, EventChange change = EventChange::visible) const;
  /// The first such event after s.
  std::optional<ScaleEvent> next(const Scale& s, EventChange change = EventChange::visible) const;
  SolidFamilyLocation locate(const Scale& s) const;

  /// c with the volume c[0] + c[1] s + c[2] s^2 + c[3] s^3, exactly, at every scale of the cell that s lies in; at an
  /// event, of the cell before it. Errors: as at(). Cost: four times SpatialSum::volume_exact.
  Result<std::array<Rational, 4>> volume_polynomial(const Scale& s, const Progress& progress = {}) const;
  /// Of all faces and shells, by feature, then as they first come. Errors: as at(). Cost: a sum from scratch for every
  /// cell whose structure is not kept.
  Result<std::vector<SolidLifetime>> lifetimes(const Progress& progress = {}) const;

 private:
  class State;
  explicit SolidScalingFamily(std::unique_ptr<const State> state);
  std::unique_ptr<const State> state_;
};

}  // namespace dymsum
