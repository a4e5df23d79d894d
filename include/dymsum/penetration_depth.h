// How deep two solids of any shape, or two planar regions, lie in each other: the shortest translation that separates
// them, exactly and as a global minimum; and how far apart they are (docs/design/penetration-depth.md). Convex solids
// that turn and scale have ConvexSum::depth.
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/result.h"
#include "dymsum/spatial_operand.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

namespace depth {
struct DepthOperands;
class DepthProbe;
class TouchingPairs;
}  // namespace depth

/// How two sets lie: their interiors meet; they touch and no more; they have no point in common.
enum class Meeting : std::uint8_t { overlapping, touching, apart };

/// A feature of P and one of Q that touch: a vertex, an edge without its ends, a face without its edges, which have
/// positions in common. Every position that touches belongs to one pair alone.
struct SolidTouch {
  SolidFeature p, q;  ///< by the meshes' indices; of a face its own one, also where others lie in its plane
  int dimension = 0;  ///< of what they have in common: a point (0), a segment (1), a part of a plane (2)
  RationalPoint3 at;  ///< one of these positions, exact, Q being moved; inside, the midpoint of a segment
  /// The connected piece of all that touches, from 0 on. Its corners are among its pairs of dimension 0.
  std::uint32_t patch = 0;
  friend bool operator==(const SolidTouch&, const SolidTouch&) = default;
};

/// A shortest move of Q: one that separates overlapping solids, or brings those apart in touch.
struct SolidWay {
  RationalPoint3 move;  ///< exact
  Point3 direction;     ///< of length 1, to within some units in the last place; zero where `move` is
  /// All pairs of features that touch once Q is moved: the greatest dimension first, then by p, q and position. A pair
  /// is listed once for every connected piece of what it has in common.
  std::vector<SolidTouch> contacts;
};

struct SolidDistance {
  Meeting meeting = Meeting::apart;
  Rational squared;            ///< the exact square of `distance`
  double distance = 0;         ///< the penetration depth of overlapping solids, the gap between others; nearest double
  std::vector<SolidWay> ways;  ///< all shortest moves, sorted by x, y, z; one of nothing where the solids touch
  /// False where the time limit came first: `squared` and `ways` are empty, `distance` is infinite or the length of a
  /// move that does, and the shortest one is at least `at_least` long.
  bool complete = true;
  double at_least = 0;

  struct Work {
    std::uint64_t facets = 0;           ///< of the convolution that were looked at
    std::uint64_t candidates = 0;       ///< positions that were queried
    std::uint64_t exact_tests = 0;      ///< of these, in exact arithmetic
    std::uint64_t collision_tests = 0;  ///< exact ones; none where a free position of the last answer decides
  };
  Work work;  ///< no part of the value
  friend bool operator==(const SolidDistance& a, const SolidDistance& b);
};

enum class DepthEngine : std::uint8_t {
  search,    ///< best first over the facets of the convolution; the sum is never built (the default)
  boundary,  ///< all faces and tight features of the exact sum: the reference
};

struct DepthOptions {
  DepthEngine engine = DepthEngine::search;
  int threads = 0;  ///< of the preparation, 0: as many as there are cores
  Progress progress;
  bool contacts = true;  ///< false: SolidWay::contacts stay empty, which saves more than half of a question's time
};

/// Two solids in fixed orientations, of which Q moves by translations: prepared once, asked often. One of them may be
/// or have thin parts (Mesh::with_thin_parts): points, segments and open surfaces overlap a solid where they meet its
/// interior. Thread-compatible; copies share what is prepared.
class SolidDepth {
 public:
  /// Cost: the facets of the reduced convolution of P and -Q (boundary: their exact sum). Errors: no_area for an empty
  /// operand; unsupported_operand for thin parts of both, and for coordinates that need more than 8,192 bits on their
  /// common grid; cancelled. Results that no doubles hold are closed sets, as operands of sums are; their exact sum is
  /// made, contacts are not listed, and a time limit does not count.
  static Result<SolidDepth> create(const SpatialOperand& p, const SpatialOperand& q, const DepthOptions& options = {});

  SolidDepth(const SolidDepth& other);
  SolidDepth& operator=(const SolidDepth& other);
  SolidDepth(SolidDepth&&) noexcept;
  SolidDepth& operator=(SolidDepth&&) noexcept;
  ~SolidDepth();

