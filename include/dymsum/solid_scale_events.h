// What happens to the sum of two solids of any shape while one of them scales: the exact scales at which P + s Q is
// another polyhedron than beside them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "dymsum/event.h"
#include "dymsum/frames.h"
#include "dymsum/scale.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

struct SolidScaleOptions {
  MovingOperand moving = MovingOperand::q;  ///< which operand scales, about the origin of its coordinates
  Semantics semantics = Semantics::closed;
  bool tight = true;  ///< look for tight features; without them they make no events
  int threads = 1;    ///< 0: as many as there are cores; the result does not depend on it
};

/// How an answer was found.
struct SolidEventWork {
  std::uint64_t candidates = 0;  ///< tuples of corners, edges and facets that might meet
  std::uint64_t exact = 0;       ///< of these, points that exact numbers had to tell
  std::uint64_t points = 0;      ///< that are, and are not provably in the open sum
  std::uint64_t values = 0;      ///< different scales of these
  std::uint64_t sums = 0;        ///< sums computed to compare them, where the facets at the points do not decide
};

/// P + s Q, or s P + Q, for exact s > 0. The reduced convolution is the same at every scale, so that it is made once,
/// and its planes and corners move linearly: all events are rational. Immutable; queries may run at the same time.
/// Source: Behar 2016, section 6.3, where four facets in a point are missing (docs/design/scaling-solids.md).
class SolidScaleEvents {
 public:
  /// Errors: unsupported_operand for thin parts, and for more than 8,192 bits; out_of_range for threads below
  /// 0.
  static Result<SolidScaleEvents> create(const Mesh& p, const Mesh& q, const SolidScaleOptions& options = {});
  SolidScaleEvents(SolidScaleEvents&&) noexcept;
  SolidScaleEvents& operator=(SolidScaleEvents&&) noexcept;
  ~SolidScaleEvents();

  std::size_t facet_count() const;  ///< of the reduced convolution

  /// The exact sum at a scale, that of an event included: minkowski_sum of the scaled operands. Errors:
  /// unsupported_operand where coordinates need more than 8,192 bits; cancelled. Cost: the stages of a sum after its
  /// convolution.
  Result<SpatialSum> at(const Scale& s, const Progress& progress = {}) const;

  /// All events in [a, b] in order, each visible: scales at which the sum's structure differs before, at or after, that
  /// is faces by their planes as the scale moves them, how these meet in edges and vertices, shells, tight features.
  /// Exact. Errors: bad_scale when a > b; cancelled; unsupported_operand as at(), where
  /// sums have to be compared. Cost: pairs and triples of facets that come near each other in windows of scales, an
  /// exact point for each of their meetings outside of what is provably covered; three sums for every scale at which
  /// facets meet in more than the general way, or in one that may change the topology.
  Result<std::vector<ScaleEvent>> events(const Scale& a, const Scale& b, const Progress& progress = {},
                                         SolidEventWork* work = nullptr) const;
  /// The first event after s and at most `limit`, if there is one.
  Result<std::optional<ScaleEvent>> next_event(const Scale& s, const Scale& limit,
                                               EventChange change = EventChange::visible,
                                               const Progress& progress = {}) const;
  /// The first one that changes shells, genus or the counts of tight features.
  Result<std::optional<ScaleEvent>> next_topology_change(const Scale& s, const Scale& limit,
                                                         const Progress& progress = {}) const {
    return next_event(s, limit, EventChange::topology, progress);
  }
  /// A hash of the sum's combinatorics at a scale, no positions: constant between consecutive events. Errors as at().
  Result<std::uint64_t> combinatorial_hash(const Scale& s, const Progress& progress = {}) const;

 private:
  class State;
  explicit SolidScaleEvents(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace dymsum
