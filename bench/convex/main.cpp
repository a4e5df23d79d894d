// dymsum_bench_convex: convex solids that turn and scale, against the thesis's brute force, our static walk, CGAL's
// hull of vertex sums, FCL and libccd.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "convex/criticality.h"
#include "convex/measure.h"
#include "convex/thesis.h"
#include "page.h"
#include "scaling/scatter.h"

namespace dymsum::bench {
namespace {

constexpr const char* kUsage =
    "dymsum_bench_convex [--only TEXT] [--part NAME] [--results DIR]\n"
    "  --only TEXT    only pairs whose name (\"ellipse + GS3\") contains TEXT\n"
    "  --part NAME    only one of: rotation, steps, cubes, scaling, depth, nef, criticality\n"
    "  --results DIR  also write convex.md, convex.csv and the figures into DIR\n";

struct Options {
  std::string only, part, results;
  bool wants(const std::string& name) const { return part.empty() || part == name; }
};

using bench::fixed;
using bench::ratio;
std::string fixed(double v) { return fixed(v, 2); }
std::string ratio(double a, double b) { return ratio(a, b, 1); }
std::string thesis_value(double v) { return v > 0 ? fixed(v) : "-"; }

double geometric_mean(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += std::log(x);
  return v.empty() ? 0 : std::exp(sum / static_cast<double>(v.size()));
}

void heading(Report& report) {
  report.line(
      "| pair | triangles | facets | update us | faces, crossings checked, arcs mended | changed | brute us | / update "
      "| thesis | brute merged us | / update | static us | / update | CGAL hull us | / update | exact signs | "
      "compared, different |");
  report.line("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
}

void line(Report& report, const MotionRow& r, const std::string& kind, double thesis) {
  const auto per_move = [&](std::uint64_t v) {
    return fixed(static_cast<double>(v) / static_cast<double>(r.moves), 1);
  };
  report.line("| " + r.p + " + " + r.q + " | " + std::to_string(r.p_triangles) + ", " + std::to_string(r.q_triangles) +
              " | " + std::to_string(r.facets) + " | " + fixed(r.update_us) + " | " + per_move(r.work.vertex_checks) +
              ", " + per_move(r.work.crossing_checks) + ", " + per_move(r.work.arc_checks) + " | " +
              per_move(r.work.facets_added) + " | " + fixed(r.brute_us, 1) + " | **" + ratio(r.brute_us, r.update_us) +
              "** | " + thesis_value(thesis) + " | " + fixed(r.brute_merged_us, 1) + " | " +
              ratio(r.brute_merged_us, r.update_us) + " | " + fixed(r.static_us, 1) + " | " +
              ratio(r.static_us, r.update_us) + " | " + (r.hull_us > 0 ? fixed(r.hull_us, 0) : "-") + " | " +
              ratio(r.hull_us, r.update_us) + " | " + per_move(r.work.exact_signs) + " | " +
              std::to_string(r.compared) + ", " + std::to_string(r.different) + " |");
  report.csv << kind << "," << r.p << "," << r.q << "," << r.facets << "," << r.update_us << "," << r.brute_us << ","
             << r.brute_merged_us << "," << r.static_us << "," << r.hull_us << "," << r.different << "\n";
}

const solids::NamedMesh& model(const std::vector<solids::NamedMesh>& models, std::string_view name) {
  return *std::find_if(models.begin(), models.end(), [&](const solids::NamedMesh& m) { return m.name == name; });
}

bool selected(const Options& options, const solids::NamedMesh& p, const solids::NamedMesh& q) {
  return (std::string(p.name) + " + " + std::string(q.name)).find(options.only) != std::string::npos;
}

/// Tables 5.1 and 5.2.
void rotations(const Options& options, const std::vector<solids::NamedMesh>& models, Report& report) {
  report.line("\n## Rotation, 500 steps a turn (tables 5.1 and 5.2)\n");
  report.line(
      "100 moves about random axes. `brute` is the thesis's method on the triangles as they stand, `brute merged` on "
      "whole faces.\n");
  heading(report);
  std::vector<double> gains;
  std::size_t below = 0, different = 0, slow = 0;
  for (std::size_t j = 0; j < models.size(); ++j)
    for (std::size_t i = 0; i <= j; ++i) {
      if (!selected(options, models[i], models[j])) continue;
      const bool large = models[i].mesh.triangle_count() + models[j].mesh.triangle_count() > 300;
      MotionProtocol protocol;
      protocol.hull_moves = 1;
      const MotionRow row = measure_rotation(models[i], models[j], 500, protocol);
      const double thesis = thesis_rotation(row.p, row.q);
      line(report, row, "rotation", thesis);
      gains.push_back(row.brute_us / row.update_us);
      below += thesis > 0 && gains.back() < thesis;
      different += row.different;
      slow += large && row.static_us < 3 * row.update_us;
    }
  if (gains.empty()) return;
  report.line("\nGeometric mean of brute / update: " + fixed(geometric_mean(gains), 0) + ", least " +
              fixed(*std::min_element(gains.begin(), gains.end()), 1) +
              ". Pairs below the thesis's value: " + std::to_string(below) +
              ". Pairs of more than 300 triangles less than 3 times faster than static: " + std::to_string(slow) +
              ". Answers that differ: " + std::to_string(different) + ".");
}

/// Figure 5.5, and the promise at 5,000 steps.
void step_sizes(const Options& options, const std::vector<solids::NamedMesh>& models, Report& report,
                std::vector<Dot>& dots, std::vector<Dot>& static_dots) {
  report.line("\n## Size of the step (figure 5.5)\n");
  heading(report);
  const auto one = [&](const solids::NamedMesh& p, const solids::NamedMesh& q, int steps, bool plot) {
    if (!selected(options, p, q)) return;
    MotionProtocol protocol;
    protocol.brute_moves = 1;
    MotionRow row = measure_rotation(p, q, steps, protocol);
    if (plot) dots.push_back({static_cast<double>(steps), row.update_us});
    if (plot) static_dots.push_back({static_cast<double>(steps), row.static_us});
    row.p = std::to_string(steps) + " steps: " + row.p;
    line(report, row, "steps", 0);
  };
  for (const int steps : {10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000, 100000})
    one(model(models, "ellipse"), model(models, "ellipse"), steps, true);
  for (const solids::NamedMesh& p : models)
    for (const solids::NamedMesh& q : models)
      if (p.name <= q.name && p.name != q.name && p.mesh.triangle_count() + q.mesh.triangle_count() > 300)
        one(p, q, 5000, false);
}

/// Figure 5.6.
void cubes(Report& report, std::vector<Dot>& update, std::vector<Dot>& brute) {
  report.line("\n## Tessellated cubes (figure 5.6)\n");
  report.line(
      "Up to 200 triangles lie in each plane: we merge them, so the work does not grow; the brute force takes them as "
      "they stand.\n");
  heading(report);
  for (int k = 1; k <= 10; ++k) {
    const solids::NamedMesh cube{"cube", solids::tessellated_cube(10, k)};
    MotionProtocol protocol;
    protocol.brute_moves = 2;
    const MotionRow row = measure_rotation(cube, cube, 500, protocol);
    line(report, row, "cubes", 0);
    update.push_back({12.0 * k * k, row.update_us});
    brute.push_back({12.0 * k * k, row.brute_us});
  }
}

/// Table 6.2.
void scalings(const Options& options, const std::vector<solids::NamedMesh>& models, Report& report) {
  report.line("\n## Non-uniform scaling, 100 random factors (table 6.2)\n");
  heading(report);
  std::vector<double> gains, thesis;
  std::size_t below = 0;
  for (const char* p : {"ellipse", "GS3", "GS4", "TI", "v-rod"})
    for (const char* q : {"ellipse", "GS3", "GS4", "TI", "v-rod"}) {
      if (!selected(options, model(models, p), model(models, q))) continue;
      const MotionRow row = measure_scaling(model(models, p), model(models, q), {});
      const double theirs = thesis_scaling(p, q);
      line(report, row, "scaling", theirs);
      gains.push_back(row.brute_us / row.update_us);
      thesis.push_back(theirs);
      below += gains.back() < theirs;
    }
  report.line("\nGeometric mean " + fixed(geometric_mean(gains), 0) + ", the thesis's " +
              fixed(geometric_mean(thesis), 1) + "; pairs below the thesis's value: " + std::to_string(below) + ".");
}

void depths(const Options& options, const std::vector<solids::NamedMesh>& models, Report& report) {
  report.line("\n## Penetration depth\n");
  report.line(
      "P turns by 2 pi / 500 a query, Q is somewhere inside. Ours is exact; the others are compared with it, errors "
      "relative to P's width.\n");
  report.line("| pair | system | us a query | queries | wrong by more than 1e-6 | largest error |");
  report.line("|---|---|---|---|---|---|");
  for (const auto& [p, q] :
       {std::pair{"cube", "T"}, {"T", "TI"}, {"GS3", "v-rod"}, {"ellipse", "GS4"}, {"ellipse", "ellipse"}}) {
    if (!selected(options, model(models, p), model(models, q))) continue;
    for (const DepthRow& r : measure_depth(model(models, p), model(models, q), 200)) {
      std::ostringstream worst;
      worst << r.worst;
      report.line("| " + r.p + " + " + r.q + " | " + r.system + " | " + fixed(r.us, 1) + " | " +
                  std::to_string(r.queries) + " | " + std::to_string(r.wrong) + " | " + worst.str() + " |");
    }
  }
}

/// CGAL's Nef polyhedra as a witness.
void nefs(const Options& options, const std::vector<solids::NamedMesh>& models, Report& report) {
  report.line("\n## Beside CGAL's Nef polyhedra\n");
  report.line(
      "One sum from nothing, exact on both sides; P as it stands, and turned (then CGAL gets rounded coordinates).\n");
  report.line("| pair | turned | ours ms | Nef ms | / ours | vertices, Nef's | same |");
  report.line("|---|---|---|---|---|---|---|");
  for (const auto& [p, q] : {std::pair{"cube", "cube"}, {"HP", "cube"}, {"HP", "HP"}, {"DD", "HP"}, {"cube", "T"}})
    for (const Rotation& turn : {Rotation(), *Rotation::about({1, 2, 3}, 1)}) {
      if (!selected(options, model(models, p), model(models, q))) continue;
      const NefRow r = measure_nef(model(models, p), model(models, q), turn);
      report.line("| " + r.p + " + " + r.q + " | " + (turn == Rotation() ? "no" : "yes") + " | " + fixed(r.ours_ms, 3) +
                  " | " + fixed(r.nef_ms, 0) + " | " + ratio(r.nef_ms, r.ours_ms) + " | " + std::to_string(r.vertices) +
                  ", " + std::to_string(r.nef_vertices) + " | " + (r.same ? "yes" : "NO") + " |");
    }
}

/// Mayer's criticality map (thesis 2.7).
void criticality(const Options& options, const std::vector<solids::NamedMesh>& models, Report& report) {
  report.line("\n## Criticality map of a full turn about (1, 2, 3)\n");
  report.line(
      "P turns, Q stands still. Memory in kB: of the map (critical angles, structures stored whole now and then, "
      "differences, operands), of the same with every structure "
      "stored whole, and of one ConvexSum. Structure: finding the interval and reading its structure, against an "
      "update at 500 steps a turn; sum: to the exact solid with its "
      "positions, likewise.\n");
  report.line(
      "| pair | triangles | meetings | critical angles | exact pairs, orders | map kB | all whole kB | ConvexSum kB | "
      "map / ConvexSum | build ms | structure us | update us | sum us | "
      "update + sum us | compared, different |");
  report.line("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
  for (const auto& [p, q] : {std::pair{"cube", "cube"},
                             {"HP", "T"},
                             {"T", "T"},
                             {"cone", "GS1"},
                             {"TI", "T"},
                             {"GS2", "TI"},
                             {"GS3", "v-rod"},
                             {"ellipse", "GS3"},
                             {"ellipse", "ellipse"}}) {
    if (!selected(options, model(models, p), model(models, q))) continue;
    const CriticalityRow r = measure_criticality(model(models, p), model(models, q), {1, 2, 3});
    const auto kb = [](std::size_t bytes) { return fixed(static_cast<double>(bytes) / 1e3, 0); };
    const CriticalityStats& s = r.stats;
    report.line("| " + r.p + " + " + r.q + " | " + std::to_string(r.p_triangles) + ", " +
                std::to_string(r.q_triangles) + " | " + std::to_string(s.meetings) + " | " + std::to_string(r.angles) +
                " | " + std::to_string(s.exact_pairs) + ", " + std::to_string(s.exact_orders) + " | " +
                kb(r.map_bytes) + " | " + kb(r.map_bytes - s.key_bytes - s.difference_bytes + s.full_bytes) + " | " +
                kb(r.sum_bytes) + " | " + ratio(static_cast<double>(r.map_bytes), static_cast<double>(r.sum_bytes)) +
                " | " + fixed(r.build_ms, 0) + " | " + fixed(r.structure_us, 1) + " | " + fixed(r.update_us, 1) +
                " | " + fixed(r.map_sum_us, 0) + " | " + fixed(r.update_sum_us, 0) + " | " +
                std::to_string(r.compared) + ", " + std::to_string(r.different) + " |");
  }
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const auto value = [&](const char* flag) -> const char* {
      return std::strcmp(argv[i], flag) == 0 && i + 1 < argc ? argv[++i] : nullptr;
    };
    if (const char* text = value("--only")) options.only = text;
    else if (const char* name = value("--part")) options.part = name;
    else if (const char* dir = value("--results")) options.results = dir;
    else throw std::invalid_argument(kUsage);
  }
  return options;
}

int run(int argc, char** argv) {
  const Options options = parse(argc, argv);
  const std::vector<solids::NamedMesh> models = solids::thesis_models();
  Report report;
  report.line("# Convex solids in motion\n");
  report.line(
      "`./run bench convex --results docs/results` made this page. Times are means of processor time per move, one "
      "thread.");
  std::vector<Dot> step_dots, static_dots, update_dots, brute_dots;
  if (options.wants("rotation")) rotations(options, models, report);
  if (options.wants("steps")) step_sizes(options, models, report, step_dots, static_dots);
  if (options.wants("cubes")) cubes(report, update_dots, brute_dots);
  if (options.wants("scaling")) scalings(options, models, report);
  if (options.wants("depth")) depths(options, models, report);
  if (options.wants("nef")) nefs(options, models, report);
  if (options.wants("criticality")) criticality(options, models, report);
  const auto write = [&](const std::string& name, const std::string& text) {
    write_result(options.results, name, text);
  };
  write("convex.md", report.markdown.str());
  write("convex.csv",
        "kind,p,q,facets,update_us,brute_us,brute_merged_us,static_us,hull_us,different\n" + report.csv.str());
  if (!step_dots.empty())
    write("figure-5.5.svg",
          draw_scatter("One update (left), the static walk at the same poses (right), ellipse + ellipse",
                       "steps a turn", "microseconds", step_dots, "steps a turn", static_dots));
  if (!update_dots.empty())
    write("figure-5.6.svg", draw_scatter("Tessellated cubes: update (left), brute force (right)", "triangles",
                                         "microseconds", update_dots, "triangles", brute_dots));
  return 0;
}

}  // namespace
}  // namespace dymsum::bench

int main(int argc, char** argv) { return dymsum::bench::guarded(dymsum::bench::run, argc, argv); }
