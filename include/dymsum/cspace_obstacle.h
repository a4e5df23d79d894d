// The exact obstacle of a polygonal robot that translates and rotates: the set of configurations (x, y, theta) at which
// robot R, turned by theta about the origin of its coordinates and then moved by (x, y), overlaps obstacle O. Its slice
// at theta is the interior of O (+) -R(theta); its boundary consists of patches of ruled surfaces, and it is computed
// as a whole: every patch with the exact angles at which it begins and ends. Source: Behar 2016, chapter 4, corrected
// (docs/design/cspace-obstacle.md).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "dymsum/names.h"
#include "dymsum/orientation.h"
#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum::planar {
struct ObstacleInternals;
}

namespace dymsum {

/// A point of configuration space; theta in radians.
struct Configuration {
  double x = 0, y = 0, theta = 0;
  friend bool operator==(const Configuration&, const Configuration&) = default;
};

/// An angle at which the combinatorics of the slice change: a root of an integer polynomial of degree 2 or 4 in t =
/// tan(theta / 2). Listed by increasing theta in (-pi, pi]. At each a patch begins or ends, or something happens at
/// that angle only: something is tight, or the boundary touches itself. (Quarter turns at which more edges are aligned
/// than there are may be listed in any case.)
struct EventAngle {
  double theta = 0;                  ///< nearest known double
  double low = 0, high = 0;          ///< the exact angle lies between them
  std::optional<Orientation> exact;  ///< where the tangent of the half angle is rational
};

/// What happens at an event angle.
struct ObstacleEvent {
  enum class Kind : std::uint8_t {
    alignment,          ///< an edge of the robot becomes parallel to one of the obstacle: contacts change hands
    vertex_on_segment,  ///< a vertex contact meets another contact
    three_segments,     ///< three contacts at once
    /// Free at this one angle only: a contact that can be held but neither reached nor left, as no free placement with
    /// clearance comes near. Of an interval of such, and of a curve of such over angles: one event at each end.
    tight,
  };
  Kind kind = Kind::alignment;
  std::uint32_t angle = 0;  ///< index in angles()
  Point at;                 ///< position (x, y), rounded
};

/// Tight placements: free at one event angle, and no free placement with clearance comes near them. A point, where
/// `from` equals `to`, or a segment. They belong to the boundary of the obstacle, beside the patches; together these
/// are all of it, except where may_have_tight_curves().
struct TightFeature {
  std::uint32_t angle = 0;  ///< index in angles()
  Point from, to;           ///< positions, rounded
  double error = 0;         ///< each of them is at most so far from the exact one
  friend bool operator==(const TightFeature&, const TightFeature&) = default;
};

/// A piece of ruled surface of the boundary. At every angle of its open interval it is one segment on the line of
/// `contact`, from the meeting with `left` to the meeting with `right`, with the obstacle on its left.
struct Patch {
  static constexpr std::uint32_t kNone = 0xffffffff;
  Contact contact;      ///< edge_of_p: edge of the obstacle + vertex of the robot (`fixed`); edge_of_q: vertex of the
                        ///< obstacle + edge of the robot (`rotating`)
  Contact left, right;  ///< the contacts before and after it along the boundary
  bool left_corner = false, right_corner = false;  ///< they meet in a common vertex pair, and not in a crossing
  std::uint32_t begin = kNone, end = kNone;  ///< indices in angles(); end <= begin: it passes theta = pi; kNone, kNone:
                                             ///< it is there at every angle
  std::uint32_t shell = 0;
  bool rotating() const { return contact.kind == Contact::Kind::edge_of_q; }
};

/// A connected piece of the boundary.
struct Shell {
  bool outer = true;          ///< the free space it bounds reaches infinity; else it is a cavity of the obstacle
  std::uint32_t patches = 0;  ///< how many belong to it
  /// Vertices - edges + patches of the closed surface, if what only touches is taken apart: 2 - 2 handles.
  std::int64_t euler = 0;
  std::uint32_t free_component = 0;  ///< the component of free space on its right
};

/// A piece of free space between two event angles within which one face of the slice stays connected to itself: the
/// nodes of connectivity.
struct FreeCell {
  std::uint32_t begin = Patch::kNone, end = Patch::kNone;  ///< as for patches
  bool unbounded = false;       ///< its component of free space reaches infinity, perhaps at other angles
  std::uint32_t component = 0;  ///< of free space, touching not counted as a connection
};

/// An angle at which a vertex of the robot, turning in place, meets a closed edge of the obstacle, or the other way
/// round; whether the robot may stand there at the angle itself, and after it up to the next one.
struct TurnMark {
  EventAngle angle;
  bool free = false, free_after = false;
};

struct ObstacleWork {
  std::uint64_t windows = 0, segments = 0, candidate_pairs = 0, candidate_triples = 0;
  std::uint64_t surfaces = 0;  ///< contacts that exist at some angle: the thesis's surfaces before trimming
  std::uint64_t potential_events = 0, visible_events = 0;
  std::uint64_t alignments = 0, vertex_events = 0, triple_events = 0, tight_events = 0;
  std::uint64_t local_updates = 0, slices = 0;  ///< event angles handled near the event; by a whole slice
  std::uint64_t exact_signs = 0, collision_tests = 0;
  double ms = 0;
};

struct ObstacleOptions {
  bool reference = false;  ///< every slab by a whole static slice and every potential event kept: slow, for comparison
  Progress progress;
  /// Bytes that may be held at a time by arrays which grow faster than the operands, those of the obstacle included;
  /// each counts before it is made. Past it: out_of_memory. 0: no limit.
  std::uint64_t memory = 0;
};

class CspaceObstacle {
 public:
  /// Regions with holes and several parts. One of the two may have polylines and points besides or instead, which
  /// overlap where they meet the interior of the other one. Contacts name the vertices and edges of walked rings: those
  /// of the parts, then every polyline there and back, a ring of 2 (n - 1) for n vertices, then points; cspace_slice
  /// names both sides of a polyline by its edge. Errors: unsupported_operand for polylines or points in both, as two
  /// pieces without area never overlap; for empty regions, coordinates beyond 2^400, operands wider than 2^920 of their
  /// finest steps; for a polyline that runs along another one, itself or an edge of a part; for polylines and points in
  /// one where rings of the other touch, as these may be held there without clearance at a range of angles, unless they
  /// are one point, or one segment that cannot pass between the rings; cancelled.
  static Result<CspaceObstacle> create(const Region& robot, const Region& obstacle,
                                       const ObstacleOptions& options = {});

