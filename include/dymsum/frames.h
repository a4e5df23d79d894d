// Planar sums in motion: which operand moves, how frames are made, the work they took and what changed. Shared by
// ScalingSum and RotatingSum.
#pragma once

#include <cstdint>
#include <vector>

#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"

namespace dymsum {

/// The operand that moves: is scaled or turned, about the origin of its coordinates.
enum class MovingOperand : std::uint8_t { p, q };

/// How frames are made. automatic: the controller chooses between the two by what they have cost, with hysteresis.
/// Costs are counted work, not time: every run makes the same choices, unless windows are made ahead (`threads`). All
/// give the identical sum.
enum class FrameMode : std::uint8_t {
  automatic,
  window,   ///< always update inside windows, however short they live
  rebuild,  ///< always compute from scratch
};

struct MovingOptions {
  MovingOperand moving = MovingOperand::p;
  bool reflect_q = false;  ///< P (+) -Q: Q is a robot and P an obstacle. Provenance indices refer to Q
  Semantics semantics = Semantics::closed;
  FrameMode mode = FrameMode::automatic;
  /// How far windows reach ahead: relative to the scale (0.05: from s to 1.05 s), or in radians; 0: chosen by the
  /// controller. Finite, at least 0. Windows of angles reach at most 1.5 radians ahead, however far they are asked to.
  double window = 0;
  /// Windows that the sum has left are kept in at most so many bytes, the least recently used ones going first: coming
  /// back, or round by a whole turn, costs frames, no windows. 0: none is kept.
  std::uint64_t kept_window_bytes = std::uint64_t{64} << 20;
  /// With two or more, a sum whose frames are made automatically makes its windows ahead on a thread of its own, and no
  /// frame waits for one: until it is ready frames are computed from scratch. The sums are the same; which
  /// frames were rebuilt, and the rest of FrameWork, then depend on time. Other modes make no windows ahead. At least
  /// 0.
  int threads = 1;
  /// Bytes that may be held at a time by arrays which grow faster than the operands, each of which counts before it is
  /// made: those of windows, also of kept ones, and of frames from scratch, except the sum of the last frame. A window
  /// that does not fit is not made: its frames are computed from scratch. Where these do not fit, and in lists of
  /// events: Error out_of_memory. 0: no limit.
  std::uint64_t memory = 0;
  ForcedTier forced_tier;
  Progress progress;  ///< asked before a window is built and between stages of a rebuild, see progress.h
};

/// The work of one frame.
struct FrameWork {
  bool rebuilt = false;                 ///< computed from scratch, without a window
  bool new_window = false;              ///< a window was built for it, by the thread that asked
  bool degenerate = false;              ///< something touches at this very scale or angle: no update could serve
  std::uint64_t pieces = 0;             ///< pieces of segments that are live in the window
  std::uint64_t candidates = 0;         ///< pairs of pieces that may meet in the window where it is not proved covered
  std::uint64_t pieces_repaired = 0;    ///< whose list of crossings was looked at
  std::uint64_t lists_changed = 0;      ///< whose list of crossings changed
  std::uint64_t crossings_changed = 0;  ///< crossings that came or went in those lists, each counted at both segments
  std::uint64_t loops_traced = 0;       ///< cycles walked
  std::uint64_t loops_kept = 0;         ///< cycles carried over without a look
  std::uint64_t witnessed =
      0;  ///< loops and touches proved covered by edges that cross, remembered or found in doubles
  std::uint64_t witnesses_lost = 0;  ///< remembered collisions that no longer hold; the loop or touch is tested anew
  std::uint64_t collision_tests = 0;
  std::uint64_t exact_signs = 0;           ///< signs of this frame that doubles did not decide
  double window_low = 0, window_high = 0;  ///< scales or angles the window covers; 0, 0 without one
  double ms = 0;                           ///< wall time of the frame
  std::uint64_t peak_bytes = 0;            ///< of the window's arrays
};

/// What happened to a ring from one frame to the next. Identities last as long as a ring shares a vertex (by its
/// contacts) with a ring of the frame before; they are never used again.
struct RingChange {
  enum class Kind : std::uint8_t {
    appeared,
    disappeared,
    reshaped,  ///< still there, with other vertices
    moved,     ///< the same vertices at other positions
  };
  Kind kind = Kind::moved;
  std::uint64_t ring = 0;                                         ///< identity
  std::uint32_t vertices_appeared = 0, vertices_disappeared = 0;  ///< by contacts
  friend bool operator==(const RingChange&, const RingChange&) = default;
};

struct FrameChanges {
  std::vector<RingChange> rings;  ///< sorted by identity; rings that did not even move are not listed
  std::int64_t tight_points = 0, tight_segments = 0;  ///< how many more (or fewer) there are now
  bool topology = false;  ///< the number of parts, of holes, of tight features or lower-dimensional pieces changed
};

}  // namespace dymsum
