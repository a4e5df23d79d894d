// CGAL's planar Minkowski sums (package Minkowski_sum_2, exact kernel EPECK) behind a plain interface, so that no other
// translation unit sees CGAL.
#pragma once

#include <memory>

#include "dymsum/orientation.h"
#include "dymsum/region.h"
#include "versus/rival.h"

namespace dymsum::bench {

enum class CgalMethod {
  reduced_convolution,        ///< minkowski_sum_by_reduced_convolution_2
  full_convolution,           ///< minkowski_sum_by_full_convolution_2, no holes
  small_side_angle_bisector,  ///< decomposition, no holes
  vertical_decomposition,     ///< decomposition, holes allowed
};

const char* name(CgalMethod method);

/// Two operands as CGAL polygons with EPECK numbers, built before any clock starts. Each must be one part.
class CgalOperands {
 public:
  CgalOperands(const RegionData& p, const RegionData& q);
  /// `p` and -R(theta) `q`, the turned vertices being the exact rationals.
  CgalOperands(const RegionData& p, const RegionData& q, const Orientation& theta);
  ~CgalOperands();

  RivalAnswer sum(CgalMethod method, const Repeats& repeats) const;
  /// The same in a forked child, for methods known to crash or hang: stopped after `limit_s` seconds.
  RivalAnswer sum_in_child(CgalMethod method, const Repeats& repeats, double limit_s) const;

 private:
  struct Polygons;
  std::unique_ptr<Polygons> polygons_;
};

}  // namespace dymsum::bench
