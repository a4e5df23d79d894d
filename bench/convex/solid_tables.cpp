// Convex sums of solids that share an axis, and of large ones.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "convex/cells.h"
#include "convex/motion_tables.h"
#include "dymsum/shapes.h"

namespace dymsum::bench {
namespace {

/// A gear without what lies between its teeth.
Ring gear_hull(int teeth) {
  Ring ring;
  for (int k = 0; k < teeth; ++k)
    for (const double side : {-0.125, 0.125}) {
      const double angle = 2 * std::numbers::pi * (k + side) / teeth;
      ring.push_back({4 * std::cos(angle), 4 * std::sin(angle)});
    }
  return ring;
}

/// Solids about the z axis, in triangles.
Models round_models() {
  const auto triangles = [](const Mesh& mesh) { return triangulated(mesh).mesh; };
  Models models = solids::thesis_models();
  std::erase_if(models, [](const solids::NamedMesh& m) {
    return m.name != "cone" && m.name != "cylinder" && m.name != "DD" && m.name != "ellipse" && m.name != "v-rod";
  });
  models.push_back({"box", triangles(solids::box(-1, -2, -1, 1, 2, 1))});
  models.push_back({"prism 12", triangles(solids::prism(shapes::disc(12, 2, shapes::demo_snap(2)).parts().front().outer,
                                                        3, solids::kDemoSnap))});
  models.push_back({"gear 24", triangles(solids::prism(gear_hull(24), 3, solids::kDemoSnap))});
  models.push_back({"cylinder 250", solids::cylinder(250, 2, 3, solids::kDemoSnap)});
  models.push_back({"cylinder 1000", solids::cylinder(1000, 2, 3, solids::kDemoSnap)});
  return models;
}

}  // namespace

void shared_axis_table(Report& report, Kind kind, const WantedPair& wanted) {
  report.line("\n## Shared axes, 500 steps a turn\n");
  report.line(
      "P turns about z, the axis of both solids, from where they stand: a quarter of a turn and a little more, 130 "
      "moves. `static, a facet`: against the same pair, P turning about random axes.\n");
  report.heading({"pair", "triangles", "facets", "about random axes", "update us", "static us", "/ update",
                  "static, a facet ns", "about random axes", "shared / random", "brute merged us",
                  "update + solid us, mean", "p99", "worst", "static + solid us", "/ update + solid", "CGAL hull us",
                  "/ update + solid", "compared, different"});
  const Models models = with_coordinates(round_models(), kind);
  std::size_t slower = 0, expensive = 0, different = 0, rows = 0;
  for (const auto& [p, q] : {std::pair{"cylinder", "cylinder"},
                             {"cone", "cone"},
                             {"cone", "cylinder"},
                             {"DD", "DD"},
                             {"box", "box"},
                             {"box", "cylinder"},
                             {"prism 12", "prism 12"},
                             {"gear 24", "gear 24"},
                             {"gear 24", "cylinder"},
                             {"ellipse", "ellipse"},
                             {"cylinder", "v-rod"},
                             {"cylinder 250", "cylinder 250"},
                             {"cylinder 1000", "cylinder 1000"}}) {
    const solids::NamedMesh &a = model(models, p), &b = model(models, q);
    if (!wanted(a, b)) continue;
    const bool large = a.mesh.triangle_count() > 900 || b.mesh.triangle_count() > 900;
    MotionProtocol protocol;
    protocol.moves = 130;
    protocol.brute_moves = large ? 0 : 1;
    protocol.hull_moves = a.mesh.triangle_count() > 3000 ? 0 : 1;
    protocol.solids = true;
    const MotionRow r = measure_shared_axis(a, b, 500, protocol);
    protocol.moves = large ? 20 : 100;
    protocol.brute_moves = protocol.hull_moves = 0;
    protocol.solids = false;
    const MotionRow free = measure_rotation(a, b, 500, protocol);
    const double facet_ns = 1e3 * r.static_us / static_cast<double>(r.facets),
                 free_ns = 1e3 * free.static_us / static_cast<double>(free.facets);
    report.row({pair_of(r), text(r.p_triangles) + ", " + text(r.q_triangles), text(r.facets), text(free.facets),
                us(r.update_us), us(r.static_us), "**" + ratio(r.static_us, r.update_us) + "**", fixed(facet_ns, 0),
                fixed(free_ns, 0), fixed(facet_ns / free_ns, 1), us(r.brute_merged_us), us(r.update_solid_us.mean),
                us(r.update_solid_us.p99), us(r.update_solid_us.worst), us(r.static_solid_us.mean),
                ratio(r.static_solid_us.mean, r.update_solid_us.mean), us(r.hull_us),
                ratio(r.hull_us, r.update_solid_us.mean), compared(r)});
    ++rows;
    slower += r.update_us > r.static_us;
    expensive += facet_ns > 3 * free_ns;
    different += r.different;
  }
  if (rows == 0) return;
  report.line("");
  report.promise("update faster than static on every pair", text(slower) + " slower", slower == 0);
  report.promise("static at most 3 times as expensive a facet as about random axes",
                 text(expensive) + " more expensive", expensive == 0);
  report.promise("solids equal those of the static walk", text(different) + " differ", different == 0);
}

void growth_table(Report& report, Kind kind, const WantedPair& wanted) {
  report.line("\n## Growth, 500 steps a turn\n");
  report.line("Geodesic spheres of ever more triangles, each with itself, 10 moves about random axes.\n");
  report.heading({"triangles", "facets", "update us", "a facet ns", "update + solid us, mean", "a facet ns", "exponent",
                  "static + solid us", "compared, different"});
  double facets_before = 0, us_before = 0;
  for (const int frequency : {6, 12, 24, 50}) {
    const solids::NamedMesh sphere{
        "sphere", hull_with_coordinates(solids::geodesic_sphere(frequency, 1, solids::kDemoSnap), kind).value()};
    if (!wanted(sphere, sphere)) continue;
    MotionProtocol protocol;
    protocol.moves = 10;
    protocol.brute_moves = 0;
    protocol.solids = true;
    const MotionRow r = measure_rotation(sphere, sphere, 500, protocol);
    const auto facets = static_cast<double>(r.facets);
    const double us_now = r.update_solid_us.mean;
    report.row({text(r.p_triangles) + " each", text(r.facets), us(r.update_us), fixed(1e3 * r.update_us / facets, 0),
                us(us_now), fixed(1e3 * us_now / facets, 0),
                us_before > 0 ? fixed(std::log(us_now / us_before) / std::log(facets / facets_before), 2) : "",
                us(r.static_solid_us.mean), compared(r)});
    facets_before = facets, us_before = us_now;
  }
}

}  // namespace dymsum::bench
