#include "versus/segment_delaunay.h"

#include <CGAL/Segment_Delaunay_graph_2.h>
#include <CGAL/Segment_Delaunay_graph_filtered_traits_2.h>
#include <CGAL/Simple_cartesian.h>

#include <chrono>
#include <utility>

namespace dymsum::bench {
namespace {

using Traits = CGAL::Segment_Delaunay_graph_filtered_traits_without_intersections_2<CGAL::Simple_cartesian<double>>;
using DelaunayGraph = CGAL::Segment_Delaunay_graph_2<Traits>;

}  // namespace

struct SegmentDelaunay::Sites {
  std::vector<Traits::Point_2> points;
  std::vector<std::pair<std::size_t, std::size_t>> segments;
  std::vector<Traits::Point_2> single;

  void add(const std::vector<Point>& chain, bool ring) {
    const std::size_t first = points.size();
    for (const Point& p : chain) points.emplace_back(p.x, p.y);
    for (std::size_t i = first; i + 1 < points.size(); ++i) segments.emplace_back(i, i + 1);
    if (ring) segments.emplace_back(points.size() - 1, first);
  }
};

SegmentDelaunay::SegmentDelaunay(const RegionData& region) : sites_(std::make_unique<Sites>()) {
  for (const Part& part : region.parts) {
    sites_->add(part.outer, true);
    for (const Ring& hole : part.holes) sites_->add(hole, true);
  }
  for (const Polyline& line : region.polylines) sites_->add(line, false);
  for (const Point& p : region.points) sites_->single.emplace_back(p.x, p.y);
}

SegmentDelaunay::~SegmentDelaunay() = default;

SegmentDelaunay::Answer SegmentDelaunay::build() const {
  const auto start = std::chrono::steady_clock::now();
  DelaunayGraph graph;
  graph.insert_segments(sites_->points, sites_->segments.begin(), sites_->segments.end());
  for (const Traits::Point_2& p : sites_->single) graph.insert(p);
  const std::chrono::duration<double, std::milli> passed = std::chrono::steady_clock::now() - start;
  Answer answer{passed.count(), 0};
  for (auto face = graph.finite_faces_begin(); face != graph.finite_faces_end(); ++face) ++answer.faces;
  return answer;
}

}  // namespace dymsum::bench
