#include "cgal/delaunay_discs.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel_with_sqrt.h>
#include <CGAL/Segment_Delaunay_graph_2.h>
#include <CGAL/Segment_Delaunay_graph_traits_2.h>

#include <utility>

namespace dymsum::sdg {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel_with_sqrt;
using Traits = CGAL::Segment_Delaunay_graph_traits_without_intersections_2<Kernel, CGAL::Field_with_sqrt_tag>;
using Graph = CGAL::Segment_Delaunay_graph_2<Traits>;
using Number = Kernel::FT;

std::array<double, 2> interval_of(const Number& v) {
  const std::pair<double, double> ends = CGAL::to_interval(v);
  return {ends.first, ends.second};
}

Number radius2(const Kernel::Point_2& centre, const Graph::Site_2& site) {
  if (site.is_point()) return CGAL::squared_distance(centre, site.point());
  return CGAL::squared_distance(centre, site.segment().supporting_line());
}

}  // namespace

std::vector<Disc> discs_of(const RegionData& region) {
  Graph graph;
  const auto add = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[(i + 1) % ring.size()];
      graph.insert(Kernel::Point_2(a.x, a.y), Kernel::Point_2(b.x, b.y));
    }
  };
  for (const Part& part : region.parts) {
    add(part.outer);
    for (const Ring& hole : part.holes) add(hole);
  }
  std::vector<Disc> discs;
  for (auto face = graph.finite_faces_begin(); face != graph.finite_faces_end(); ++face) {
    const Kernel::Point_2 centre = graph.primal(face);
    const Number r2 = radius2(centre, face->vertex(0)->site());
    discs.push_back({interval_of(centre.x()), interval_of(centre.y()), interval_of(r2)});
  }
  return discs;
}

}  // namespace dymsum::sdg
