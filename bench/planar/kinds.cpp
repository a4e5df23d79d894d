#include "planar/kinds.h"

#include "dymsum/shapes.h"
#include "off_grid.h"
#include "planar/crossing_grates.h"
#include "planar/measure.h"

namespace dymsum::bench {
namespace {

OffGridCase sum_case(const std::string& name, const Region& p, const Region& q) {
  return off_grid_case(name, p, q, [name](const Region& a, const Region& b) {
    OffGridWork work;
    work.run = [a, b] { return minkowski_sum(a, b).value().vertex_count(); };
    work.compare = [name, a, b] {
      const Row row = measure_pair({name, Group::thesis, a, b}, {true, 0});
      const bool wrong = row.verdict == Verdict::mismatch;
      const char* const text = row.verdict == Verdict::equal         ? "equal"
                               : row.verdict == Verdict::cgal_defect ? "CGAL wrong"
                               : wrong                               ? "DIFFERENT"
                                                                     : "no answer";
      return Compared{text, wrong, row.reduced.median_ms};
    };
    return work;
  });
}

}  // namespace

bool measure_kinds(const std::string& folder) {
  const Region grate = shapes::grate(12, 1, 0.25, 12), gear = shapes::gear(30, 8, 10, shapes::demo_snap(10)),
               pinion = shapes::gear(13, 2, 3, shapes::demo_snap(3)),
               pockets = shapes::pockets(20, 10, shapes::demo_snap(10));
  const auto [upright, lying] = crossing_grates(4);
  return off_grid_table(
      {"planar",
       "The sum of two regions that have been summed before. The combs' teeth are exactly as wide as the gaps: on the "
       "grid "
       "most segments lie on others and drop out at once, elsewhere they cross at tiny angles or lie side by side.",
       "vertex", "CGAL",
       "CGAL: its reduced convolution with the exact kernel. Compared: holes, vertices and area with CGAL's; where "
       "they "
       "differ, its vertical decomposition is asked (*CGAL wrong*: it says what we say)."},
      {sum_case("star 100 + star 100", shapes::noisy_star(100, 0.5, 1), shapes::noisy_star(100, 0.5, 2)),
       sum_case("gear 30 + gear 13", gear, pinion),
       sum_case("grate 12 + disc 16", grate, shapes::disc(16, 0.25, shapes::demo_snap(0.25))),
       sum_case("crossing grates 4 + 4", upright, lying),
       sum_case("comb 20 + comb 7, fitting exactly", shapes::comb(20, 2, 1, 3), shapes::comb(7, 2, 1, 3)),
       sum_case("pockets 20 + disc 16", pockets, shapes::disc(16, 0.25, shapes::demo_snap(0.25)))},
      folder);
}

}  // namespace dymsum::bench
