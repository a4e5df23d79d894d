// Sums of solids of any shape in motion: one object holds P (+) Q and follows the poses of both. Setting a pose keeps
// what the move leaves as it is; the result equals a fresh computation there, always.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "dymsum/frames.h"
#include "dymsum/rotation.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

struct MovingSolidOptions {
  Semantics semantics = Semantics::closed;
  bool tight = true;  ///< look for tight features; false lists none
  /// automatic updates after short moves and computes from scratch after long ones, by the angle of the move and what
  /// it moves, not by time; window always updates, rebuild never does. All give the identical sum.
  FrameMode mode = FrameMode::automatic;
  int threads = 1;  ///< 0: as many as there are cores; the result does not depend on it
  Progress progress;
};

/// The work of one frame.
struct SolidFrameWork {
  bool rebuilt = false;               ///< computed from scratch
  std::uint64_t normals_checked = 0;  ///< faces whose certificates had ended, of both operands
  std::uint64_t pairs_checked = 0;    ///< pairs of edges that may have come or gone
  std::uint64_t facets = 0;           ///< of the reduced convolution
  std::uint64_t facets_added = 0, facets_removed = 0;
  std::uint64_t inner_kept = 0;    ///< facets deep inside the open sum as the pair of balls shows that did before
  std::uint64_t inner_tested = 0;  ///< those for which other pairs were tried
  std::uint64_t contacts = 0;      ///< of the other facets
  std::uint64_t exact_signs = 0;
  double ms = 0;
};

/// What happened to the faces from the frame before to this one. A face is what one pair of features makes of the
/// boundary, in as many pieces as may be.
struct SolidFrameChanges {
  std::vector<SolidContact> appeared, disappeared;  ///< pairs of features that make faces now, or did before; sorted
  std::vector<SolidContact> changed;  ///< that did and do, but with other neighbours or other numbers of vertices
  std::int64_t shells = 0, tight_faces = 0, tight_segments = 0, tight_points = 0;  ///< how many more there are
};

/// Vertices are never rounded: every frame is decided by exact signs at its exact pose. What is kept from frame to
/// frame are the facets of the convolution, each normal with a certificate of how far it may turn, and which facets lie
/// deep inside the open sum. Of convex operands all is kept (ConvexSum). Source: Behar 2016, sections 7.2 and 8.2
/// (docs/design/moving-solids.md).
class MovingSolidSum {
 public:
  /// The sum at the identity. Operands as of minkowski_sum; with thin parts every frame is computed from scratch.
  /// Errors: as minkowski_sum; out_of_range for threads below 0.
  static Result<MovingSolidSum> create(const Mesh& p, const Mesh& q, const MovingSolidOptions& options = {});
  MovingSolidSum(MovingSolidSum&&) noexcept;
  MovingSolidSum& operator=(MovingSolidSum&&) noexcept;
  ~MovingSolidSum();

  /// Moves P and Q. A translation moves the sum along and is left to the caller. On an error nothing changes:
  /// cancelled; unsupported_operand for poses at which coordinates need more than 8,192 bits. Cost: the features whose
  /// certificates ended, and the stages of a fresh sum after its convolution for the facets that are not deep inside.
  Result<SolidFrameWork> set(const SolidPose& p, const SolidPose& q = {});

  const SolidPose& p_pose() const;
  const SolidPose& q_pose() const;
  /// The exact sum at the current poses; valid until the next set(). Copies stay valid for ever.
  const SpatialSum& sum() const;
  const SolidFrameWork& work() const;
  /// What changed from the frame before the last set() to the sum now; O(edges log edges). Nothing changed before the
  /// first set().
  SolidFrameChanges changes() const;

 private:
  class State;
  explicit MovingSolidSum(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// P (+) Q at a pair of poses, computed from scratch: what a MovingSolidSum is compared with. Errors: as
/// MovingSolidSum::create and set.
Result<SpatialSum> posed_sum(const Mesh& p, const Mesh& q, const SolidPose& p_pose, const SolidPose& q_pose = {},
                             const MovingSolidOptions& options = {});

/// Takes the sum at pose k of a batch, which lasts for the call.
using PosedSumVisit = std::function<void(std::size_t k, const SpatialSum& sum)>;

/// P (+) Q at many poses that need not be near each other: visit(k, sum) once for each, in any order and from any of
/// `options.threads` threads, one call at a time. `q_poses` are as many as P's, or none for the identity. Poses are
/// taken along a curve through all rotations, in as many parts as there are threads, each with a moving sum of its own:
/// what poses lie near is updated, and the rest made from scratch from operands prepared once (a part). Only the sum
/// that is visited and one a thread are in memory. Returns the work of each pose. Errors: as MovingSolidSum::create and
/// set, the first that a thread meets; out_of_range for another number of Q's poses. What visit throws is thrown on.
Result<std::vector<SolidFrameWork>> posed_sums(const Mesh& p, const Mesh& q, std::span<const SolidPose> p_poses,
                                               std::span<const SolidPose> q_poses, const PosedSumVisit& visit,
                                               const MovingSolidOptions& options = {});

}  // namespace dymsum
