// Planar sums that stay exact while an operand rotates: one object holds R(theta) P (+) Q and follows the orientation.
// Setting one updates what the change touches; the result equals a fresh computation there, always.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "dymsum/frames.h"
#include "dymsum/orientation.h"
#include "dymsum/planar_sum.h"

namespace dymsum {

namespace planar {
struct RotatingInternals;
}

/// Vertices are never rounded: between two frames everything is decided by signs of trigonometric polynomials, in
/// doubles with proved bounds; a frame that they do not decide, one at which something touches among them, is computed
/// from scratch on integers. Source: Behar 2016, 6.1 carried over to rotations (docs/design/rotating-sum.md).
class RotatingSum {
 public:
  /// R(theta) P (+) Q at theta = 0. General regions; polylines and points make every frame a rebuild. Errors:
  /// unsupported_operand for coordinates beyond 2^1000, operands wider than 2^920 of their finest steps;
  /// out_of_range for the options; cancelled.
  static Result<RotatingSum> create(const Region& p, const Region& q, const MovingOptions& options = {});
  RotatingSum(RotatingSum&&) noexcept;
  RotatingSum& operator=(RotatingSum&&) noexcept;
  ~RotatingSum();

  /// Turns to an orientation. On an error (cancelled) nothing changes. Cost of a frame inside a window: O(pieces and
  /// pairs of the window + boundary).
  Result<FrameChanges> set(const Orientation& theta);

  const Orientation& orientation() const;
  /// The exact sum at the current orientation; valid until the next set(). Copies stay valid for ever.
  const PlanarSum& sum() const;
  /// Identities of the rings of sum(), part by part, outer ring first.
  std::vector<std::uint64_t> ring_ids() const;
  const FrameWork& work() const;

 private:
  friend struct planar::RotatingInternals;
  class State;
  explicit RotatingSum(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace dymsum
