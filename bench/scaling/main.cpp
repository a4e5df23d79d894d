// dymsum_bench_scaling: planar sums that scale and turn against our static engine, the thesis's baseline and CGAL;
// whole sweeps as users wait for them, and frames one by one.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "page.h"
#include "planar/pairs.h"
#include "scaling/copies.h"
#include "scaling/measure.h"
#include "scaling/scatter.h"
#include "scaling/sweep_tables.h"

namespace dymsum::bench {
namespace {

constexpr const char* kUsage =
    "dymsum_bench_scaling [--quick] [--only TEXT] [--part NAME] [--results DIR]\n"
    "  --quick        without CGAL and the all-pairs baseline\n"
    "  --only TEXT    only pairs whose name contains TEXT\n"
    "  --part NAME    only one of: sweeps, turning, steady, modes, random, copies, events, figures\n"
    "  --results DIR  also write scaling.md, scaling.csv, sweeps.csv, figure-6.6.svg and figure-6.7.svg into DIR\n";

struct Options {
  bool quick = false;
  std::string only, part, results;
  bool wants(const std::string& name) const { return part.empty() || part == name; }
};

using bench::fixed;
using bench::ratio;
std::string fixed(double v) { return fixed(v, 3); }
std::string ratio(double a, double b) { return ratio(a, b, 2); }

void frames_heading(Report& report) {
  report.line(
      "| pair | steps | segments | vertices | corners kept | static ms | frame ms (median) | static / frame | (means) "
      "| in window ms | building ms | windows, from scratch, touching | all pairs ms | / frame | CGAL ms | / frame | "
      "compared; differs from static, from CGAL |");
  report.line("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
}

void frames_line(Report& report, const FramesRow& r) {
  report.line(
      "| " + r.name + " | " + r.steps + " | " + std::to_string(r.segments) + " | " + std::to_string(r.vertices) +
      " | " + fixed(100 * r.kept, 1) + " % | " + fixed(r.static_ms) + " | " + fixed(r.frame_ms, 4) + " | **" +
      ratio(r.static_ms, r.frame_ms) + "** | " + ratio(r.static_mean_ms, r.frame_mean_ms) + " | " +
      fixed(r.update_ms, 4) + " | " + fixed(r.window_ms) + " | " + std::to_string(r.windows) + ", " +
      std::to_string(r.rebuilt) + ", " + std::to_string(r.degenerate) + " of " + std::to_string(r.frames) + " | " +
      (r.all_pairs_ms > 0 ? fixed(r.all_pairs_ms, 1) : "-") + " | " + ratio(r.all_pairs_ms, r.frame_ms) + " | " +
      (r.cgal_ms > 0 ? fixed(r.cgal_ms, 1) : "-") + " | " + ratio(r.cgal_ms, r.frame_ms) + " | " +
      std::to_string(r.compared) + "; " + std::to_string(r.different) + ", " + std::to_string(r.cgal_different) + " |");
  for (const FrameSample& f : r.samples)
    report.csv << r.name << "," << r.steps << "," << f.s << "," << f.ms << "," << f.static_ms << "," << f.events << ","
               << f.crossings << "," << f.rebuilt << "," << f.new_window << "\n";
}

bool wanted(const Options& options, const std::string& name) { return name.find(options.only) != std::string::npos; }

std::string figure(const FramesRow& row, const std::string& title) {
  std::vector<Dot> events, crossings;
  for (const FrameSample& f : row.samples) {
    events.push_back({static_cast<double>(f.events), f.static_ms / f.ms});
    crossings.push_back({static_cast<double>(f.crossings), f.static_ms / f.ms});
  }
  return draw_scatter(title, "crossings that came or went", "speed-up over our static engine", events,
                      "crossings of the frame", crossings);
}

/// Figure 6.11: an environment of twelve copies of one obstacle, with a robot.
void copies_table(Report& report, const Options& options, const std::vector<ScalingPair>& pairs) {
  if (!options.wants("copies")) return;
  std::vector<ScalingPair> environments;
  const std::vector<ScalingPair> table = table_pairs();
  for (const char* name : {"G1 + G4", "dog + G2", "neuron + disc 32", "monkey + bird", "star 200 + star 200"})
    for (const auto* list : {&table, &pairs})
      for (const ScalingPair& pair : *list)
        if (pair.name == name && wanted(options, pair.name)) environments.push_back(pair);
  if (environments.empty()) return;
  report.line(
      "\n## Many copies\n\nFigure 6.11: twelve scaled copies of one obstacle P and a robot Q; all twelve sums s P + "
      "(-Q), by `scaled_copies`, by our static engine "
      "on each copy, and by the thesis's baseline (all pairs, from scratch) on each copy. The thesis has 96.8 ms "
      "against 2.5 ms, without its events.\n");
  report.line(
      "| obstacle + robot | sizes | distinct | segments | vertices of all | copies ms | static ms | static / copies | "
      "all pairs ms | all pairs / copies | windows, from scratch | "
      "compared; different |\n|---|---|---|---|---|---|---|---|---|---|---|---|");
  for (const ScalingPair& pair : environments)
    for (const CopiesPlan& plan : twelve_copies()) {
      const CopiesRow r = measure_copies(pair, plan, 9, !options.quick);
      report.line("| " + r.name + " | " + r.sizes + " | " + std::to_string(r.distinct) + " | " +
                  std::to_string(r.segments) + " | " + std::to_string(r.vertices) + " | " + fixed(r.copies_ms) + " | " +
                  fixed(r.static_ms) + " | **" + ratio(r.static_ms, r.copies_ms) + "** | " +
                  (r.all_pairs_ms > 0 ? fixed(r.all_pairs_ms, 1) : "-") + " | " + ratio(r.all_pairs_ms, r.copies_ms) +
                  " | " + std::to_string(r.windows) + ", " + std::to_string(r.rebuilt) + " | " +
                  std::to_string(r.compared) + "; " + std::to_string(r.different) + " |");
    }
}

void opening(Report& report, const std::string& data) {
  report.csv << "pair,steps,s,frame_ms,static_ms,events,crossings,rebuilt,new_window\n";
  report.line(
      "# Sums that scale and turn\n\nWritten by `./run bench scaling --results docs/results`. Processor times in "
      "milliseconds of one thread, unless two are named; reading the clock is taken off all of them.");
  if (data.empty()) report.line("\nNo data folder (DYMSUM_DATA): the thesis's polygons are left out.");
}

/// Whole sweeps; all of them, for sweeps.csv.
std::vector<SweepRow> sweeps(Report& report, const Options& options, const std::string& data) {
  if (!options.wants("sweeps") && !options.wants("turning")) return {};
  const Wanted pairs = [&](const ScalingPair& pair) { return wanted(options, pair.name); };
  report.line(
      "\n## Whole sweeps\n\nEverything that a user waits for: the first frame makes the sum, others build windows or "
      "start from scratch. Raw coordinates are those of the files and generators; snapped ones are integers of 22 "
      "bits. "
      "P moves. There: each frame the median of three rounds; then the same way back with the same sum. Factors are "
      "static / frame: of means (bold), and of medians. p99 and worst are frames, in mean static sums. With two "
      "threads they are of all frames of three rounds, there and back, by the clock on the wall. Static: at some of "
      "the very places, exactly, operands having been summed before; `from points`: both regions made, with all "
      "checks, and summed once; `rounded`: these once more. The scaled points of the last two are rounded to doubles, "
      "which is another set. Turned ones are exact. Frames are compared with static sums outside of the clock.");
  std::vector<SweepRow> scaling, turning;
  if (options.wants("sweeps")) scaling = scaling_sweeps(report, data, pairs);
  if (options.wants("turning")) turning = turning_sweeps(report, data, pairs);
  report.line("\n### Promises\n");
  sweep_promises(report, scaling, turning);
  scaling.insert(scaling.end(), turning.begin(), turning.end());
  return scaling;
}

/// Frames at steady steps; the rows of 1 %.
std::vector<FramesRow> steady_table(Report& report, const Options& options, const std::vector<ScalingPair>& pairs) {
  if (!options.wants("steady")) return {};
  report.line(
      "\n## Steady steps, snapped\n\nEvery frame compared exactly with our static engine. Inputs are snapped to 22-bit "
      "integers and scales to 14 fractional bits, so that s P is the same set for everyone. "
      "Static: `minkowski_sum` from `Region` to `PlanarSum`. Each sweeps on its own for the times, three times by "
      "turns, and the median of each frame counts; a last sweep compares. All pairs: the reference engine `brute`, "
      "which intersects all pairs of segments from scratch as the thesis "
      "does. CGAL 5.5: reduced convolution with EPECK. Both on three frames of a row; CGAL's reduced convolution loses "
      "holes in known cases (see planar.md, and the end of "
      "docs/design/scaling-sum.md), ours equals our independent static engine at every frame. Corners kept: how many "
      "corners of a frame, "
      "each the two contacts it lies on, the frame before has too (median); the others must be found anew by any "
      "update.\n");
  frames_heading(report);
  std::vector<FramesRow> one_percent;
  for (const ScalingPair& pair : pairs) {
    if (!wanted(options, pair.name)) continue;
    for (const auto& [text, step, frames] :
         {std::tuple{"0.1 %", 0.001, 100}, std::tuple{"1 %", 0.01, 100}, std::tuple{"10 %", 0.1, 24}}) {
      FramesPlan plan;
      plan.steps = text;
      plan.scales = steady_steps(step, static_cast<std::size_t>(frames));
      plan.rival_frames = options.quick || step != 0.01 ? 0 : 3;
      const FramesRow row = measure_frames(pair, plan);
      frames_line(report, row);
      if (step == 0.01) one_percent.push_back(row);
      if (step == 0.1 && pair.name == "neuron + disc 32")
        report.promise("neuron + disc 32 at 10 %: at most a third of static",
                       ratio(row.static_ms, row.frame_ms) + " times faster", row.static_ms >= 3 * row.frame_ms);
    }
  }
  return one_percent;
}

void promises(Report& report, const std::vector<FramesRow>& one_percent) {
  if (one_percent.empty()) return;
  report.line("\n### Promises at 1 % steps, of median frames\n");
  for (const FramesRow& r : one_percent) {
    report.promise(r.name + ": 8 times our static engine",
                   ratio(r.static_ms, r.frame_ms) + " (means " + ratio(r.static_mean_ms, r.frame_mean_ms) + ")",
                   r.static_ms >= 8 * r.frame_ms);
    if (r.cgal_ms > 0)
      report.promise(r.name + ": 500 times CGAL", ratio(r.cgal_ms, r.frame_ms), r.cgal_ms >= 500 * r.frame_ms);
  }
}

void rebuilding_table(Report& report, const Options& options, const std::vector<ScalingPair>& pairs) {
  if (!options.wants("modes")) return;
  report.line(
      "\n## Where rebuilding beats updating\n\nMean frame in ms by step, for windows only, from scratch only, and the "
      "controller.\n");
  report.line("| pair | step | windows only | from scratch only | automatic | automatic / better one |");
  report.line("|---|---|---|---|---|---|");
  for (const ScalingPair& pair : pairs) {
    if (!wanted(options, pair.name) ||
        (pair.name != "neuron + disc 32" && pair.name != "star 100 + star 100" && pair.name != "monkey + bird"))
      continue;
    for (const double step : {0.0005, 0.002, 0.01, 0.05, 0.2}) {
      double mean[3];
      int k = 0;
      for (const FrameMode mode : {FrameMode::window, FrameMode::rebuild, FrameMode::automatic}) {
        FramesPlan plan;
        plan.scales = steady_steps(step, step < 0.1 ? 40 : 16);
        plan.mode = mode;
        mean[k++] = measure_frames(pair, plan).frame_mean_ms;
      }
      report.line("| " + pair.name + " | " + fixed(100 * step, 2) + " % | " + fixed(mean[0]) + " | " + fixed(mean[1]) +
                  " | " + fixed(mean[2]) + " | " + fixed(mean[2] / std::min(mean[0], mean[1]), 2) + " |");
    }
  }
}

void table_6_1(Report& report, const Options& options) {
  if (!options.wants("random")) return;
  report.line(
      "\n## Table 6.1\n\n100 random scales in [0.1, 10], steps of 0.1; rows scale. Each cell: speed-up over the "
      "thesis's baseline (all pairs, from scratch) / over our "
      "static engine (means). Shapes with the vertex counts of the thesis's.\n");
  double worst = INFINITY, total = 0;
  std::string line;
  int column = 0;
  report.line("| | dog | G1 | G2 | G3 | G4 |\n|---|---|---|---|---|---|");
  for (const ScalingPair& pair : table_pairs()) {
    if (!wanted(options, pair.name)) continue;
    FramesPlan plan;
    plan.steps = "random";
    plan.scales = random_scales(100);
    plan.rival_frames = 5;
    plan.cgal = false;
    const FramesRow row = measure_frames(pair, plan);
    if (row.different > 0) report.line("**different results: " + row.name + "**");
    const double speed = row.static_mean_ms / row.frame_mean_ms;
    worst = std::min(worst, speed);
    total += row.all_pairs_ms / row.frame_mean_ms;
    if (column % 5 == 0) line = "| " + pair.name.substr(0, pair.name.find(' '));
    line += " | " + ratio(row.all_pairs_ms, row.frame_mean_ms) + " / " + fixed(speed, 2);
    if (++column % 5 == 0) report.line(line + " |");
  }
  if (column == 0) return;
  report.line("\nMean speed-up over the thesis's baseline: " + fixed(total / column, 1) + " (the thesis: 150.7).\n");
  report.promise("random scales: never slower than static by more than 1.2", fixed(worst, 2) + " times static at worst",
                 worst >= 1 / 1.2);
}

bool is_thesis_pair(const ScalingPair& pair) { return pair.name == "neuron + disc 32" || pair.name == "monkey + bird"; }

void pair_events_table(Report& report, const Options& options, const std::vector<ScalingPair>& pairs) {
  if (!options.wants("events")) return;
  if (std::none_of(pairs.begin(), pairs.end(),
                   [&](const ScalingPair& pair) { return is_thesis_pair(pair) && wanted(options, pair.name); }))
    return;
  report.line(
      "\n## The thesis's pair events over (0, infinity)\n\nCounted by streaming: the ends of the intervals of scales "
      "at which two segments of the reduced convolution "
      "cross properly. The thesis has 56,238 and 56,996,430.\n\n| pair | segments | pairs that meet | events | pairs "
      "doubles did not decide |\n|---|---|---|---|---|");
  for (const ScalingPair& pair : pairs) {
    if (!is_thesis_pair(pair) || !wanted(options, pair.name)) continue;
    const PairEventCount c =
        count_pair_events(pair.p, pair.q, pair.q_scales ? MovingOperand::q : MovingOperand::p).value();
    report.line("| " + pair.name + " | " + std::to_string(c.segments) + " | " + std::to_string(c.pairs_that_meet) +
                " | " + std::to_string(c.events) + " | " + std::to_string(c.exact_pairs) + " |");
  }
}

/// Steps of all sizes.
std::vector<double> mixed_steps() {
  std::vector<double> scales;
  double s = 1;
  for (int i = 0; i < 160; ++i) {
    const double step = std::pow(10, -4 + 3.2 * (i * 37 % 160) / 160);
    s = s > 4 ? 1 : s * (1 + step);
    scales.push_back(std::round(s * 0x1p14) * 0x1p-14);
  }
  return scales;
}

void write_results(Report& report, const Options& options, const std::vector<ScalingPair>& pairs,
                   const std::vector<SweepRow>& swept) {
  const auto write = [&](const std::string& name, const std::string& text) {
    write_result(options.results, name, text);
  };
  if (options.wants("steady")) write("scaling.csv", report.csv.str());
  if (!swept.empty()) write("sweeps.csv", sweep_csv(swept));
  for (const ScalingPair& pair : pairs) {
    if (!is_thesis_pair(pair) || !wanted(options, pair.name) || !options.wants("figures")) continue;
    FramesPlan plan;
    plan.scales = mixed_steps();
    plan.mode = FrameMode::window;  // every frame is an update, expensive ones too
    write(pair.name == "monkey + bird" ? "figure-6.6.svg" : "figure-6.7.svg",
          figure(measure_frames(pair, plan), pair.name + ": speed-up of frames"));
  }
  if (options.wants("figures")) report.line("\n![figure 6.6](figure-6.6.svg)\n![figure 6.7](figure-6.7.svg)");
  write("scaling.md", report.markdown.str());
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--quick") options.quick = true;
    else if (word == "--only" && i + 1 < argc) options.only = argv[++i];
    else if (word == "--part" && i + 1 < argc) options.part = argv[++i];
    else if (word == "--results" && i + 1 < argc) options.results = argv[++i];
    else throw std::invalid_argument(kUsage);
  }
  return options;
}

int run(int argc, char** argv) {
  const Options options = parse(argc, argv);
  Report report;
  const std::string data = data_folder();
  const std::vector<ScalingPair> pairs = frame_pairs(data);
  opening(report, data);
  const std::vector<SweepRow> swept = sweeps(report, options, data);
  promises(report, steady_table(report, options, pairs));
  rebuilding_table(report, options, pairs);
  table_6_1(report, options);
  copies_table(report, options, pairs);
  pair_events_table(report, options, pairs);
  if (!options.results.empty()) write_results(report, options, pairs, swept);
  return 0;
}

}  // namespace
}  // namespace dymsum::bench

int main(int argc, char** argv) { return dymsum::bench::guarded(dymsum::bench::run, argc, argv); }
