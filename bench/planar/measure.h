// One row of the table: our sum of a pair, its rivals, and whether all say the same.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dymsum/planar_sum.h"
#include "planar/pairs.h"
#include "versus/rival.h"

namespace dymsum::bench {

struct OurAnswer {
  double median_ms = 0, min_ms = 0;
  double fresh_ms = 0;  ///< from points: two regions made, with all their checks, and one sum
  int runs = 0;
  double area = 0;
  std::string area_exact;  ///< "num/den", only for sums small enough to add up
  std::size_t outer = 0, holes = 0, vertices = 0;
  ConvolutionSizes convolution;
  SumStats stats;
};

/// How our answer and CGAL's reduced convolution relate.
enum class Verdict {
  equal,        ///< same holes, same vertices, same area
  cgal_defect,  ///< they differ, and another CGAL method says what we say
  mismatch,
  unknown,  ///< CGAL gave no answer
};

struct Row {
  std::string name;
  Group group = Group::thesis;
  bool large = false;
  std::size_t p_vertices = 0, q_vertices = 0;
  std::size_t p_corners = 0, q_corners = 0;  ///< vertices that are not collinear with their neighbours
  OurAnswer ours;
  RivalAnswer reduced, full, angle_bisector, vertical, clipper, clipper2;
  Verdict verdict = Verdict::unknown;
  std::string remark;

  double ratio() const { return reduced.median_ms / ours.median_ms; }  ///< against CGAL's reduced convolution
  /// Whether a Clipper says what we say: the same holes, and the area to 1e-6, as it sums on a grid of 28 bits.
  bool agrees(const RivalAnswer& clipper) const;
  double fresh_ratio() const { return reduced.median_ms / ours.fresh_ms; }
  /// Against whichever of CGAL's methods was fastest with the right answer.
  double ratio_to_best_cgal() const;
};

struct Effort {
  bool rivals = true;         ///< measure CGAL's reduced convolution
  double others_limit_s = 0;  ///< seconds each other rival gets in its own process; 0 leaves them out
};

Row measure_pair(const Pair& pair, const Effort& effort);

}  // namespace dymsum::bench
