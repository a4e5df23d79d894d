// Minkowski sums of convex solids, kept exact while the operands rotate and scale: DYMSUM, chapter 5 and section 6.4 of
// Behar's thesis, corrected and made exact (docs/design/convex-motion.md). The sums are values of spatial_sum.h.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/result.h"
#include "dymsum/rotation.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

namespace spatial {
struct Polytope;
struct ConvexOperands;
struct ConvexSumInternals;
}  // namespace spatial

enum class ConvexEngine : std::uint8_t {
  walk,   ///< two walks over the Gauss maps (the default)
  brute,  ///< all pairs of features, thesis section 5.2: the reference
};

/// The work of one move.
struct MotionWork {
  std::uint64_t vertex_checks = 0;    ///< faces whose extreme vertex was looked at; the certificates of the others held
  std::uint64_t vertex_errors = 0;    ///< of these, wrong and corrected
  std::uint64_t crossing_checks = 0;  ///< crossings of arcs that were looked at one by one
  std::uint64_t arc_checks = 0;       ///< edges whose arcs were walked again where they may have changed
  std::uint64_t arcs_changed = 0;     ///< of these, changed
  std::uint64_t steps = 0;            ///< from vertex to vertex, in all walks
  std::uint64_t facets_added = 0, facets_removed = 0;  ///< of the generic sum, before coplanar facets merge
  std::uint64_t exact_signs = 0;                       ///< that doubles did not decide
  friend bool operator==(const MotionWork&, const MotionWork&) = default;
};

/// How deep a point lies in a sum.
struct ConvexDepth {
  bool inside = false;     ///< in the interior
  double depth = 0;        ///< distance to the nearest facet's plane, to the nearest double; 0 when not inside
  Rational depth_squared;  ///< exact
  Point3
      direction;  ///< unit outward normal of that facet, with an error below 2^-50: move the point by depth * direction
  /// One pair that touches once the point is moved: that of the facet, as of a face of the sum; of facets equally near
  /// any.
  SolidFeature p, q;
};

struct ConvexSolid;

/// Holds P (+) Q and follows the motion of both. Moving corrects the errors that the motion introduces; the result
/// equals a fresh computation, always. Thread-compatible.
class ConvexSum {
 public:
  /// A vertex of P plus a vertex of Q, by their indices in the meshes. Every vertex of the sum is one such pair only.
  struct Vertex {
    std::uint32_t p = 0, q = 0;
    friend auto operator<=>(const Vertex&, const Vertex&) = default;
  };

  /// The sum at the identity, of solids of any size. Errors: not_convex with the reflex edge, no_area for an empty
  /// operand.
  static Result<ConvexSum> create(const Mesh& p, const Mesh& q);
  /// The sum of a convex sum and one more solid, from the exact positions of the sum: P's vertices and faces are those
  /// of `p` by their indices. Errors also: unsupported_operand for sums that are not SpatialSum::is_convex, and at
  /// poses at which positions are no binary fractions.
  static Result<ConvexSum> create(const SpatialSum& p, const Mesh& q);

  ConvexSum(const ConvexSum&);  ///< an independent copy
  ConvexSum& operator=(const ConvexSum&);
  ConvexSum(ConvexSum&&) noexcept;
  ConvexSum& operator=(ConvexSum&&) noexcept;
  ~ConvexSum();

  /// Moves P and Q. Small motions look at few features: each certificate holds for an angle, and the first small motion
  /// after a large one makes them. Standing still is no work. No memory is allocated once warm, unless the
  /// poses are scaled. Positions are evaluated when they are requested.
  const MotionWork& set(const SolidPose& p, const SolidPose& q = {});
  const MotionWork& set(const Rotation& p) { return set(SolidPose{p, {}}); }
  /// Forgets all certificates and starts from nothing: what moving is compared with.
  const MotionWork& rebuild(ConvexEngine engine = ConvexEngine::walk);
  /// The same at other poses.
  const MotionWork& rebuild(const SolidPose& p, const SolidPose& q, ConvexEngine engine = ConvexEngine::walk);

  const SolidPose& p_pose() const;
  const SolidPose& q_pose() const;
  const MotionWork& work() const;

