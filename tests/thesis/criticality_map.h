// The criticality map of Mayer, Fogel and Halperin's kind (section 2.7 of Behar's thesis): all structures that the sum
// of two convex solids takes while one makes a full turn about a fixed axis, stored, so that no structure is computed
// later. Exact; here as a comparison with ConvexSum, which follows any motion and stores one structure
// (docs/design/convex-motion.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "dymsum/convex_sum.h"
#include "dymsum/mesh.h"
#include "dymsum/progress.h"
#include "dymsum/result.h"
#include "dymsum/rotation.h"

namespace dymsum {

/// An angle at which a face's normal comes to lie on the arc of normals of an edge of the other solid. P is turned by
/// the quaternion (1, t axis), t = tan(angle / 2) / |axis|, where c0 + c1 t + c2 t^2 = 0.
struct CriticalAngle {
  double radians = 0;  ///< in [0, 2 pi], error below 2^-46
  std::array<std::string, 3>
      coefficients;  ///< c0, c1, c2: integers without common divisor; c2 = 0 has infinity, the half turn, as a root
  int slope = 0;     ///< which root: where the polynomial rises (1), falls (-1) or touches zero (0) as the angle grows
  SolidFeature face, edge;  ///< one pair that meets at this angle
  bool face_of_p = true;    ///< the edge is the other solid's
};

/// What was counted while a map was made, and what it holds.
struct CriticalityStats {
  std::uint64_t pairs = 0;           ///< of a face and an edge of the other solid
  std::uint64_t persistent = 0;      ///< pairs whose normal stays on the edge's circle throughout: no events
  std::uint64_t meetings = 0;        ///< of a normal with an arc during the turn; several may share one critical angle
  std::uint64_t exact_pairs = 0;     ///< pairs that doubles did not decide
  std::uint64_t exact_orders = 0;    ///< comparisons of angles that doubles did not decide
  std::size_t angle_bytes = 0;       ///< the critical angles
  std::size_t key_bytes = 0;         ///< the structures that are stored whole
  std::size_t difference_bytes = 0;  ///< and the differences between consecutive ones
  std::size_t full_bytes = 0;        ///< what all structures stored whole would take instead of the last two
};

/// P turns about an axis through the origin, Q stands still. A value; copies share what they hold.
class CriticalityMap {
 public:
  static constexpr int kAxisBits = 15;

  /// Errors: as ConvexSum::create; bad_rotation for a zero axis or components beyond 2^15; cancelled.
  /// Cost: O(m n) pairs of features, then one update of a ConvexSum per critical angle.
  static Result<CriticalityMap> create(const Mesh& p, const Mesh& q, std::array<std::int32_t, 3> axis,
                                       const Progress& progress = {});

  /// The count of critical angles, which are all different and ascend; interval i lies between angle i and the next
  /// one, the last interval goes through zero.
  std::size_t size() const;
  double angle(std::size_t i) const;  ///< as CriticalAngle::radians
  CriticalAngle exact_angle(std::size_t i) const;
  const CriticalityStats& stats() const;
  /// Memory held, operands included (without what lies behind arbitrary precision).
  std::size_t bytes() const;

  /// A rotation about the axis, within 2^-28 |axis| of an angle, |axis| the length of the primitive axis. Requires: a
  /// finite angle (else std::invalid_argument).
  Rotation near(double radians) const;
  /// A rotation strictly inside interval i; nothing when Rotation cannot express one.
  std::optional<Rotation> inside(std::size_t i) const;

  /// The interval of a rotation; of two that meet there, the one after. Errors: bad_rotation when it is not about the
  /// axis. O(log size).
  Result<std::size_t> interval(const Rotation& rotation) const;
  /// How many facets the generic sum has at a rotation: face + vertex and edge + edge, before coplanar ones merge; at a
  /// critical angle those after it, and where directions coincide throughout one of the ways to distinguish them. From
  /// the stored structures alone. Errors as interval.
  Result<std::size_t> facet_count(const Rotation& rotation) const;
  /// ConvexSum::sum() with P at that rotation, from the stored structure; coincidences and positions are those of the
  /// rotation. Errors as interval.
  Result<SpatialSum> at(const Rotation& rotation) const;

 private:
  class State;
  explicit CriticalityMap(std::shared_ptr<const State> state);
  std::shared_ptr<const State> state_;
};

}  // namespace dymsum
