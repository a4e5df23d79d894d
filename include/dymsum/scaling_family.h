// All sums s P (+) Q of an interval of scales as one object: any of them in time proportional to its size, all exact
// scales at which it changes, what lives how long, and what holds for all scales and for some.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "dymsum/event.h"
#include "dymsum/family.h"
#include "dymsum/planar_sum.h"
#include "dymsum/scale.h"

namespace dymsum {

namespace planar {
struct FamilyInternals;
}

/// The sums s P (+) Q (or P (+) s Q) for all s of an interval. Two threads may query one family at the same time.
class ScalingFamily {
 public:
  /// Finds all events in [low, high] and the structure between each two. General regions. Errors: bad_scale where
  /// low > high; as ScalingSum::create; cancelled; out_of_memory. Cost: that of ScalingSum::events, some hundred sums
  /// of dozens of events each (docs/design/families.md), more with polylines and points, of which two sums an event are
  /// computed from scratch.
  static Result<ScalingFamily> create(const Region& p, const Region& q, const Scale& low, const Scale& high,
                                      const FamilyOptions& options = {});
  /// The sums diag(s, r s) P (+) Q for all s of an interval; r from 2^-32 to 2^32. Errors: also bad_scale for other
  /// ratios, and where r s is no Scale.
  static Result<ScalingFamily> create(const Region& p, const Region& q, const Scale& low, const Scale& high,
                                      const Scale& ratio, const FamilyOptions& options = {});

  ScalingFamily(ScalingFamily&&) noexcept;
  ScalingFamily& operator=(ScalingFamily&&) noexcept;
  ~ScalingFamily();

  const Region& p() const;
  const Region& q() const;
  const FamilyOptions& options() const;  ///< with no progress, which is of the making alone
  const Scale& low() const;
  const Scale& high() const;
  const Scale& ratio() const;
  /// In order, each scale once; every visible one is among them. Cells lie between them.
  const std::vector<ScaleEvent>& events() const;
  const FamilyWork& work() const;

  /// The sum at a scale of the interval: equal to minkowski_sum there, with its tight features at events. Between
  /// events in O(n) for n vertices; at an event from scratch. Stats hold the tier alone, where no sum is computed from
  /// scratch. Errors: bad_scale outside the interval.
  Result<PlanarSum> at(const Scale& s) const;
  /// The events in [a, b] that are visible, or change the topology.
  std::vector<ScaleEvent> changes(const Scale& a, const Scale& b, EventChange change = EventChange::visible) const;
  /// The first such event after s.
  std::optional<ScaleEvent> next(const Scale& s, EventChange change = EventChange::visible) const;

  /// The cell that a scale lies in, or the event that it is.
  struct Location {
    std::uint32_t index = 0;
    bool event = false;
    friend bool operator==(const Location&, const Location&) = default;
  };
  Location locate(const Scale& s) const;
  /// Of all vertices, edges and holes of parts, by feature, then as they first come. Errors: out_of_memory where
  /// structures are not all kept.
  Result<std::vector<Lifetime>> lifetimes() const;
  /// Identities of the rings of at(s), part by part, the outer ring of each first, by which lifetimes name holes. At an
  /// event a ring has that of a ring of the cell before with which it has a vertex in common, else of the cell after,
  /// else 0; so it is where a structure is not kept. Cost: that of at(s). Errors: bad_scale outside the interval.
  Result<std::vector<std::uint64_t>> ring_ids(const Scale& s) const;

  /// What lies in the sum at some scale of [a, b]: exact, closed. A union: (the union of s P over [a, b]) (+) Q.
  Result<PlanarSum> outer(const Scale& a, const Scale& b) const;
  /// What lies in the sum at every scale of [a, b]: the closure of the interior of the intersection, exact. Cost: that
  /// of a difference with one quadrangle for each lifetime of an edge there. Errors: bad_scale outside the interval.
  Result<PlanarSum> inner(const Scale& a, const Scale& b) const;

 private:
  friend struct planar::FamilyInternals;
  class State;
  explicit ScalingFamily(std::unique_ptr<const State> state);
  std::unique_ptr<const State> state_;
};

}  // namespace dymsum
