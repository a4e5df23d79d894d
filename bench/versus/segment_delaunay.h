// CGAL's segment Delaunay graph (package Segment_Delaunay_graph_2): doubles as input, filtered predicates that are
// exact, nothing constructed.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "dymsum/region.h"

namespace dymsum::bench {

/// The boundary of a region as CGAL's sites, made before any clock starts. Its pieces may meet at vertices only.
class SegmentDelaunay {
 public:
  explicit SegmentDelaunay(const RegionData& region);
  ~SegmentDelaunay();

  struct Answer {
    double ms = 0;
    std::size_t faces = 0;  ///< finite ones, discs that touch three sites, on both sides of the boundary
  };
  /// One graph from nothing, its sites in CGAL's spatial order.
  Answer build() const;

 private:
  struct Sites;
  std::unique_ptr<Sites> sites_;
};

}  // namespace dymsum::bench
