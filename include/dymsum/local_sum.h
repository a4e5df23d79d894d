// The part of a sum of two solids that lies near a position: P (+) Q cut to a box, exactly, without the rest of the
// sum.
#pragma once

#include <cstdint>
#include <memory>

#include "dymsum/mesh.h"
#include "dymsum/progress.h"
#include "dymsum/result.h"
#include "dymsum/rotation.h"
#include "dymsum/spatial_sum.h"

namespace dymsum {

/// The closed box from `low` to `high`.
struct ClipBox {
  Point3 low, high;
  friend bool operator==(const ClipBox&, const ClipBox&) = default;
};

/// A closed ball. Spheres have no rational sections: a ball selects faces, and its bounding box cuts them.
struct ClipBall {
  Point3 centre;
  double radius = 0;
};
/// The smallest box of doubles that holds the ball.
ClipBox bounding_box(const ClipBall& ball);

/// How the facets of the convolution near the box are found. All give the same part.
enum class LocalEngine : std::uint8_t {
  updated,    ///< those of the last call are brought to the new poses (the default)
  hierarchy,  ///< by bounding spheres over pairs of features, anew at every call
  brute,      ///< the whole sum, every cell and place tested by itself, then cut: the reference
};

struct LocalOptions {
  LocalEngine engine = LocalEngine::updated;
  bool tight = true;  ///< look for tight features
  int threads = 1;    ///< 0: as many as there are cores; the result does not depend on it
  Progress progress;
};

struct LocalPart {
  /// What the box cuts out of the boundary of P (+) Q: of every face and tight face the pieces with area, of every
  /// tight segment those with length, and the tight points, the box's own sides included; what only touches the box is
  /// left out. Canonical as a whole sum is; exact positions by SpatialSum::exact. Its surface is open where the box
  /// cuts it: edges there have one face, `shells` counts pieces that hang together inside the box, and volume(),
  /// rounded() and as_mesh() are of no use. Faces name one pair of features that touches there.
  SpatialSum boundary;
  ClipBox box;  ///< that it is cut to

  enum class Where : std::uint8_t {
    crossed,  ///< something is listed
    inside,   ///< nothing is, and the box lies in the sum
    outside,  ///< nothing is, and its inside lies outside
  };
  Where where = Where::outside;

  struct Work {
    bool rebuilt = false;      ///< the facets were found anew
    std::uint64_t pairs = 0;   ///< of features that the bounding spheres left (hierarchy)
    std::uint64_t facets = 0;  ///< of the convolution that come near the box
    std::uint64_t contacts = 0, collision_tests = 0, tight_tests = 0, exact_signs = 0;
    double ms = 0;
  };
  Work work;  ///< no part of the value
  /// The same set; provenance is not compared.
  friend bool operator==(const LocalPart& a, const LocalPart& b) {
    return a.where == b.where && a.boundary == b.boundary;
  }
};

/// Two solids whose sum is requested near one position after the other, while both turn and scale. One thread at a
/// time. Source: Behar 2016, section 7.2 (docs/design/local-sum.md).
class LocalSum {
 public:
  /// Errors: out_of_range for threads below 0; unsupported_operand for parts without volume; cancelled.
  static Result<LocalSum> create(const Mesh& p, const Mesh& q, const LocalOptions& options = {});
  LocalSum(LocalSum&&) noexcept;
  LocalSum& operator=(LocalSum&&) noexcept;
  ~LocalSum();

  /// P (+) Q at these poses, cut to the box. Requires low < high along every axis (else Error out_of_range;
  /// not_finite). A translation moves the sum along, and is left to the caller. Errors too: unsupported_operand where
  /// poses and box need more than 8,192 bits; cancelled. Exact: equal to the whole sum cut. Cost: what changed of the
  /// convolution (hierarchy: pairs of features whose bounding spheres reach the box); then the stages of a sum for the
  /// facets that come near the box.
  Result<LocalPart> in(const ClipBox& box, const SolidPose& p = {}, const SolidPose& q = {});
  /// The same in the ball's bounding box, less the pieces of faces and tight features that do not meet the closed ball,
  /// decided exactly. `where` is that of the ball's inside. Errors too: out_of_range for a radius of 0 or less.
  Result<LocalPart> in(const ClipBall& ball, const SolidPose& p = {}, const SolidPose& q = {});

  std::size_t facet_count() const;  ///< of the convolution at the last poses; 0 where it was not made

 private:
  class State;
  explicit LocalSum(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace dymsum
