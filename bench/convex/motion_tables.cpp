#include "convex/motion_tables.h"

#include <algorithm>

#include "convex/cells.h"
#include "convex/thesis.h"

namespace dymsum::bench {
namespace {

bool on_grid(Kind kind) { return !kind || *kind == Coordinates::grid; }

void heading(Report& report) {
  report.heading({"pair", "triangles", "facets", "update us", "faces, crossings checked, arcs mended", "changed",
                  "brute us", "/ update", "thesis", "brute merged us", "/ update", "expert's us", "/ update",
                  "expert's, by faces us", "/ update", "static us", "/ update", "exact signs", "compared, different"});
}

void line(Report& report, const MotionRow& r, const std::string& kind, double thesis = 0) {
  const auto per_move = [&](std::uint64_t v) {
    return fixed(static_cast<double>(v) / static_cast<double>(r.moves), 1);
  };
  report.row(
      {pair_of(r), text(r.p_triangles) + ", " + text(r.q_triangles), text(r.facets), us(r.update_us),
       per_move(r.work.vertex_checks) + ", " + per_move(r.work.crossing_checks) + ", " + per_move(r.work.arc_checks),
       per_move(r.work.facets_added), us(r.brute_us), "**" + ratio(r.brute_us, r.update_us) + "**",
       thesis > 0 ? fixed(thesis, 2) : "-", us(r.brute_merged_us), ratio(r.brute_merged_us, r.update_us),
       us(r.expert_pairs_us), ratio(r.expert_pairs_us, r.update_us), us(r.expert_faces_us),
       ratio(r.expert_faces_us, r.update_us), us(r.static_us), ratio(r.static_us, r.update_us),
       per_move(r.work.exact_signs), compared(r)});
  const Spread &update = r.update_solid_us, &fresh = r.static_solid_us;
  report.csv << kind << "," << r.p << "," << r.q << "," << r.facets << "," << r.update_us << "," << r.brute_us << ","
             << r.brute_merged_us << "," << r.expert_pairs_us << "," << r.expert_faces_us << "," << r.static_us << ","
             << update.mean << "," << update.median << "," << update.p99 << "," << update.worst << "," << fresh.mean
             << "," << fresh.median << "," << fresh.p99 << "," << fresh.worst << "," << r.fresh_solid_us << ","
             << r.hull_us << "," << r.different << "\n";
}

/// A sum with its facets and positions.
void solids_heading(Report& report) {
  report.heading({"pair", "facets", "update + solid us, mean", "median", "p99", "worst", "static walk + solid us, mean",
                  "worst", "/ update + solid", "from meshes us", "/ update + solid", "CGAL hull us", "/ update + solid",
                  "/ from meshes"});
}

void solids_line(Report& report, const MotionRow& r) {
  const Spread &update = r.update_solid_us, &fresh = r.static_solid_us;
  report.row({pair_of(r), text(r.facets), us(update.mean), us(update.median), us(update.p99), us(update.worst),
              us(fresh.mean), us(fresh.worst), "**" + ratio(fresh.mean, update.mean) + "**", us(r.fresh_solid_us),
              ratio(r.fresh_solid_us, update.mean), us(r.hull_us), ratio(r.hull_us, update.mean),
              ratio(r.hull_us, r.fresh_solid_us)});
}

/// The least and the geometric mean of a ratio over rows.
void promise_ratio(Report& report, const std::vector<MotionRow>& rows, const std::string& what, double promised,
                   const std::function<double(const MotionRow&)>& value) {
  std::vector<double> all;
  const MotionRow* least = nullptr;
  for (const MotionRow& r : rows) {
    if (!(value(r) > 0)) continue;
    all.push_back(value(r));
    if (least == nullptr || value(r) < value(*least)) least = &r;
  }
  if (least == nullptr) return;
  report.promise(
      what + ": " + fixed(promised, 0) + " times on every pair",
      "least " + ratio(value(*least), 1) + ", " + pair_of(*least) + "; geometric mean " + ratio(geometric_mean(all), 1),
      value(*least) >= promised);
}

void promise_ellipses(Report& report, const std::vector<MotionRow>& rows) {
  for (const MotionRow& r : rows) {
    if (pair_of(r) != "ellipse + ellipse") continue;
    const auto times = [&](const std::string& what, double other, double promised) {
      report.promise("ellipse + ellipse, update alone: " + fixed(promised, 0) + " times " + what,
                     ratio(other, r.update_us), other >= promised * r.update_us);
    };
    times("the plain brute force on whole faces", r.brute_merged_us, 250);
    times("the expert's, pair by pair", r.expert_pairs_us, 110);
    times("the static walk", r.static_us, 3);
    report.promise("ellipse + ellipse, finished solid: at most 0.5 ms a frame", us(r.update_solid_us.mean) + " us",
                   r.update_solid_us.mean <= 500);
  }
}

void promises(Report& report, const std::vector<MotionRow>& rows) {
  report.line("\n### Promises at 500 steps a turn\n");
  promise_ratio(report, rows, "finished solid, mean of all frames, against the static walk and its solid", 3,
                [](const MotionRow& r) { return r.static_solid_us.mean / r.update_solid_us.mean; });
  promise_ratio(report, rows, "finished solid, mean of all frames, against CGAL's hull", 20,
                [](const MotionRow& r) { return r.hull_us / r.update_solid_us.mean; });
  promise_ellipses(report, rows);
  std::size_t different = 0;
  for (const MotionRow& r : rows) different += r.different;
  report.promise("solids equal those of the static walk, volumes and combinatorics those of all others",
                 text(different) + " differ", different == 0);
}

}  // namespace

const char* const kMotionColumns =
    "kind,p,q,facets,update_us,brute_us,brute_merged_us,expert_pairs_us,expert_faces_us,static_us,update_solid_us,"
    "update_solid_median_us,update_solid_p99_us,update_solid_worst_us,static_solid_us,static_solid_median_us,"
    "static_solid_p99_us,static_solid_worst_us,fresh_solid_us,hull_us,different\n";

Models with_coordinates(Models models, Kind kind) {
  for (solids::NamedMesh& m : models) m.mesh = hull_with_coordinates(m.mesh, kind).value();
  return models;
}

const solids::NamedMesh& model(const Models& models, std::string_view name) {
  return *std::find_if(models.begin(), models.end(), [&](const solids::NamedMesh& m) { return m.name == name; });
}

void rotation_tables(Report& report, const Models& models, Kind kind, const WantedPair& wanted) {
  report.line("\n## Rotation, 500 steps a turn (tables 5.1 and 5.2)\n");
  report.line(
      "100 moves about random axes: the combinatorics alone. `brute` is the thesis's method on the triangles as they "
      "stand, `brute merged` on whole faces. `expert's` is brute force written for speed, in doubles without proofs: "
      "the furthest vertex by vectorised products, the arcs of an edge against 64 others at a time by sign bits; `by "
      "faces` it keeps the signs of each face for all its edges. All are built with the same flags. Facets are those "
      "of the finished solid.\n");
  heading(report);
  std::vector<MotionRow> rows;
  std::vector<double> gains;
  std::size_t below = 0, slow = 0;
  for (std::size_t j = 0; j < models.size(); ++j)
    for (std::size_t i = 0; i <= j; ++i) {
      if (!wanted(models[i], models[j])) continue;
      MotionProtocol protocol;
      protocol.hull_moves = models[i].mesh.vertices().size() * models[j].mesh.vertices().size() < 20000 ? 5 : 1;
      protocol.solids = true;
      protocol.expert = on_grid(kind);
      const MotionRow& row = rows.emplace_back(measure_rotation(models[i], models[j], 500, protocol));
      const double thesis = thesis_rotation(row.p, row.q);
      line(report, row, "rotation", thesis);
      gains.push_back(row.brute_us / row.update_us);
      below += thesis > 0 && gains.back() < thesis;
      slow += row.p_triangles + row.q_triangles > 300 && row.static_us < 3 * row.update_us;
    }
  if (rows.empty()) return;
  report.line("\nGeometric mean of brute / update: " + fixed(geometric_mean(gains), 0) + ", least " +
              fixed(quantile(gains, 0), 1) + ". Pairs below the thesis's value: " + text(below) +
              ". Pairs of more than 300 triangles less than 3 times faster than static: " + text(slow) + ".");
  report.line("\n### The same moves up to the finished solid\n");
  report.line(
      "Facets and all positions, each coordinate rounded once: `ConvexSum::set` and then `solid()`, or the static walk "
      "and the same arrays; `from meshes`: `ConvexSum::create`, which prepares both operands, `rebuild` and `sum()`; "
      "CGAL: "
      "`convex_hull_3` (EPICK) of all sums "
      "of two vertices. Every tenth solid is compared with that of the static walk, facet by facet, and once its "
      "volume with CGAL's.\n");
  solids_heading(report);
  for (const MotionRow& row : rows) solids_line(report, row);
  promises(report, rows);
}

void step_table(Report& report, const Models& models, Kind kind, const WantedPair& wanted, std::vector<Dot>& update,
                std::vector<Dot>& from_scratch) {
  report.line("\n## Size of the step (figure 5.5)\n");
  heading(report);
  const auto one = [&](const solids::NamedMesh& p, const solids::NamedMesh& q, int steps, bool plot) {
    if (!wanted(p, q)) return;
    MotionProtocol protocol;
    protocol.brute_moves = 1;
    protocol.expert = on_grid(kind);
    MotionRow row = measure_rotation(p, q, steps, protocol);
    if (plot) update.push_back({static_cast<double>(steps), row.update_us});
    if (plot) from_scratch.push_back({static_cast<double>(steps), row.static_us});
    row.p = text(static_cast<std::uint64_t>(steps)) + " steps: " + row.p;
    line(report, row, "steps");
  };
  for (const int steps : {10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 100000})
    one(model(models, "ellipse"), model(models, "ellipse"), steps, true);
  for (const solids::NamedMesh& p : models)
    for (const solids::NamedMesh& q : models)
      if (p.name < q.name && p.mesh.triangle_count() + q.mesh.triangle_count() > 300) one(p, q, 5000, false);
}

void cubes_table(Report& report, Kind kind, std::vector<Dot>& update, std::vector<Dot>& brute) {
  report.line("\n## Tessellated cubes (figure 5.6)\n");
  report.line(
      "Up to 200 triangles lie in each plane: we merge them, so the work does not grow; the brute force takes them as "
      "they stand.\n");
  heading(report);
  for (int k = 1; k <= 10; ++k) {
    const solids::NamedMesh cube{
        "cube", hull_with_coordinates(solids::tessellated_cube(10, k, solids::kDemoSnap), kind).value()};
    MotionProtocol protocol;
    protocol.brute_moves = 2;
    protocol.expert = on_grid(kind);
    const MotionRow row = measure_rotation(cube, cube, 500, protocol);
    line(report, row, "cubes");
    update.push_back({12.0 * k * k, row.update_us});
    brute.push_back({12.0 * k * k, row.brute_us});
  }
}

void scaling_table(Report& report, const Models& models, const WantedPair& wanted) {
  report.line("\n## Non-uniform scaling, 100 random factors (table 6.2)\n");
  heading(report);
  std::vector<double> gains, thesis;
  std::size_t below = 0;
  for (const char* p : {"ellipse", "GS3", "GS4", "TI", "v-rod"})
    for (const char* q : {"ellipse", "GS3", "GS4", "TI", "v-rod"}) {
      if (!wanted(model(models, p), model(models, q))) continue;
      const MotionRow row = measure_scaling(model(models, p), model(models, q), {});
      const double theirs = thesis_scaling(p, q);
      line(report, row, "scaling", theirs);
      gains.push_back(row.brute_us / row.update_us);
      thesis.push_back(theirs);
      below += gains.back() < theirs;
    }
  report.line("\nGeometric mean " + fixed(geometric_mean(gains), 0) + ", the thesis's " +
              fixed(geometric_mean(thesis), 1) + "; pairs below the thesis's value: " + text(below) + ".");
}

}  // namespace dymsum::bench