  CspaceObstacle(CspaceObstacle&&) noexcept;
  CspaceObstacle& operator=(CspaceObstacle&&) noexcept;
  ~CspaceObstacle();

  const Region& robot() const;
  const Region& obstacle() const;
  const std::vector<EventAngle>& angles() const;
  /// An event angle more exactly than by a double: tan(theta / 2), or tan((theta - pi) / 2) where `opposite`, is within
  /// 2^-100 of high + low, in [-1, 1]. Some multiprecision steps.
  struct HalfTangent {
    bool opposite = false;
    double high = 0, low = 0;
  };
  HalfTangent half_tangent(std::uint32_t angle) const;
  const std::vector<ObstacleEvent>& events() const;
  const std::vector<TightFeature>& tight() const;  ///< by increasing angle
  /// Three contacts stay at one point at every angle: placements may be free along a curve of angles and have no
  /// clearance, of which tight() tells only what is at event angles.
  bool may_have_tight_curves() const;
  const std::vector<Patch>& patches() const;
  const std::vector<Shell>& shells() const;
  const std::vector<FreeCell>& free_cells() const;
  const ObstacleWork& work() const;

  /// The slab of an orientation: slab k lies between angles k and k + 1, the last one passes pi; all are one slab 0
  /// without events. Nothing at an event angle itself. Exact.
  std::optional<std::uint32_t> slab_of(const Orientation& theta) const;
  /// A rational orientation inside a slab, with few bits.
  Orientation inside(std::uint32_t slab) const;
  /// The boundary in a slab: loops of patch indices in the order of the boundary, outer rings counter-clockwise, holes
  /// clockwise.
  std::vector<std::vector<std::uint32_t>> loops(std::uint32_t slab) const;
  /// The free cell on the right of a patch in a slab.
  std::uint32_t free_cell(std::uint32_t slab, std::uint32_t patch) const;

  /// The points at which a patch starts and ends at an angle of its interval, in doubles: within a few roundings unless
  /// the lines are nearly parallel.
  std::array<Point, 2> ends(const Patch& patch, double theta) const;

  /// The exact slice O (+) -R(theta), by the static engine.
  Result<PlanarSum> slice(const Orientation& theta, Semantics semantics = Semantics::closed) const;
  /// Whether the robot overlaps the obstacle there: touching is free, and so is a position that is not finite. Exact:
  /// the doubles x, y at face value. O(n + m) and more; see ObstacleQueries for fast ones.
  bool contains(double x, double y, const Orientation& theta) const;
  /// What happens to the robot at (x, y) while it turns once, in the order of the angles in (-pi, pi]; or on the closed
  /// way counter-clockwise between two different orientations, where the last mark tells what is free up to its end.
  /// Exact, single angles included, at irrational angles too. Without any mark one orientation tells all. O(NM)
  /// filtered pairs, and for each mark some questions of contains.
  std::vector<TurnMark> turn_marks(double x, double y) const;
  std::vector<TurnMark> turn_marks(double x, double y, const Orientation& from, const Orientation& to) const;

 private:
  friend struct planar::ObstacleInternals;
  class State;
  explicit CspaceObstacle(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// O (+) -R(theta), exactly, without the obstacle of all angles. Errors as minkowski_sum.
Result<PlanarSum> cspace_slice(const Region& robot, const Region& obstacle, const Orientation& theta,
                               const SumOptions& options = {});

}  // namespace dymsum
