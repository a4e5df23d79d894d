// Tracks: what becomes of the reflex corners of a sum while its disc grows, and which of them go on where they meet.
// See docs/design/shape-features.md.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "exact/root_expression.h"
#include "shape/complex/complex.h"

namespace dymsum::shape {

// The nodes at which the tracks of a complex begin, meet or end, and what is queried the pockets behind them.

/// A position where tracks begin, meet or end: a node, or nodes that flat edges connect, which lie at one radius.
struct Junction {
  std::vector<std::uint32_t> nodes;    ///< ascending
  std::vector<std::uint32_t> in, out;  ///< edges that ascend to it and from it, ascending

  std::uint32_t node() const { return nodes.front(); }
};

/// All junctions in order of radius, and among equal ones of their first nodes. O(edges).
std::vector<Junction> junctions_of(const Complex& complex);

/// A loop vertex, or kNoIndex where a bridge has no pocket.
struct PocketMinimumAt {
  std::uint32_t vertex = kNoIndex;
  double concavity = 0;
};

/// The side on which the pocket of an edge's bridges lies, seen by a disc that grows along it: it has none between two
/// loops.
enum class PocketAt : std::uint8_t { gap, behind, ahead };

/// What tracks ask about the bridges at the upper ends of edges.
struct PocketOracle {
  std::function<PocketMinimumAt(std::uint32_t edge)> deepest;
  std::function<bool(std::uint32_t edge, std::uint32_t vertex)> holds;  ///< whether the pocket has the vertex inside
  std::function<PocketAt(std::uint32_t edge)> at;
  /// What its discs touch, by ranks that say nothing of indices.
  std::function<std::array<std::uint32_t, 4>(std::uint32_t edge)> contacts;
};

// The diameter from which tracks count: what lets depth count besides age. See docs/design/shape-features.md.

/// The diameter of a node less kAgePerDepth times a depth.
struct Since {
  std::uint32_t node = 0;
  double depth = 0;
};

/// A track is at most so many times as old as its pocket is deep. The pocket of a right angle, 1 / sqrt(8) of the
/// diameter deep, counts from its birth; what is flatter than some 100 degrees, as dents of noise are, counts less.
inline constexpr int kAgePerDepth = 4;

/// Half of that diameter. Exact.
exact::RootExpression half_of(const Complex& complex, const Since& since);
/// -1, 0, 1 for a < b, a = b, a > b. Exact.
int compare(const Complex& complex, const Since& a, const Since& b);

/// What a track is worth at a node: the lesser of its depth and of the diameter there less `since`.
struct TrackWorth {
  Since since;
  std::optional<double> depth;  ///< none: a gap
};
int compare_at(const Complex& complex, std::uint32_t node, const TrackWorth& a, const TrackWorth& b);

/// Per edge, at its outer end: where its pocket is larger. Pockets enter a junction by its inlets, and leave it, as one
/// that holds them all, by its outlet: the edge that ascends, or at a full pocket the edge down to the neck, against
/// its own sense. The track that leaves counts from the least `since` of those that enter, at a neck not later than
/// from there; without any, from the junction. Where an edge ends above a pocket of depth c, it counts at least from
/// the diameter there less kAgePerDepth c. Flat edges have none. O(edges) questions.
std::vector<Since> since_of(const Complex& complex, const std::vector<Junction>& junctions,
                            const PocketOracle& pockets);

/// The edges by which pockets enter a junction, and gaps whose track goes on from it.
std::vector<std::uint32_t> inlets_of(const Junction& junction, const PocketOracle& pockets);

/// The life of a corner of the sum.
struct Bar {
  enum class Death : std::uint8_t {
    merged,  ///< it met an older one, `parent`, which goes on
    filled,  ///< the disc nowhere fits beyond it: a pocket or hole is full
    never,
  };
  Death death = Death::never;
  std::uint32_t birth = 0;         ///< junction
  std::uint32_t end = kNoIndex;    ///< junction where it dies; kNoIndex: never
  std::uint32_t last = kNoIndex;   ///< the edge that it dies on, or leaves on
  std::uint32_t first = kNoIndex;  ///< the edge that it is born on
  std::uint32_t parent = kNoIndex;
  std::uint32_t minimum = kNoIndex;  ///< what `deepest` told of its last edge, or where that belongs to a younger bar,
  double concavity = 0;              ///< of the edge on which it met that
  TrackWorth worth;                  ///< at its death
  std::uint32_t until_neck_of = kNoIndex;
};

struct Tracks {
  std::vector<Junction> junctions;
  std::vector<Bar> bars;
  std::vector<std::uint32_t> bar_of;  ///< edge -> bar; kNoIndex for flat edges
};

/// Where tracks meet, the bar above goes on with the one whose pocket holds its minimum; where none does, with a gap if
/// there is one, else with what counts most there, then by the lesser contacts. Bars are ordered by their births, then
/// the contacts of their first edges. Indices decide last of all. What bars are worth does not depend on that: see
/// docs/design/shape-features.md. O(edges) questions. Throws std::logic_error where a track would split, which no
/// complex has.
Tracks tracks_of(const Complex& complex, const PocketOracle& pockets);

}  // namespace dymsum::shape