  /// P against Q moved. Exact: depth and gap, all shortest moves, whatever triangles the surfaces are cut into. A time
  /// limit in seconds is looked at between facets; 0 is none. Requires a finite translation and a limit of at least 0
  /// (else std::invalid_argument). Cost: O(log n) a facet that is nearer than the answer, and what crosses it there.
  SolidDistance at(Point3 q_moved_by = {}, double time_limit = 0);
  /// The same where the translation is given in fractions.
  template <std::same_as<RationalPoint3> Move>
  SolidDistance at(const Move& q_moved_by, double time_limit = 0);
  /// The smallest s >= 0 so that Q, moved also by s times `direction`, does not overlap P. Requires finite vectors, the
  /// direction not zero (else std::invalid_argument). Exact. O(n).
  Rational along(Point3 q_moved_by, Point3 direction);
  template <std::same_as<RationalPoint3> Move>
  Rational along(const Move& q_moved_by, const Move& direction);

  std::size_t facet_count() const;  ///< of the convolution, without those deep inside the sum

 private:
  explicit SolidDepth(std::shared_ptr<const depth::DepthOperands> operands);
  std::shared_ptr<const depth::DepthOperands> operands_;
  std::unique_ptr<depth::DepthProbe> probe_;
};

struct DepthBatchOptions {
  int threads = 0;        ///< 0: as many as there are cores; the rows do not depend on it
  double time_limit = 0;  ///< seconds for each row, 0: none
  Progress progress;
};

/// One row for every translation of Q, in their order. Errors: not_finite with the index of the translation as
/// `vertex`; out_of_range for threads or a limit below 0; cancelled.
Result<std::vector<SolidDistance>> depth_batch(const SolidDepth& pair, std::span<const Point3> moves,
                                               const DepthBatchOptions& options = {});
Result<std::vector<SolidDistance>> depth_batch(const SolidDepth& pair, std::span<const RationalPoint3> moves,
                                               const DepthBatchOptions& options = {});

/// Two solids and how Q is moved.
struct DepthQuestion {
  const Mesh* p = nullptr;
  const Mesh* q = nullptr;
  Point3 q_moved_by;
};
/// One row for every pair, in their order: its distance, or why it has none. The time limit counts from when the pair
/// is prepared. Errors: out_of_range; cancelled.
Result<std::vector<Result<SolidDistance>>> depth_batch(std::span<const DepthQuestion> questions,
                                                       const DepthBatchOptions& options = {});

/// A vertex of a region, or the edge that starts there, without its ends: those of the rings, then of the polylines,
/// then the points.
struct PlanarFeature {
  enum class Kind : std::uint8_t { vertex, edge };
  Kind kind = Kind::vertex;
  std::uint32_t index = 0;
  friend auto operator<=>(const PlanarFeature&, const PlanarFeature&) = default;
};

/// The same in the plane: features that have a point (dimension 0) or a segment (1) in common.
struct PlanarTouch {
  PlanarFeature p, q;
  int dimension = 0;
  RationalPoint at;
  std::uint32_t patch = 0;
  friend bool operator==(const PlanarTouch&, const PlanarTouch&) = default;
};

/// A shortest move of planar Q.
struct PlanarWay {
  RationalPoint move;                 ///< exact
  Point direction;                    ///< of length 1, rounded; zero where `move` is
  std::vector<PlanarTouch> contacts;  ///< all pairs that touch then, as those of SolidWay
};

struct PlanarDistance {
  Meeting meeting = Meeting::apart;
  Rational squared;
  double distance = 0;
  std::vector<PlanarWay> ways;  ///< all shortest moves, sorted by x, y
};

/// The same of two planar regions, with holes: the distance of a point to the boundary and the tight features of their
/// exact sum P (+) -Q, which is built once. One of them may be or have polylines and points: these overlap what has
/// area where they meet its interior. Thread-safe.
class PlanarDepth {
 public:
  /// Errors: no_area where an operand is empty; unsupported_operand where both have polylines or points; those of
  /// minkowski_sum.
  static Result<PlanarDepth> create(const Region& p, const Region& q);
  /// Requires a finite translation (else std::invalid_argument). Exact. O(n) for n edges of the sum.
  PlanarDistance at(Point q_moved_by = {}) const;
  /// The same where the translation is given in fractions.
  template <std::same_as<RationalPoint> Move>
  PlanarDistance at(const Move& q_moved_by) const;

 private:
  std::shared_ptr<const PlanarSum> sum_;
  std::shared_ptr<const depth::TouchingPairs> touching_;
};

}  // namespace dymsum
