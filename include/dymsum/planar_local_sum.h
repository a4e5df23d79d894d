// The part of a sum of two regions that lies near a position: P (+) Q cut to a box, exactly, without the rest of the
// sum.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "dymsum/local_sum.h"
#include "dymsum/planar_pose.h"
#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum {

/// The closed box from `low` to `high`.
struct PlanarBox {
  Point low, high;
  friend bool operator==(const PlanarBox&, const PlanarBox&) = default;
};

/// A closed disc. Circles meet edges in irrational points: a disc selects edges, and its bounding box cuts them.
struct PlanarDisc {
  Point centre;
  double radius = 0;
};
/// The smallest box of doubles that holds the disc.
PlanarBox bounding_box(const PlanarDisc& disc);

struct PlanarLocalOptions {
  LocalEngine engine = LocalEngine::updated;  ///< how the segments near the position are found; all give the same part
  Progress progress;
  /// Bytes that may be held at a time by arrays which grow faster than the operands; each counts before it is made.
  /// Past it: out_of_memory. 0: no limit.
  std::uint64_t memory = 0;
};

/// What the box cuts out of the boundary of P (+) Q. Canonical: equal sets are equal values, whatever the engine.
class PlanarLocalPart {
 public:
  /// A maximal segment of the boundary in the box, from vertex to vertex, the sum on its left; of a tight feature, on
  /// both sides. Of several contacts along it the first one is named.
  struct Edge {
    std::uint32_t from = 0, to = 0;
    Contact contact;
  };
  std::vector<Point> vertices;       ///< the nearest doubles; sorted by x, then y; ends of edges, and tight points
  std::vector<Edge> edges;           ///< sorted by their vertices; those in a side of the box count
  std::vector<Edge> tight_segments;  ///< from < to; touching without overlap is allowed only exactly here
  std::vector<std::uint32_t> tight_points;  ///< vertices: the same
  PlanarBox box;                            ///< that it is cut to

  enum class Where : std::uint8_t {
    crossed,  ///< something is listed
    inside,   ///< nothing is, and the box lies in the sum
    outside,  ///< nothing is, and its inside lies outside
  };
  Where where = Where::outside;

  struct Work {
    bool rebuilt = false;               ///< the segments were found anew
    std::uint64_t pairs = 0;            ///< of features that were looked at
    std::uint64_t segments = 0;         ///< of the convolution that come near the box
    std::uint64_t collision_tests = 0;  ///< one for each piece of the boundary in the box, one for each position that
                                        ///< may be tight
    std::uint64_t exact_tests = 0;      ///< of these, that doubles did not decide
    double ms = 0;
  };
  Work work;  ///< no part of the value

  /// The exact position of a vertex. Requires an index of one (else std::out_of_range).
  RationalPoint exact(std::uint32_t vertex) const;
  /// The same set; contacts are not compared.
  friend bool operator==(const PlanarLocalPart& a, const PlanarLocalPart& b);

  struct Positions;

 private:
  friend class PlanarLocalSum;
  std::shared_ptr<const Positions> positions_;
};

/// Two regions whose sum is requested near one position after the other, while both turn and scale. One thread at a
/// time. Source: Behar 2016, section 7.2, in the plane (docs/design/local-sum.md).
class PlanarLocalSum {
 public:
  /// Errors: unsupported_operand for polylines and points, and for coordinates beyond 2^1000; cancelled.
  static Result<PlanarLocalSum> create(const Region& p, const Region& q, const PlanarLocalOptions& options = {});
  PlanarLocalSum(PlanarLocalSum&&) noexcept;
  PlanarLocalSum& operator=(PlanarLocalSum&&) noexcept;
  ~PlanarLocalSum();

  /// P (+) Q at these poses, cut to the box: of every edge and tight segment the pieces with length, and the tight
  /// points. Requires low < high along both axes (else Error out_of_range; not_finite). A translation moves
  /// the sum along, and is left to the caller. Errors too: cancelled. Exact: equal to the whole sum cut. Cost: what is
  /// near the box of pairs of features (updated: of those that were near the last place), the crossings among them, and
  /// a collision test for each piece of the boundary.
  Result<PlanarLocalPart> in(const PlanarBox& box, const PlanarPose& p = {}, const PlanarPose& q = {});
  /// The same in the disc's bounding box, less the edges and tight features that do not meet the closed disc, decided
  /// exactly. `where` is that of the disc's inside. Errors too: out_of_range for a radius of 0 or less.
  Result<PlanarLocalPart> in(const PlanarDisc& disc, const PlanarPose& p = {}, const PlanarPose& q = {});

 private:
  class State;
  explicit PlanarLocalSum(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// A picture of a part as an SVG document: the box, edges with a band on the sum's side, tight features in red.
std::string part_svg(const PlanarLocalPart& part);

}  // namespace dymsum
