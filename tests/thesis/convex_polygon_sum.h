// Sums of convex polygons, kept exact while the operands rotate and scale: the planar case of ConvexSum, as the thesis
// has it (5.2), with the same names.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "dymsum/planar_pose.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum {

/// The exact sum of two convex polygons. Canonical: counter-clockwise, no vertex inside an edge, from the
/// smallest pair on.
struct PolygonSum {
  /// A vertex of P plus a vertex of Q, by their indices in the regions. From one to the next P's vertex changes along
  /// an edge of P, or Q's along one of Q, or both along parallel edges.
  struct Vertex {
    std::uint32_t p = 0, q = 0;
    friend auto operator<=>(const Vertex&, const Vertex&) = default;
  };
  std::vector<Vertex> vertices;
  std::vector<RationalPoint> exact;  ///< their positions
  friend bool operator==(const PolygonSum&, const PolygonSum&) = default;

  Rational area_exact() const;
  std::vector<Point> rounded() const;  ///< each coordinate the nearest double
};

/// The work of one move.
struct PolygonWork {
  std::uint64_t vertex_checks =
      0;  ///< edges of P whose extreme vertex was looked at; the certificates of the others held
  std::uint64_t vertex_errors = 0;  ///< of these, wrong and corrected
  std::uint64_t steps = 0;          ///< from vertex to vertex
  std::uint64_t exact_signs = 0;    ///< that doubles did not decide
  friend bool operator==(const PolygonWork&, const PolygonWork&) = default;
};

/// Holds P (+) Q as the vertex of Q that is extreme in the direction of every edge of P, and corrects these pointers
/// when the operands move; the result equals a fresh computation, always. Thread-compatible.
class ConvexPolygonSum {
 public:
  /// At the identity. Errors: unsupported_operand unless both are one part without holes, polylines and points;
  /// not_convex with the reflex vertex. O(m + n).
  static Result<ConvexPolygonSum> create(const Region& p, const Region& q);

  ConvexPolygonSum(const ConvexPolygonSum&);  ///< an independent copy
  ConvexPolygonSum& operator=(const ConvexPolygonSum&);
  ConvexPolygonSum(ConvexPolygonSum&&) noexcept;
  ConvexPolygonSum& operator=(ConvexPolygonSum&&) noexcept;
  ~ConvexPolygonSum();

  /// Moves P and Q to these poses. Each certificate holds for an angle, so small motions look at few edges. O(edges of
  /// P), a comparison each, plus the steps.
  const PolygonWork& set(const PlanarPose& p, const PlanarPose& q = {});
  /// Forgets all certificates and starts from nothing: what moving is compared with.
  const PolygonWork& rebuild();
  const PolygonWork& work() const;
  const PlanarPose& p_pose() const;
  const PlanarPose& q_pose() const;

  /// The sum at the current poses, by merging directions along the pointers. O(m + n).
  PolygonSum sum() const;
  /// Whether the combinatorics are those of another sum of the same operands.
  bool same_combinatorics(const ConvexPolygonSum& other) const;

 private:
  class State;
  explicit ConvexPolygonSum(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace dymsum
