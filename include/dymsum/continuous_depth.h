// How deep two solids lie in each other, as a number, a direction and contact points that follow a motion without jumps
// where that is possible, and tell where it is not (docs/design/continuous-depth.md).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "dymsum/local_sum.h"
#include "dymsum/penetration_depth.h"

namespace dymsum {

namespace depth {
class ContinuousTracker;
}

struct ContinuousDepthOptions {
  /// Normals are averaged over the boundary of the sum within this distance. 0: not at all, which gives the exact
  /// depth and its jumps. Default: a quarter of the smaller solid's diagonal; beside parts without volume of the
  /// solid's.
  std::optional<double> smoothing_length;
  /// A branch is left where its depth is more than this times the shortest way out; at least 1.
  double inflation = 2;
  /// How far Q may move before another local sum is made: the smoothing length, if 0.
  double margin = 0;
  int halvings = 5;   ///< a step that does not provably stay on its branch is cut into at most 2^halvings parts
  bool tight = true;  ///< passages without clearance count as ways out in `euclidean_depth`
  int threads = 1;    ///< 0: as many as there are cores; the result does not depend on it
  Progress progress;
};

/// Why an answer does not follow from the last one continuously. Believed to follow is a step, or a part of a halved
/// one, in which the way's end goes no further than twice what the derivatives at both ends say, and the direction
/// turns by less than 1/32 radian, or by less than a quarter and 1.25 times the mean of the turn rates at both ends
/// (where Q turns, and without smoothing: by less than a quarter). A jump that looks like that is not told; shorter
/// steps tell more of them.
enum class Discontinuity : std::uint8_t {
  none,       ///< it does
  entered,    ///< there is no last one: the first question, or the first one inside
  fold,       ///< the branch ends here, or turns back
  inflation,  ///< the branch goes on, but is too long a way out
  lost,       ///< the sum's boundary changed too much
};

/// Depth at one pose. Lengths are in units of the input. Rounded: see `error`.
struct ContinuousContact {
  Meeting meeting = Meeting::apart;  ///< touching: within `error`
  double depth = 0;                  ///< Q moved by this along `normal` does not overlap P; 0 where they do not overlap
  double euclidean_depth = 0;        ///< the length of the shortest such move, a global minimum; at most `depth`
  Point3 normal, euclidean_normal;   ///< of length 1; zero where they do not overlap
  /// What touches after the move: on P, and on Q where it is now; witness_p - witness_q = depth * normal.
  Point3 witness_p, witness_q;
  /// One pair of features that hold them: those of the sum's face, if these touch there. Where more touch, as of flush
  /// faces, euclidean_ways() names all of the shortest way.
  SolidContact contact;
  std::uint64_t branch = 0;  ///< the same from answer to answer as long as nothing jumps; from 1
  Discontinuity discontinuity = Discontinuity::none;
  bool smoothed = false;  ///< false: there is no smoothed way out within `inflation`, and the shortest one is given
  /// Derivatives of `depth` by the translation of Q, and by a turn of Q about its origin if the boundary's normals did
  /// not turn with it (exact for smoothing length 0).
  Point3 gradient, torque;
  /// The most radians that `normal` rotates for a unit of translation of Q, to first order.
  double turn_rate = 0;
  double error = 0;  ///< of euclidean_depth, and of the equation that `depth` and `normal` solve

  struct Work {
    std::uint64_t local_sums = 0, steps = 0, normals = 0;
    double projection_us = 0;  ///< without local sums
  };
  Work work;
};

/// A piece of the sum's boundary at one orientation, as ContinuousDepth::patch gives it: answers near its position
/// without another local sum. A value; one thread at a time, copies on any. Cost: O(n) for n edges of the piece, a few
/// times: 10 us for hundreds, 50 to 300 us for two tori of 1,024 triangles.
class DepthPatch {
 public:
  DepthPatch(const DepthPatch& other);
  DepthPatch& operator=(const DepthPatch& other);
  DepthPatch(DepthPatch&&) noexcept;
  DepthPatch& operator=(DepthPatch&&) noexcept;
  ~DepthPatch();

  /// True where `at` knows enough of the boundary.
  bool covers(Point3 q_moved_by) const;
  /// The answer of ContinuousDepth::query at the patch's orientation, following this patch's last answer. Requires a
  /// finite translation (else std::invalid_argument). Where the patch does not cover it, all is about what the patch
  /// knows.
  ContinuousContact at(Point3 q_moved_by);

 private:
  friend class ContinuousDepth;
  explicit DepthPatch(const depth::ContinuousTracker& tracker);
  std::unique_ptr<depth::ContinuousTracker> tracker_;
};

/// Two solids, of which Q moves and turns; one of them may have, or be, points, segments and open surfaces. The
/// boundary of P (+) -Q near the position is exact (LocalSum; with parts without volume all of it, at every new
/// orientation). A point x of it with h >= 0 and x - h n(x) = t, t being the translation, is a way out: n(x) is the
/// direction of the integral of the boundary's normals within the smoothing length, weighted by (1 - r^2 / l^2)^2. It
/// is found in doubles, and followed from one answer to the next. One thread at a time. Source: Lee, Behar, Lien, Kim
/// 2016 and Behar 2016, section 7.3, with other normals (docs/design/continuous-depth.md).
class ContinuousDepth {
 public:
  /// Errors: no_area for an empty operand; unsupported_operand where both have parts without volume; not_finite and
  /// out_of_range for options; cancelled.
  static Result<ContinuousDepth> create(const Mesh& p, const Mesh& q, const ContinuousDepthOptions& options = {});

  ContinuousDepth(ContinuousDepth&&) noexcept;
  ContinuousDepth& operator=(ContinuousDepth&&) noexcept;
  ~ContinuousDepth();

  /// Q turned about its origin, then moved. Errors: not_finite; those of LocalSum::in; cancelled. After an error the
  /// next answer is a first one. Cost: none but the projection while Q moves by less than the margin; else a local sum
  /// or a few.
  Result<ContinuousContact> query(Point3 q_moved_by, const Rotation& q_turned = {});
  /// The square of the shortest way out at the last pose, exactly; 0 where they do not overlap, which an exact
  /// collision test decides, also where `meeting` is within its error. Requires a query without error before (else
  /// std::logic_error). Cost: the first one at an orientation prepares the solids, O(n log n).
  Rational euclidean_squared() const;
  /// All shortest moves of Q at the last pose, exactly, each with all pairs of features that touch once it is made, as
  /// SolidDepth tells them; none where they do not overlap. Requires and costs as above, and the pairs' simplices.
  std::vector<SolidWay> euclidean_ways() const;
  /// What is known of the boundary at the last pose, and where its answer was. Requires as above.
  DepthPatch patch() const;
  /// Forgets the last answer: the next one is a first one.
  void forget();

  double smoothing_length() const;

 private:
  class State;
  explicit ContinuousDepth(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace dymsum
