// Whether points lie in a planar sum, for many points: the sum is computed and prepared once, then each point is found
// in it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"

namespace dymsum {

/// The set of a sum, prepared for questions about points: closed, its parts, segments and points; regular, its parts;
/// open, the interior of its parts without tight features. Requires that the sum was made with the same semantics.
/// Independent of the sum once made; a value whose copies share what was prepared; thread-safe.
/// Exact: doubles decide where a proved error bound lets them, exact positions elsewhere.
/// Cost: O(n log^2 n) and O(n log n) memory for n vertices, O(log^2 n) a point; to that come the tight features, or the
/// segments and points of a closed sum, in whose boxes the point lies.
class SumLocator {
 public:
  explicit SumLocator(const PlanarSum& sum, Semantics semantics = Semantics::closed);

  /// True when z lies in the set. Nothing that is not finite does.
  bool contains(Point z) const;
  bool contains_rational(const RationalPoint& z) const;
  /// contains for many points, in their order (1: inside), on so many threads (0: all cores); progress is called on
  /// this one. Errors: cancelled.
  Result<std::vector<std::uint8_t>> contains_each(std::span<const Point> points, int threads = 0,
                                                  const Progress& progress = {}) const;
  Result<std::vector<std::uint8_t>> contains_each(std::span<const RationalPoint> points, int threads = 0,
                                                  const Progress& progress = {}) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

/// contains(p, q, z, semantics) for many points, in their order (1: inside). Few points are answered one by one; where
/// that is expected to take longer than computing the sum does, they are found in it by a SumLocator. Both ways are
/// exact. Threads: 0 is all cores; progress is called on this one. Errors: cancelled; unsupported_operand for
/// coordinates beyond 2^1000.
Result<std::vector<std::uint8_t>> contains_each(const Region& p, const Region& q, std::span<const Point> points,
                                                Semantics semantics = Semantics::closed, int threads = 0,
                                                const Progress& progress = {});
/// The same for points that may be any fractions; where doubles do not hold them all, the sum is computed.
Result<std::vector<std::uint8_t>> contains_each(const Region& p, const Region& q, std::span<const RationalPoint> points,
                                                Semantics semantics = Semantics::closed, int threads = 0,
                                                const Progress& progress = {});

}  // namespace dymsum
