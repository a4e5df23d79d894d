// Sums of a region with an exact disc of any radius; erosion, opening and closing by one. The boundary is made of
// segments and true arcs, each named by what it comes from.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum {

/// The complement of a region has a complex like its own: discs grow outside of the region (sum, closing) or inside
/// (erosion, opening).
enum class DiscSide : std::uint8_t { outside, inside };

/// A radius: a rational, or exactly the one of an event, which need not be rational.
struct DiscRadius {
  Rational value;                                  ///< where no event is named
  std::optional<std::uint32_t> event;              ///< into GrowingDisc::events of the side at hand
  DiscRadius(Rational r) : value(std::move(r)) {}  // NOLINT(google-explicit-constructor)
  static DiscRadius at_event(std::uint32_t index) {
    DiscRadius radius{Rational()};
    radius.event = index;
    return radius;
  }
  friend bool operator==(const DiscRadius&, const DiscRadius&) = default;
};

/// A radius at which the pieces of the boundary change. Coincident changes are one event.
struct DiscEvent {
  double radius = 0;        ///< the nearest double
  std::uint32_t nodes = 0;  ///< discs of that radius which touch the region in a way that others beside them do not
};

/// A disc of the radius at hand that touches the region twice: on an edge of the complex, where nothing happens at this
/// radius, or at a node. (See docs/design/disc-sum.md; indices are those of GrowingDisc.)
struct CornerDisc {
  bool at_node = false;
  std::uint32_t index = 0;  ///< of the edge of the complex, or of the node
  friend bool operator==(const CornerDisc&, const CornerDisc&) = default;
};

/// A point at which two pieces of a boundary meet.
struct DiscCorner {
  enum class Kind : std::uint8_t {
    none,      ///< a whole circle starts nowhere in particular
    vertex,    ///< over vertex `vertex` of the region, where a moved edge and the arc about its end meet smoothly; or
               ///< that vertex itself
    centre,    ///< the centre of `disc`: the boundary has a corner there
    contact,   ///< where `disc` touches the region: an arc about it begins or ends smoothly
    crossing,  ///< of the arcs about `disc` and `other`
  };
  Kind kind = Kind::none;
  std::uint32_t vertex = 0;
  CornerDisc disc, other;
  Point at;  ///< within DiscSet::at_error
};

/// A segment, or an arc of the radius at hand. It ends where the next one of the ring begins.
struct DiscPiece {
  enum class Of : std::uint8_t {
    edge,    ///< of the region: a part of edge `index`, moved by the radius along its normal (sum, erosion) or in place
    vertex,  ///< an arc about vertex `index` of the region
    disc,    ///< an arc of the boundary of `disc`
  };
  Of of = Of::edge;
  std::uint32_t index = 0;
  CornerDisc disc;
  Point centre;           ///< of an arc
  double from_angle = 0;  ///< of an arc: the direction from its centre to its start, in radians
  double sweep = 0;       ///< of an arc: the angle it covers, positive counter-clockwise
  double heading = 0;     ///< of a segment: its direction, in radians
  DiscCorner from;
};

/// A boundary ring with the set on its left; it meets itself nowhere, other rings at single points.
struct DiscRing {
  std::vector<DiscPiece> pieces;
};

struct DiscPart {
  DiscRing outer;
  std::vector<DiscRing> holes;
};

/// A segment that belongs to a set without area about it, or a tight one: a part of edge `edge` of the complex, or of
/// the region where the radius is 0.
struct DiscSegment {
  DiscCorner from, to;
};

/// The side on which polygons that stand for a set lie: in it, around it, or with all vertices on its boundary.
enum class DiscBound : std::uint8_t { inside, outside, nearest };

struct DiscPolygons {
  Region region;
  double error = 0;        ///< no boundary point of either is further than this from the other's boundary
  double rounded = 0;      ///< how far rounding to doubles moved a vertex at most: a part of `error`
  std::size_t chords = 0;  ///< segments that stand for arcs
  /// `nearest`: intervals of the boundary along which two sides are nearer to each other than positions are known, and
  /// rings as small: what of the set is as thin as that is in the points and polylines of `region`, what is beside it
  /// is closed, which the error says nothing of. `inside`: more than 0 where what is no wider than twice the error may
  /// be left out, which the error says nothing of: of a set that vanishes all may be.
  std::size_t collapsed = 0;
};

