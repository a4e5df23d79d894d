// Exact Minkowski sums of planar regions: P (+) Q = { p + q : p in P, q in Q }, with holes, several parts,
// lower-dimensional operands, tight features, and the provenance of every edge and vertex.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/trace.h"

namespace dymsum {

class ExactSource;
namespace planar {
struct SumInternals;
}

/// How the boundary is found. All three give the identical canonical result, up to the choice of contacts (SumVertex).
enum class Engine {
  fast,     ///< interior mask, grid, kill rule, collision tests only where needed (the default)
  brute,    ///< all pairs of segments, every loop tested against all pairs of edges: the reference
  winding,  ///< kinetic convolution and winding numbers; no collision test for faces
};

/// closed: the sum of closed sets. open: touching is allowed, the boundary includes the tight features. regular:
/// closure of the interior; tight features and lower-dimensional pieces are dropped.
enum class Semantics { closed, open, regular };

/// Internal: the number tier that tests request. Nothing to be set by users.
class ForcedTier {
  friend struct planar::SumInternals;
  int min_bits_ = 0;
};

struct SumOptions {
  Engine engine = Engine::fast;
  Semantics semantics = Semantics::closed;
  Progress progress;   ///< see progress.h
  bool trace = false;  ///< record the stages in PlanarSum::trace
  /// Bytes that arrays which grow faster than the operands may hold at a time, those of the result included; each
  /// counts before it is made. 0: no limit.
  std::uint64_t memory = 0;
  ForcedTier forced_tier;
};

/// A segment of the convolution: an edge of one operand added to a vertex of the other, by their indices in the
/// regions. Edges in a row on one line, collinear vertices between them, are one edge, named by the first of them.
struct Contact {
  enum class Kind : std::uint8_t {
    edge_of_p,  ///< edge p of P + vertex q of Q
    edge_of_q,  ///< vertex p of P + edge q of Q
  };
  Kind kind = Kind::edge_of_p;
  std::uint32_t p = 0, q = 0;
  friend bool operator==(const Contact&, const Contact&) = default;
};

/// A vertex of the result: the common point of two segments of the convolution. Where a boundary turns from one segment
/// into the next at a sum of two vertices, `corner` names that pair. Positions are unique; where several contacts along
/// one line carry a vertex (parallel edges of P and Q), engines may name different ones; elsewhere they name the same.
struct SumVertex {
  static constexpr std::uint32_t kNone = 0xffffffff;
  Point at;                                          ///< position within PlanarSum::at_error, for reading and drawing
  Contact in, out;                                   ///< the edge that arrives and the edge that leaves
  std::uint32_t corner_p = kNone, corner_q = kNone;  ///< vertex of P + vertex of Q, or kNone at a crossing
};

/// A boundary ring; interior on the left: outer rings counter-clockwise, holes clockwise. Edge k runs from vertices[k]
/// to the next one along vertices[k].out. No collinear vertices; starts at the lexicographically smallest vertex.
struct SumRing {
  std::vector<SumVertex> vertices;
};

struct SumPart {
  SumRing outer;
  std::vector<SumRing> holes;
};

/// A maximal segment of a tight feature or of a lower-dimensional piece; from < to lexicographically.
struct SumSegment {
  SumVertex from, to;
};

/// Sizes of the three convolutions of a pair of operands (see docs/design/planar-sum.md).
struct ConvolutionSizes {
  std::uint64_t full = 0, kinetic = 0, reduced = 0;
  friend bool operator==(const ConvolutionSizes&, const ConvolutionSizes&) = default;
};

/// The work that was done.
struct SumStats {
  int tier_bits = 0;                   ///< 29, 61, 512, or 0 for arbitrary precision
  std::uint64_t reduced_segments = 0;  ///< (kinetic ones for Engine::winding)
  std::uint64_t live_segments = 0;     ///< not wholly inside masked cells
  std::uint64_t cell_entries = 0;
  std::uint64_t pair_tests = 0;
  std::uint64_t crossings = 0;         ///< crossings found between live segments
  std::uint64_t degenerate_nodes = 0;  ///< positions handled by the slow vertex routine
  std::uint64_t loops = 0;             ///< closed loops found
  std::uint64_t collision_tests = 0;
  std::uint64_t filtered_signs =
      0;                          ///< signs decided by the floating-point filter in the exact layer (not the hot loop)
  std::uint64_t exact_signs = 0;  ///< signs that needed exact integers
  int mask_grid = 0;              ///< cells along the longer side, 0 without a mask
  std::uint64_t peak_bytes = 0;   ///< peak of the engine's own arrays
  struct Stage {
    std::string_view name;
    double ms;
  };
  std::vector<Stage> stages;  ///< for operands of more than 100 vertices together: reading the clock takes time
};

/// The exact sum. Coordinates are exact rationals behind approximate ones with a stated error (some units in the last
/// place of the sum's extent); exact() and rounded() give what was promised.
class PlanarSum {
 public:
  std::vector<SumPart> parts;  ///< the closure of the interior, sorted; ring order canonical
  std::vector<SumSegment>
      segments;  ///< one-dimensional pieces of the set (lower-dimensional operands, exact fits of erode)
  std::vector<SumVertex> points;  ///< isolated points of the set (likewise)
  std::vector<SumSegment>
      tight_segments;                   ///< touching without overlap allowed only exactly here: cracks in the open sum
  std::vector<SumVertex> tight_points;  ///< the same: punctures of the open sum
  double at_error = 0;                  ///< |at - exact| is at most this in each coordinate, for every vertex
  SumStats stats;
  std::optional<PlanarTrace> trace;

