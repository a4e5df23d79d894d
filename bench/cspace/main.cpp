// dymsum_bench_cspace: obstacles of all orientations against slices at 360 of them, by our static engine and by CGAL;
// tables 4.1 to 4.3 and figure 4.4 of the thesis.
#include <cstring>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "coordinate_kinds.h"
#include "cspace/figure.h"
#include "cspace/growth.h"
#include "cspace/kinds.h"
#include "cspace/questions.h"
#include "cspace/tables.h"
#include "planar/pairs.h"

namespace dymsum::bench {
namespace {

constexpr const char* kUsage =
    "dymsum_bench_cspace [--off-grid] [--coordinates KIND] [--only TEXT] [--part NAME] [--data DIR] [--results DIR]\n"
    "dymsum_bench_cspace --growth [--coordinates KIND] [--results DIR]\n"
    "  --growth       obstacles of ever larger polygons; with --results cspace-growth.md\n"
    "  --only TEXT    only pairs whose name contains TEXT\n"
    "  --part NAME    only one of: obstacles, slices, rotation, sizes, symmetric, questions, figure\n"
    "  --data DIR     the folder with planar/dog.poly and others (DYMSUM_DATA)\n"
    "  --results DIR  also write cspace.md, cspace.csv, figure-4.4.svg and figure-4.4-grates.svg into DIR\n";

struct Options {
  std::string only, part, data, results;
  bool growth = false;
  KindOptions coordinates;
  bool wants(const std::string& name) const { return part.empty() || part == name; }
  bool selects(const TurningPair& pair) const { return pair.name.find(only) != std::string::npos; }
};

void opening(Report& report, const std::string& data) {
  report.line("# Obstacles of all orientations\n");
  report.line(
      "`./run bench cspace --results docs/results` made this page. Times are processor time of all threads "
      "together unless they are called wall time. Values of the thesis, on its 2.13 GHz machine, are in "
      "brackets. P is the robot, which turns; Q the obstacle.");
  if (data.empty()) report.line("\nNo data folder (DYMSUM_DATA): generated shapes stand in for dog, bird and star.");
  report.csv.precision(12);
  report.csv << "kind,pair,measure,value\n";
}

std::vector<ObstacleRow> obstacle_table(Report& report, const Options& options, const std::vector<TurningPair>& pairs) {
  report.line("\n## Table 4.1\n");
  report.line(
      "N_s: contacts that exist at some angle. n_s: patches of the boundary, one ending where its neighbours "
      "change. n_b: shells. Stand-ins have the vertex counts of the thesis's chapter 3, not its shapes: its "
      "grates enclose many cavities, for which the last row stands. Slabs: up to 50 random ones per pair, "
      "their loops of contacts compared with the static engine's slice inside the slab.\n");
  obstacle_heading(report);
  std::vector<ObstacleRow> rows;
  for (const TurningPair& pair : pairs) {
    if (!options.selects(pair)) continue;
    rows.push_back(measure_obstacle(pair, 15, 3000));
    obstacle_line(report, rows.back());
  }
  return rows;
}

std::vector<SlicesRow> slices_table(Report& report, const std::vector<TurningPair>& pairs,
                                    const std::vector<ObstacleRow>& obstacles) {
  report.line("\n## Slices instead\n");
  report.line(
      "One slice a degree at the simplest rational orientation within 1e-6 radians, the same exact vertices "
      "for all. CGAL: reduced convolution with its exact kernel, operands made before the clock starts; "
      "scaled: 36 orientations ten degrees apart, times 10. An obstacle answers for all orientations, between "
      "the slices too: its slabs are the slices that would be needed to know as much. Answers compared: vertices, "
      "holes and area. Where they differ, CGAL's vertical decomposition is asked at the first three orientations of "
      "a pair.\n");
  slices_heading(report);
  std::vector<SlicesRow> rows;
  for (const TurningPair& pair : pairs)
    for (const ObstacleRow& obstacle : obstacles) {
      if (obstacle.name != pair.name) continue;
      rows.push_back(measure_slices(pair));
      slices_line(report, rows.back(), obstacle);
    }
  slices_remarks(report, rows);
  return rows;
}

void sizes_table(Report& report, const Options& options, const std::vector<TurningPair>& pairs) {
  report.line("\n## Table 4.2\n");
  report.line(
      "P (+) Q at the orientation of the files. The complete convolution turns the long way round at reflex "
      "vertices, as the thesis's does. Crossings are proper ones; the thesis's include common endpoints of "
      "segments (bar/circle has 36 of them and nothing else). Collinear vertices are dropped first.\n");
  sizes_heading(report);
  for (const TurningPair& pair : pairs)
    if (options.selects(pair))
      sizes_line(report, pair.name, count_convolutions(pair.robot, pair.obstacle), pair.thesis);
}

std::vector<ObstacleRow> symmetric_table(Report& report, const Options& options,
                                         const std::vector<TurningPair>& pairs) {
  report.line("\n## Symmetric and coincident inputs\n");
  report.line(
      "Many events at one angle and in one place: where the change near an event cannot be told from the "
      "segments that meet there, a whole slice behind the angle is computed.\n");
  symmetric_heading(report);
  std::vector<ObstacleRow> rows;
  for (const TurningPair& pair : pairs) {
    if (!options.selects(pair)) continue;
    rows.push_back(measure_obstacle(pair, 7, 300));
    symmetric_line(report, rows.back());
  }
  return rows;
}

void questions(Report& report, const std::vector<TurningPair>& pairs) {
  std::ostringstream tables;
  write_questions(pairs, tables);
  report.line("\n## Questions (table 4.3)\n");
  report.line(tables.str());
}

// All pairs at 500 steps a turn, and two at other steps.
std::vector<RotationRow> rotation_table(Report& report, const Options& options, const std::vector<TurningPair>& pairs) {
  report.line("\n## A sum that follows the robot\n");
  report.line(
      "O (+) -R(theta) R through a whole turn by `RotatingSum`, against `cspace_slice` at the same orientations. "
      "Frames that "
      "build a window and frames from scratch are among them; means hold what medians do not show. Undecided: frames "
      "at which "
      "something touches, or too nearly for doubles. Reading the clock is taken off both. Every frame is compared.\n");
  rotation_heading(report);
  std::vector<RotationRow> rows;
  const auto add = [&](const TurningPair& pair, int steps) {
    rows.push_back(measure_rotation(pair, steps));
    rotation_line(report, rows.back());
  };
  for (const TurningPair& pair : pairs)
    if (options.selects(pair)) add(pair, 500);
  for (const TurningPair& pair : pairs)
    if (options.selects(pair) && (pair.name == "star/star" || pair.name == "dog/bird"))
      for (const int steps : {50, 100, 200, 1000, 2000, 5000}) add(pair, steps);
  return rows;
}

void write_figures(const std::string& folder, const std::vector<TurningPair>& pairs) {
  for (const auto& [name, file] :
       {std::pair{"grate1/grate2", "figure-4.4.svg"}, {"crossing grates", "figure-4.4-grates.svg"}})
    for (const TurningPair& pair : pairs) {
      if (pair.name != name) continue;
      const CspaceObstacle obstacle = CspaceObstacle::create(pair.robot, pair.obstacle).value();
      write_result(folder, file, draw_obstacle(obstacle, pair.name + ": " + pair.shapes));
    }
}

Options parse(int argc, char** argv) {
  Options options;
  options.data = data_folder();
  for (int i = 1; i < argc; ++i) {
    const auto value = [&](const char* flag) -> const char* {
      return std::strcmp(argv[i], flag) == 0 && i + 1 < argc ? argv[++i] : nullptr;
    };
    if (const char* text = value("--only")) options.only = text;
    else if (const char* name = value("--part")) options.part = name;
    else if (const char* folder = value("--data")) options.data = folder;
    else if (const char* dir = value("--results")) options.results = dir;
    else if (std::strcmp(argv[i], "--growth") == 0) options.growth = true;
    else if (!options.coordinates.take(argc, argv, i)) throw std::invalid_argument(std::string(kUsage) + kKindUsage);
  }
  return options;
}

void measure_all(Report& report, const Options& options, const std::vector<TurningPair>& pairs,
                 const std::vector<TurningPair>& symmetric) {
  std::vector<ObstacleRow> obstacles;
  std::vector<SlicesRow> slices;
  std::vector<RotationRow> rotations;
  if (options.wants("obstacles") || options.wants("slices")) obstacles = obstacle_table(report, options, pairs);
  if (options.wants("slices")) slices = slices_table(report, pairs, obstacles);
  if (options.wants("rotation")) rotations = rotation_table(report, options, pairs);
  if (options.wants("sizes")) sizes_table(report, options, pairs);
  if (options.wants("symmetric"))
    for (ObstacleRow& row : symmetric_table(report, options, symmetric)) obstacles.push_back(std::move(row));
  if (options.wants("questions")) questions(report, pairs);
  if (obstacles.empty() && rotations.empty()) return;
  report.line("\n## Promises\n");
  promises(report, obstacles, slices, rotations);
  report.line("\n## Losses\n");
  losses(report, obstacles, slices);
}

void run_kind(const Options& options, Kind kind) {
  std::vector<std::string> notes;
  const std::vector<TurningPair> pairs = with_coordinates(turning_pairs(options.data), kind, notes),
                                 symmetric = with_coordinates(symmetric_pairs(), kind, notes);
  const std::string folder = KindOptions::folder(options.results, kind);
  Report report;
  opening(report, options.data);
  if (kind) report.line("\nCoordinates: " + name(*kind) + ".");
  for (const std::string& note : notes) report.line("\n" + note);
  measure_all(report, options, pairs, symmetric);
  if (folder.empty()) return;
  if (options.wants("figure")) {
    write_figures(folder, pairs);
    report.line(
        "\n## Figure 4.4\n\n![The obstacle of grate1/grate2](figure-4.4.svg)\n\n"
        "![The obstacle of the crossing grates](figure-4.4-grates.svg)");
  }
  write_result(folder, "cspace.md", report.markdown.str());
  write_result(folder, "cspace.csv", report.csv.str());
}

int run(int argc, char** argv) {
  const Options options = parse(argc, argv);
  if (!options.coordinates.off_grid)
    for (const Kind& kind : options.coordinates.kinds) {
      const std::string folder = KindOptions::folder(options.results, kind);
      if (options.growth && !folder.empty()) std::filesystem::create_directories(folder);
      if (!options.growth) run_kind(options, kind);
      else if (!measure_obstacle_growth(kind, folder, std::cout)) return 1;
    }
  const bool all = !options.growth && options.only.empty() && options.part.empty() && !options.coordinates.chosen();
  return !(options.coordinates.off_grid || all) || measure_kinds(options.results) ? 0 : 3;
}

}  // namespace
}  // namespace dymsum::bench

int main(int argc, char** argv) { return dymsum::bench::guarded(dymsum::bench::run, argc, argv); }
