// Where exact positions lie to the regular part of a result, and to its tight faces, by rays of rationals: for the few
// positions about which a result is queried by itself, without operands.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "dymsum/spatial_sum.h"
#include "exact/big.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {

using ExactTriangle = std::array<ExactPosition, 3>;

/// -1, 0 or 1 as x comes before, is, or comes after y by x, y, z.
int lexicographic_order(const ExactPosition& x, const ExactPosition& y);
/// Whether x lies on the closed triangle. Requires one with area.
bool lies_on(const ExactPosition& x, const ExactTriangle& triangle);
/// Whether x lies on the closed segment, or is the point that both ends are. Requires ends in the order of positions,
/// or any.
bool lies_on_segment(const ExactPosition& a, const ExactPosition& b, const ExactPosition& x);
/// a + t (b - a).
ExactPosition position_between(const ExactPosition& a, const ExactPosition& b, const exact::BigRational& t);

class ExactLocator {
 public:
  /// O(n log n) for n triangles.
  explicit ExactLocator(const SpatialSum& sum);
  /// Of closed surfaces, and of tight faces from triangle `first_tight` on. Requires triangles with area.
  ExactLocator(std::vector<ExactTriangle> triangles, std::size_t first_tight);

  std::size_t boundary_triangles() const { return first_tight_; }

  enum class Where : std::uint8_t { outside, boundary, inside };
  /// To the regular part. O(log n + k) for k triangles whose boxes are in line with the position along z.
  Where of(const ExactPosition& x) const;
  bool on_tight_face(const ExactPosition& x) const;

  /// The parameters 0 < t < 1, ascending, of positions on the segment between which it passes neither from one side of
  /// the regular part's boundary to another, nor onto a tight face or off it. Some are of neither.
  std::vector<exact::BigRational> cuts(const ExactPosition& from, const ExactPosition& to) const;

 private:
  void add(const SpatialSum& sum, const std::array<std::uint32_t, 3>& triangle);
  void make_tree();
  Box box_around(const ExactPosition& x) const;

  std::vector<ExactTriangle> triangles_;  // of faces, then of tight faces
  std::size_t first_tight_ = 0;
  BoxTree tree_;
  double slack_ = 0;  // doubles of all positions are this near, and more
};

}  // namespace dymsum::spatial