  /// The number tier of the coordinates: 26 or 61 bits on each operand's own grid, 0 for arbitrary precision.
  int tier_bits() const;
  /// Sizes of the generic sum, before coplanar facets merge: face + vertex of either kind, edge + edge.
  std::size_t face_vertex_count() const;
  std::size_t edge_edge_count() const;
  /// How many faces sum() has, coplanar facets whole, and how many of them the last move brought.
  struct FacetCount {
    std::size_t all = 0, changed = 0;
  };
  /// O(size), without making the sum.
  FacetCount facet_count() const;
  /// What touches at the faces that the last move brought (none before the first one), sorted. O(size).
  std::vector<SolidContact> changed_facets() const;

  /// The sum at the current poses. Its faces name what is extreme in their directions: a face with a vertex or two
  /// edges in general, a face with an edge or another face where directions coincide. O(size log size).
  SpatialSum sum() const;
  /// The exact position of a vertex of P plus one of Q at the current poses. Requires indices of both meshes.
  RationalPoint3 exact(Vertex vertex) const;
  /// The same solid in an order that stays, kept and brought up to date (convex_solid.h): facets that differ from those
  /// of the last call are made again, whatever moves were in between, and the positions of all vertices are computed,
  /// as turning moves all. Valid until the next call or the end of this object; set and rebuild leave it as it is. The
  /// first call makes all of it. O(faces + crossings) comparisons of indices, O(vertices) additions, and the facets
  /// that changed; no memory is allocated once warm, unless the poses are scaled.
  const ConvexSolid& solid();
  /// The exact volume from mixed volumes, O(faces): independent of the facets.
  Rational volume_exact() const;
  /// The volume with a relative error of at most 1e-12, wherever and of whatever shape the operands are; beyond the
  /// range of doubles infinite, below that of ordinary ones to the nearest. O(faces); in exact arithmetic for solids
  /// much thinner than long.
  double volume() const;
  /// Memory held, operands included (without what lies behind arbitrary precision).
  std::size_t bytes() const;
  /// Whether the combinatorics are those of another sum of the same operands.
  bool same_combinatorics(const ConvexSum& other) const;

  /// The vertex of the sum that is extreme in a direction, and its rounded position. Of several the one with the
  /// largest x, of these with the largest y, then z; so also of all vertices, where the direction is 0.
  struct Support {
    Vertex vertex;
    Point3 at;
  };
  /// Requires a finite direction (else std::invalid_argument).
  Support support(Point3 direction) const;
  /// How deep a point lies, with the facet that is nearest: a global minimum, exact, of solids of any size. O(facets).
  /// Requires a finite point (else std::invalid_argument).
  ConvexDepth depth(Point3 point = {}) const;

 private:
  friend struct spatial::ConvexSumInternals;
  class State;
  explicit ConvexSum(std::unique_ptr<State> state);
  static ConvexSum of(std::shared_ptr<const spatial::Polytope> p, std::shared_ptr<const spatial::Polytope> q,
                      std::shared_ptr<const spatial::ConvexOperands> operands);
  std::unique_ptr<State> state_;
};

/// The penetration depth of two convex solids: the shortest translation of Q that separates them, by P (+) -Q. `inside`
/// is whether their interiors meet. Errors: as ConvexSum::create; not_finite for a translation that is not finite.
Result<ConvexDepth> penetration_depth(const Mesh& p, const Mesh& q, const SolidPose& p_pose = {},
                                      const SolidPose& q_pose = {}, Point3 q_moved_by = {});

/// What a batch reports for one pose of P.
struct PoseReport {
  std::size_t facets = 0;  ///< of the sum, coplanar ones whole
  double volume = 0;
  Point3 support;
  ConvexDepth depth;
};
struct BatchOptions {
  Point3 support_direction{0, 0, 1};
  Point3 depth_point;
  Progress progress;
  int threads = 0;  ///< 0: as many as there are cores; at least 0
};
/// P (+) Q at many rotations of P. They are taken in an order that makes steps short (along a curve through all
/// rotations), in as many parts as there are threads; the reports come in the order given. Errors: as create;
/// not_finite for a direction or point that is not finite; out_of_range for threads; cancelled.
Result<std::vector<PoseReport>> pose_batch(const Mesh& p, const Mesh& q, std::span<const Rotation> poses,
                                           const BatchOptions& options = {});

}  // namespace dymsum
