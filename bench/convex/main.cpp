// dymsum_bench_convex: convex solids that turn and scale, against brute force, our static walk, CGAL's hull of vertex
// sums, FCL, libccd and Coal.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "convex/criticality.h"
#include "convex/depth.h"
#include "convex/kinds.h"
#include "convex/measure.h"
#include "convex/motion_tables.h"
#include "page.h"
#include "python.h"
#include "scaling/scatter.h"

namespace dymsum::bench {
namespace {

constexpr const char* kUsage =
    "dymsum_bench_convex [--off-grid] [--coordinates KIND] [--only TEXT] [--part NAME] [--results DIR]\n"
    "  --only TEXT    only pairs whose name (\"ellipse + GS3\") contains TEXT\n"
    "  --part NAME    only one of: rotation, axes, steps, cubes, growth, scaling, depth,\n"
    "                 nef, criticality\n"
    "  --results DIR  also write convex.md, convex.csv and the figures into DIR\n"
    "Environment: DYMSUM_PYTHON, an interpreter that has coal (`./run bench convex` makes one).\n";

struct Options {
  std::string only, part, results;
  KindOptions coordinates;
  bool wants(const std::string& name) const { return part.empty() || part == name; }
};

using bench::fixed;
using bench::ratio;
std::string ratio(double a, double b) { return ratio(a, b, 1); }

bool selected(const Options& options, const solids::NamedMesh& p, const solids::NamedMesh& q) {
  return (std::string(p.name) + " + " + std::string(q.name)).find(options.only) != std::string::npos;
}

void depths(const Options& options, const std::vector<solids::NamedMesh>& models, Report& report) {
  report.line("\n## Penetration depth\n");
  report.line(
      "P turns by 2 pi / 500 a query, Q is somewhere inside. Ours is exact; the others are compared with it, errors "
      "relative to P's width. Coal is reached through Python; its time is what it measures itself inside of its calls, "
      "without Python's, the least of three rounds.\n");
  if (!has_python()) report.line("Coal is left out: DYMSUM_PYTHON names no interpreter.\n");
  report.heading({"pair", "system", "us a query", "queries", "wrong by more than 1e-6", "largest error"});
  for (const auto& [p, q] :
       {std::pair{"cube", "T"}, {"T", "TI"}, {"GS3", "v-rod"}, {"ellipse", "GS4"}, {"ellipse", "ellipse"}}) {
    if (!selected(options, model(models, p), model(models, q))) continue;
    for (const DepthRow& r : measure_depth(model(models, p), model(models, q), 200)) {
      std::ostringstream worst;
      worst << r.worst;
      report.row({r.p + " + " + r.q, r.system, r.us > 0 ? fixed(r.us, 1) : "no answer", std::to_string(r.queries),
                  std::to_string(r.wrong), worst.str()});
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
    else if (!options.coordinates.take(argc, argv, i)) throw std::invalid_argument(std::string(kUsage) + kKindUsage);
  }
  return options;
}

void run_kind(const Options& options, Kind kind) {
  const Models models = with_coordinates(solids::thesis_models(), kind);
  Report report;
  report.line("# Convex solids in motion\n");
  report.line(
      "`./run bench convex --results docs/results` made this page. Times are means of processor time per move, one "
      "thread.");
  if (kind) report.line("\nCoordinates: " + name(*kind) + "; every solid is the hull of its rounded vertices.");
  std::vector<Dot> step_dots, static_dots, update_dots, brute_dots;
  const WantedPair wanted = [&](const solids::NamedMesh& p, const solids::NamedMesh& q) {
    return selected(options, p, q);
  };
  if (options.wants("rotation")) rotation_tables(report, models, kind, wanted);
  if (options.wants("axes")) shared_axis_table(report, kind, wanted);
  if (options.wants("steps")) step_table(report, models, kind, wanted, step_dots, static_dots);
  if (options.wants("cubes")) cubes_table(report, kind, update_dots, brute_dots);
  if (options.wants("growth")) growth_table(report, kind, wanted);
  if (options.wants("scaling")) scaling_table(report, models, wanted);
  if (options.wants("depth")) depths(options, models, report);
  if (options.wants("nef")) nefs(options, models, report);
  if (options.wants("criticality")) criticality(options, models, report);
  const auto write = [&](const std::string& name, const std::string& text) {
    write_result(KindOptions::folder(options.results, kind), name, text);
  };
  write("convex.md", report.markdown.str());
  write("convex.csv", kMotionColumns + report.csv.str());
  if (!step_dots.empty())
    write("figure-5.5.svg",
          draw_scatter("One update (left), the static walk at the same poses (right), ellipse + ellipse",
                       "steps a turn", "microseconds", step_dots, "steps a turn", static_dots));
  if (!update_dots.empty())
    write("figure-5.6.svg", draw_scatter("Tessellated cubes: update (left), brute force (right)", "triangles",
                                         "microseconds", update_dots, "triangles", brute_dots));
}

int run(int argc, char** argv) {
  const Options options = parse(argc, argv);
  if (!options.coordinates.off_grid)
    for (const Kind& kind : options.coordinates.kinds) run_kind(options, kind);
  const bool all = options.only.empty() && options.part.empty() && !options.coordinates.chosen();
  return !(options.coordinates.off_grid || all) || measure_kinds(options.results) ? 0 : 3;
}

}  // namespace
}  // namespace dymsum::bench

int main(int argc, char** argv) { return dymsum::bench::guarded(dymsum::bench::run, argc, argv); }
