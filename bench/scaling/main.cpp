// dymsum_bench_scaling: planar sums that scale and turn against our static engine, the thesis's baseline and CGAL;
// whole sweeps as users wait for them, and frames one by one.
#include <stdexcept>

#include "coordinate_kinds.h"
#include "page.h"
#include "planar/pairs.h"
#include "scaling/frame_tables.h"
#include "scaling/kinds.h"
#include "scaling/sweep_tables.h"

namespace dymsum::bench {
namespace {

constexpr const char* kUsage =
    "dymsum_bench_scaling [--quick | --off-grid] [--coordinates KIND] [--only TEXT] [--part NAME] [--results DIR]\n"
    "  --quick        without CGAL and the all-pairs baseline\n"
    "  --only TEXT    only pairs whose name contains TEXT\n"
    "  --part NAME    only one of: sweeps, turning, steady, modes, random, copies, events, figures\n"
    "  --results DIR  also write scaling.md, scaling.csv, sweeps.csv, figure-6.6.svg and figure-6.7.svg into DIR\n"
    "With --coordinates sweeps, turning and events only: the others compare with systems that get scaled points in\n"
    "doubles, which hold the products of snapped coordinates alone.\n";

struct Options {
  bool quick = false;
  std::string only, part, results;
  KindOptions coordinates;
  bool wants(const std::string& name) const { return part.empty() || part == name; }
};

void opening(Report& report, const std::string& data) {
  report.line(
      "# Sums that scale and turn\n\nWritten by `./run bench scaling --results docs/results`. Processor times in "
      "milliseconds of one thread, unless two are named; reading the clock is taken off all of them.");
  if (data.empty()) report.line("\nNo data folder (DYMSUM_DATA): the thesis's polygons are left out.");
}

/// Whole sweeps; all of them, for sweeps.csv.
std::vector<SweepRow> sweeps(Report& report, const Options& options, const std::string& data, Kind kind,
                             const Wanted& wanted) {
  if (!options.wants("sweeps") && !options.wants("turning")) return {};
  report.line(
      "\n## Whole sweeps\n\nEverything that a user waits for: the first frame makes the sum, others build windows or "
      "start from scratch. Raw coordinates are those of the files and generators; snapped ones are integers of 22 "
      "bits. "
      "P moves. There: each frame the median of three rounds; then the same way back with the same sum. Factors are "
      "static / frame: of means (bold), and of medians. p99 and worst are frames in static sums at the same place. "
      "With "
      "two threads all frames of three rounds count, there and back, by the clock on the wall. Static: the sum from "
      "scratch at every one of the places, exactly, operands having been summed before; `from points`: both regions "
      "made, with all checks, and summed once; `rounded`: these once more. The scaled points of the last two are "
      "rounded to doubles, which is another set. Turned ones are exact. Frames are compared with static sums outside "
      "of "
      "the clock.");
  std::vector<SweepRow> scaling, turning;
  if (options.wants("sweeps")) scaling = scaling_sweeps(report, data, kind, wanted);
  if (options.wants("turning")) turning = turning_sweeps(report, data, kind, wanted);
  report.line("\n### Promises\n");
  sweep_promises(report, scaling, turning);
  scaling.insert(scaling.end(), turning.begin(), turning.end());
  return scaling;
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--quick") options.quick = true;
    else if (word == "--only" && i + 1 < argc) options.only = argv[++i];
    else if (word == "--part" && i + 1 < argc) options.part = argv[++i];
    else if (word == "--results" && i + 1 < argc) options.results = argv[++i];
    else if (!options.coordinates.take(argc, argv, i)) throw std::invalid_argument(std::string(kUsage) + kKindUsage);
  }
  return options;
}

void run_kind(const Options& options, Kind kind) {
  Report report;
  const std::string data = data_folder(), folder = KindOptions::folder(options.results, kind);
  const Wanted wanted = [&](const ScalingPair& pair) { return pair.name.find(options.only) != std::string::npos; };
  opening(report, data);
  std::vector<std::string> notes;
  const std::vector<ScalingPair> pairs = with_coordinates(frame_pairs(data), kind, notes);
  if (kind) report.line("\nCoordinates: " + name(*kind) + ".");
  for (const std::string& note : notes) report.line("\n" + note);
  const auto on_grid = [&](const char* part) { return !kind && options.wants(part); };
  const std::vector<SweepRow> swept = sweeps(report, options, data, kind, wanted);
  if (on_grid("steady")) steady_table(report, pairs, wanted, !options.quick);
  if (on_grid("modes")) modes_table(report, pairs, wanted);
  if (on_grid("random")) table_6_1(report, wanted);
  if (on_grid("copies")) copies_table(report, pairs, wanted, !options.quick);
  if (options.wants("events")) pair_events_table(report, pairs, wanted);
  if (folder.empty()) return;
  if (on_grid("figures")) figures(report, pairs, wanted, folder);
  if (on_grid("steady")) write_result(folder, "scaling.csv", report.csv.str());
  if (!swept.empty()) write_result(folder, "sweeps.csv", sweep_csv(swept));
  write_result(folder, "scaling.md", report.markdown.str());
}

int run(int argc, char** argv) {
  const Options options = parse(argc, argv);
  if (!options.coordinates.off_grid)
    for (const Kind& kind : options.coordinates.kinds) run_kind(options, kind);
  const bool all = options.only.empty() && options.part.empty() && !options.quick && !options.coordinates.chosen();
  return !(options.coordinates.off_grid || all) || measure_kinds(options.results) ? 0 : 3;
}

}  // namespace
}  // namespace dymsum::bench

int main(int argc, char** argv) { return dymsum::bench::guarded(dymsum::bench::run, argc, argv); }
