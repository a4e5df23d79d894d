// Planar sums that stay exact while an operand scales: one object holds P (+) Q and follows the scale. Setting a scale
// updates what the change touches; the result equals a fresh computation at that scale, always.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "dymsum/event.h"
#include "dymsum/frames.h"
#include "dymsum/planar_sum.h"
#include "dymsum/scale.h"

namespace dymsum {

namespace planar {
struct ScalingInternals;
}

class ScalingSum {
 public:
  /// P (+) Q with one operand to be scaled, at s = 1. General regions; polylines and points make every frame a rebuild.
  /// Errors: unsupported_operand for coordinates beyond 2^1000 and operands wider than 2^920 of their steps;
  /// out_of_range for the options; cancelled.
  static Result<ScalingSum> create(const Region& p, const Region& q, const MovingOptions& options = {});

  ScalingSum(ScalingSum&&) noexcept;
  ScalingSum& operator=(ScalingSum&&) noexcept;
  ~ScalingSum();

  /// Moves to a scale. On an error (bad_scale, not_finite, cancelled) nothing changes. Cost of a frame inside a window:
  /// O(pieces checked + work reported + boundary).
  Result<FrameChanges> set(double s);
  Result<FrameChanges> set(const Scale& s);
  /// diag(sx, sy) times the scaled operand. While sy / sx stays what it is, from 2^-32 to 2^32, these are updates as
  /// those of a uniform scale; a frame of another ratio is rebuilt unless a window of it is kept. FrameWork tells of
  /// windows by the larger scale.
  Result<FrameChanges> set(const Scale& sx, const Scale& sy);

  const Scale& scale() const;
  /// The exact sum at the current scale; valid until the next set(). Copies stay valid for ever. Of frames inside a
  /// window stats hold the sizes and the tier only (that of the unscaled operands where no sign needed integers); the
  /// rest is in work().
  const PlanarSum& sum() const;
  /// Identities of the rings of sum(), part by part, outer ring first.
  std::vector<std::uint64_t> ring_ids() const;
  const FrameWork& work() const;
  /// A hash of the sum's combinatorics: rings and tight features by the contacts of their vertices, no positions.
  /// Constant between consecutive visible events.
  std::uint64_t combinatorial_hash() const;

  /// The events in [a, b], exact scales at which segments of the convolution begin or cease to meet, in order; a value
  /// with events of both kinds is listed once, as vertex_on_segment. Every visible event is among them; those that lie
  /// in the open sum are not. Costs one exact frame per value. Does not move the sum. Errors: bad_scale when a > b;
  /// cancelled.
  Result<std::vector<ScaleEvent>> events(const Scale& a, const Scale& b, const Progress& progress = {}) const;
  /// The first event of the kind requested after s and at most `limit`, if there is one.
  Result<std::optional<ScaleEvent>> next_event(const Scale& s, const Scale& limit,
                                               EventChange change = EventChange::visible,
                                               const Progress& progress = {}) const;

 private:
  friend struct planar::ScalingInternals;
  class State;
  explicit ScalingSum(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// One copy of a master shape: scaled about its origin, then moved.
struct ScaledCopy {
  Scale scale;
  Point at;
};
/// The obstacles s_i P + z_i of an environment summed with Q: for each copy the sum s_i P (+) Q (not moved by z_i), in
/// the order given, from one sum that takes the scales in order; copies of equal scale share one frame. With
/// FrameMode::automatic windows are planned from the scales: where six or more lie within 13 %, the rest is computed
/// from scratch. Figure 6.11 of the thesis.
struct CopySum {
  PlanarSum sum;
  Point at;        ///< add it to every position
  FrameWork work;  ///< nothing for a copy whose scale another one before it has
};
Result<std::vector<CopySum>> scaled_copies(const Region& master, const Region& q, const std::vector<ScaledCopy>& copies,
                                           const MovingOptions& options = {});

}  // namespace dymsum