  std::size_t hole_count() const;
  std::size_t vertex_count() const;  ///< of all rings
  /// The area as one fraction. Its denominator is about the product of those of all crossings: for thousands of them
  /// this costs far more than the sum. O(M(b) log b) for b bits in that product, which may be 250 a crossing.
  Rational area_exact() const;
  /// The same where that product, powers of two apart, has at most `bits` bits; found out before anything is
  /// multiplied.
  std::optional<Rational> area_exact_within(std::size_t bits) const;
  /// The nearest double to the exact area, zero and infinite past the double range. O(n), from positions of about
  /// thirty digits with a proved error; from more digits where that does not decide, and from the fraction only where
  /// the area is a tie of two doubles.
  double area() const;

  /// The exact position of a vertex of this sum.
  RationalPoint exact(const SumVertex& vertex) const;

  /// The set rounded to doubles, every vertex correctly rounded. Error rounding_changed_topology, with the position,
  /// where rounding would make rings cross, merge or collapse. Tight features are not part of the set.
  Result<Region> rounded() const;
  /// The region of rounded(), but vertices that collide after rounding are merged, rings that collapse are dropped and
  /// segments that collapse become points; the report says how many.
  Result<Repaired> rounded_with_repair() const;

  /// Same set and same tight features, exactly. Provenance and stats are not compared.
  friend bool operator==(const PlanarSum& a, const PlanarSum& b);

 private:
  friend struct planar::SumInternals;
  std::shared_ptr<const ExactSource> source_;  // of the exact positions
};

/// P (+) Q. Either may be empty (then the sum is), have several parts and holes, or be polylines and points.
/// Exact: every decision is the sign of an integer expression. Errors: cancelled; unsupported_operand for coordinates
/// beyond 2^1000; out_of_memory past SumOptions::memory and where the machine has no more. Cost: O(n log n + m log m +
/// N
/// + A + k log k) for N reduced segments, A grid cell entries and k live crossings. Source: Behar 2016, chapter 3,
/// corrected (docs/design/planar-sum.md).
Result<PlanarSum> minkowski_sum(const Region& p, const Region& q, const SumOptions& options = {});

/// The no-fit polygon of B around A: A (+) -B, the positions of B's reference point at which B meets A. Provenance
/// indices refer to A and B.
Result<PlanarSum> nfp(const Region& a, const Region& b, const SumOptions& options = {});

/// P (-) Q = { x : x + Q inside P }, the inner fit, including positions without any freedom as `segments` and `points`,
/// which are also listed as tight. Errors: unsupported_operand when P has polylines or points, when Q is empty, and for
/// coordinates beyond 2^996; cancelled.
Result<PlanarSum> erode(const Region& p, const Region& q, const SumOptions& options = {});

/// The union of regions, as the sum with the origin of all their parts together (semantics as for sums). Provenance:
/// `p` indices run through the regions one after the other.
Result<PlanarSum> union_of(const std::vector<Region>& regions, const SumOptions& options = {});

/// Counts only: O(n log m + m log n).
ConvolutionSizes convolution_sizes(const Region& p, const Region& q);

/// True when z lies in the sum: closed and regular operands meet (closed), or overlap (open). Nothing that is not
/// finite does. Exact; O(n + m) and the pairs of edges with boxes that meet where Q, reflected, is moved to z; for many
/// points see contains_each (sum_locator.h). Requires: coordinates of both up to 2^1000 (else std::invalid_argument).
bool contains(const Region& p, const Region& q, Point z, Semantics semantics = Semantics::closed);

}  // namespace dymsum