/// A set whose boundary is made of segments and arcs. Which pieces there are and how they follow each other is exact;
/// positions are doubles near the exact ones.
struct DiscSet {
  std::vector<DiscPart> parts;              ///< closures of the connected interiors
  std::vector<DiscSegment> segments;        ///< pieces of the set without area
  std::vector<DiscCorner> points;           ///< the same
  std::vector<DiscSegment> tight_segments;  ///< where a disc fits exactly, without room to move sideways
  std::vector<DiscCorner> tight_points;     ///< without any room
  double radius = 0;                        ///< the nearest double
  std::string radius_exact;                 ///< "3/2", or a formula of roots at an event
  double at_error = 0;                      ///< positions are within this in each coordinate

  std::size_t hole_count() const;
  std::size_t piece_count() const;
};

/// A double and how far it may be from the exact number.
struct Measured {
  double value = 0, error = 0;
};
/// Infinite past the range of doubles.
Measured area(const DiscSet& set);
/// The same as decimal numbers of 17 significant digits with exponents of any size.
struct MeasuredText {
  std::string value, error;
};
MeasuredText area_text(const DiscSet& set);
/// The length of all boundary rings; pieces without area do not count.
Measured perimeter(const DiscSet& set);
/// {min x, min y, max x, max y} within at_error; zeros for the empty set.
std::array<double, 4> bounds(const DiscSet& set);

/// Segments in place of arcs. `inside`: before its vertices are rounded, the polygon lies in the set; `outside`: the
/// set in the polygon; `nearest`: its vertices lie on the boundary, each rounded to the nearest doubles, and chords on
/// either side of it. Vertices within at_error of each other are one where rounding makes them cross. Where the
/// polygons on one side cross, as where two arcs touch each other in a cusp, and of parts no wider than rounding, they
/// are made of the nearest ones by a margin: outside with a square all about them, inside where such a square fits into
/// them. Errors: out_of_range where `error` is not a positive number or below what doubles can keep;
/// rounding_changed_topology where `nearest` polygons cross because of `error` (a smaller one may do).
Result<DiscPolygons> to_region(const DiscSet& set, double error, DiscBound bound = DiscBound::inside);

/// The set as JSON text: every ring with its pieces by name; as a picture over the region it comes from, with true
/// arcs.
std::string disc_set_to_json(const DiscSet& set);
std::string draw_disc_set(const Region& p, const DiscSet& set);

struct GrowingDiscOptions {
  bool brute = false;  ///< compare all with all instead of neighbours; the same result, for tests
};

/// All discs of a region at once. What belongs to all radii is made once for each side, when first requested; a radius
/// then costs one pass over it. Copies share it. Thread-safe.
class GrowingDisc {
 public:
  explicit GrowingDisc(Region region, GrowingDiscOptions options = {});
  const Region& region() const;

  /// Radii at which the boundary's pieces change, positive and ascending. O(n log n) when first requested.
  Result<std::vector<DiscEvent>> events(DiscSide side, const Progress& progress = {}) const;

  // Errors of the following: out_of_range for a negative radius, an event that there is not, coordinates beyond 2^1000
  // and discs larger than doubles reach; outside, unsupported_operand where a polyline or point touches another piece,
  // with the position; cancelled, where `progress` stops it: it is queried before and after the stages "complex", once
  // for a side, and "set". Radius 0 gives the region. Cost: O(n).

  /// P + D, { x : distance from P at most r }. Tight features, of the open semantics: where a disc that stays clear of
  /// P touches it on all sides.
  Result<DiscSet> sum_at(const DiscRadius& r, Semantics semantics = Semantics::closed,
                         const Progress& progress = {}) const;
  /// { x : x + D inside P }. Positions without room to move are `segments` and `points`, and tight; regular drops them,
  /// open only lists them as tight. Polylines and points hold no disc.
  Result<DiscSet> eroded_at(const DiscRadius& r, Semantics semantics = Semantics::closed,
                            const Progress& progress = {}) const;
  /// All discs of radius r inside P. closed and open: with those that fit exactly; regular: the closure of what the
  /// others cover. Polylines and points hold no disc.
  Result<DiscSet> opened_at(const DiscRadius& r, Semantics semantics = Semantics::closed,
                            const Progress& progress = {}) const;
  /// P with all that no disc of radius r outside of P reaches. closed and regular: discs without room to move do not
  /// reach; open: they do. Polylines and points stay as thin as they are, as `segments` and `points`, where discs reach
  /// them from both sides, or from all.
  Result<DiscSet> closed_at(const DiscRadius& r, Semantics semantics = Semantics::closed,
                            const Progress& progress = {}) const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace dymsum
