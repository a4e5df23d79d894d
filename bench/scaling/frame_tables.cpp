#include "scaling/frame_tables.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "scaling/copies.h"
#include "scaling/measure.h"
#include "scaling/scatter.h"
#include "thesis/pair_events.h"

namespace dymsum::bench {
namespace {

std::string count(std::uint64_t n) { return std::to_string(n); }
std::string ms(double v) { return fixed(v, 3); }
std::string rival_ms(double v) { return v > 0 ? fixed(v, 1) : "-"; }
std::string ratio(double a, double b) { return bench::ratio(a, b, 2); }

bool is_thesis_pair(const ScalingPair& pair) { return pair.name == "neuron + disc 32" || pair.name == "monkey + bird"; }

void frames_line(Report& report, const FramesRow& r) {
  const Spread &frame = r.frame_ms, &fresh = r.static_ms;
  report.row({r.name,
              r.steps,
              count(r.segments),
              count(r.vertices),
              fixed(100 * r.kept, 1) + " %",
              ms(fresh.mean),
              fixed(frame.mean, 4),
              fixed(frame.median, 4),
              ms(frame.p99),
              ms(frame.worst),
              "**" + ratio(fresh.mean, frame.mean) + "**",
              ratio(fresh.median, frame.median),
              fixed(r.update_ms, 4),
              ms(r.window_ms),
              count(r.windows) + ", " + count(r.rebuilt) + ", " + count(r.degenerate) + " of " + count(r.frames),
              rival_ms(r.all_pairs_ms),
              ratio(r.all_pairs_ms, frame.mean),
              rival_ms(r.cgal_ms),
              ratio(r.cgal_ms, frame.mean),
              count(r.compared) + "; " + count(r.different) + ", " + count(r.cgal_different)});
  for (const FrameSample& f : r.samples)
    report.csv << r.name << "," << r.steps << "," << f.s << "," << f.ms << "," << f.static_ms << "," << f.events << ","
               << f.crossings << "," << f.rebuilt << "," << f.new_window << "\n";
}

void promises(Report& report, const std::vector<FramesRow>& rows) {
  report.line("\n### Promises, of mean frames\n");
  std::uint64_t compared = 0, different = 0;
  for (const FramesRow& r : rows) {
    compared += r.compared;
    different += r.different;
    if (r.cgal_ms > 0)
      report.promise(r.name + " at " + r.steps + ": 500 times CGAL", ratio(r.cgal_ms, r.frame_ms.mean),
                     r.cgal_ms >= 500 * r.frame_ms.mean);
    if (r.steps == "10 %" && r.name == "neuron + disc 32")
      report.promise("neuron + disc 32 at 10 %: at most a third of static",
                     ratio(r.static_ms.mean, r.frame_ms.mean) + " times faster",
                     r.static_ms.mean >= 3 * r.frame_ms.mean);
  }
  report.promise("every frame equals the static sum exactly",
                 count(compared) + " compared, " + count(different) + " differ", different == 0);
}

std::string figure(const FramesRow& row, const std::string& title) {
  std::vector<Dot> events, crossings;
  for (const FrameSample& f : row.samples) {
    events.push_back({static_cast<double>(f.events), f.static_ms / f.ms});
    crossings.push_back({static_cast<double>(f.crossings), f.static_ms / f.ms});
  }
  return draw_scatter(title, "crossings that came or went", "speed-up over our static engine", events,
                      "crossings of the frame", crossings);
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

}  // namespace

void steady_table(Report& report, const std::vector<ScalingPair>& pairs, const Wanted& wanted, bool rivals) {
  report.line(
      "\n## Steady steps, snapped\n\nEvery frame compared exactly with our static engine. Inputs are snapped to 22-bit "
      "integers and scales to 14 fractional bits, so that s P is the same set for everyone. "
      "Static: `minkowski_sum` from `Region` to `PlanarSum`. Each sweeps on its own for the times, three times by "
      "turns, and the median of each frame counts; a last sweep compares. Making the sum is in no frame. All pairs: "
      "the reference engine `brute`, which intersects all pairs of segments from scratch as the thesis does. CGAL 5.5: "
      "reduced convolution with EPECK. Both on three frames of a row, and compared with the mean frame; CGAL's reduced "
      "convolution loses holes in known cases (see planar.md, and the end of docs/design/scaling-sum.md), ours equals "
      "our independent static engine at every frame. Corners kept: how many corners of a frame, each the two contacts "
      "it lies on, the frame before has too (median); the others must be found anew by any update.\n");
  report.heading({"pair",
                  "steps",
                  "segments",
                  "vertices",
                  "corners kept",
                  "static ms, mean",
                  "frame ms, mean",
                  "median",
                  "p99",
                  "worst",
                  "static / frame, means",
                  "medians",
                  "in window ms",
                  "building ms",
                  "windows, from scratch, touching",
                  "all pairs ms",
                  "/ frame",
                  "CGAL ms",
                  "/ frame",
                  "compared; differs from static, from CGAL"});
  report.csv << "pair,steps,s,frame_ms,static_ms,events,crossings,rebuilt,new_window\n";
  std::vector<FramesRow> rows;
  for (const ScalingPair& pair : pairs) {
    if (!wanted(pair)) continue;
    for (const auto& [text, step, frames] :
         {std::tuple{"0.1 %", 0.001, 100}, std::tuple{"1 %", 0.01, 100}, std::tuple{"10 %", 0.1, 24}}) {
      FramesPlan plan;
      plan.steps = text;
      plan.scales = steady_steps(step, static_cast<std::size_t>(frames));
      plan.rival_frames = rivals && step == 0.01 ? 3 : 0;
      rows.push_back(measure_frames(pair, plan));
      frames_line(report, rows.back());
    }
  }
  promises(report, rows);
}

void modes_table(Report& report, const std::vector<ScalingPair>& pairs, const Wanted& wanted) {
  report.line(
      "\n## Where rebuilding beats updating\n\nMean frame in ms by step, for windows only, from scratch only, and the "
      "controller.\n");
  report.heading({"pair", "step", "windows only", "from scratch only", "automatic", "automatic / better one"});
  for (const ScalingPair& pair : pairs) {
    if (!wanted(pair) ||
        (pair.name != "neuron + disc 32" && pair.name != "star 100 + star 100" && pair.name != "monkey + bird"))
      continue;
    for (const double step : {0.0005, 0.002, 0.01, 0.05, 0.2}) {
      double mean[3];
      int k = 0;
      for (const FrameMode mode : {FrameMode::window, FrameMode::rebuild, FrameMode::automatic}) {
        FramesPlan plan;
        plan.scales = steady_steps(step, step < 0.1 ? 40 : 16);
        plan.mode = mode;
        mean[k++] = measure_frames(pair, plan).frame_ms.mean;
      }
      report.row({pair.name, fixed(100 * step, 2) + " %", ms(mean[0]), ms(mean[1]), ms(mean[2]),
                  fixed(mean[2] / std::min(mean[0], mean[1]), 2)});
    }
  }
}

void table_6_1(Report& report, const Wanted& wanted) {
  report.line(
      "\n## Table 6.1\n\n100 random scales in [0.1, 10], steps of 0.1; rows scale. Each cell: speed-up over the "
      "thesis's baseline (all pairs, from scratch) / over our "
      "static engine (means). Shapes with the vertex counts of the thesis's.\n");
  double worst = INFINITY, total = 0;
  std::vector<std::string> cells;
  std::size_t pairs = 0;
  report.heading({"", "dog", "G1", "G2", "G3", "G4"});
  for (const ScalingPair& pair : table_pairs()) {
    if (!wanted(pair)) continue;
    FramesPlan plan;
    plan.steps = "random";
    plan.scales = random_scales(100);
    plan.rival_frames = 5;
    plan.cgal = false;
    const FramesRow row = measure_frames(pair, plan);
    if (row.different > 0) report.line("**different results: " + row.name + "**");
    const double speed = row.static_ms.mean / row.frame_ms.mean;
    worst = std::min(worst, speed);
    total += row.all_pairs_ms / row.frame_ms.mean;
    if (cells.empty()) cells = {pair.name.substr(0, pair.name.find(' '))};
    cells.push_back(ratio(row.all_pairs_ms, row.frame_ms.mean) + " / " + fixed(speed, 2));
    ++pairs;
    if (cells.size() == 6) report.row(std::exchange(cells, {}));
  }
  if (!cells.empty()) report.row(cells);
  if (pairs == 0) return;
  report.line("\nMean speed-up over the thesis's baseline: " + fixed(total / static_cast<double>(pairs), 1) +
              " (the thesis: 150.7).\n");
  report.promise("random scales: never slower than static by more than 1.2", fixed(worst, 2) + " times static at worst",
                 worst >= 1 / 1.2);
}

void copies_table(Report& report, const std::vector<ScalingPair>& pairs, const Wanted& wanted, bool baseline) {
  std::vector<ScalingPair> environments;
  const std::vector<ScalingPair> table = table_pairs();
  for (const char* name : {"G1 + G4", "dog + G2", "neuron + disc 32", "monkey + bird", "star 200 + star 200"})
    for (const auto* list : {&table, &pairs})
      for (const ScalingPair& pair : *list)
        if (pair.name == name && wanted(pair)) environments.push_back(pair);
  if (environments.empty()) return;
  report.line(
      "\n## Many copies\n\nFigure 6.11: twelve scaled copies of one obstacle P and a robot Q; all twelve sums s P + "
      "(-Q), by `scaled_copies`, by our static engine "
      "on each copy, and by the thesis's baseline (all pairs, from scratch) on each copy. The thesis has 96.8 ms "
      "against 2.5 ms, without its events.\n");
  report.heading({"obstacle + robot", "sizes", "distinct", "segments", "vertices of all", "copies ms", "static ms",
                  "static / copies", "all pairs ms", "all pairs / copies", "windows, from scratch",
                  "compared; different"});
  for (const ScalingPair& pair : environments)
    for (const CopiesPlan& plan : twelve_copies()) {
      const CopiesRow r = measure_copies(pair, plan, 9, baseline);
      report.row({r.name, r.sizes, count(r.distinct), count(r.segments), count(r.vertices), ms(r.copies_ms),
                  ms(r.static_ms), "**" + ratio(r.static_ms, r.copies_ms) + "**", rival_ms(r.all_pairs_ms),
                  ratio(r.all_pairs_ms, r.copies_ms), count(r.windows) + ", " + count(r.rebuilt),
                  count(r.compared) + "; " + count(r.different)});
    }
}

void pair_events_table(Report& report, const std::vector<ScalingPair>& pairs, const Wanted& wanted) {
  if (std::none_of(pairs.begin(), pairs.end(),
                   [&](const ScalingPair& pair) { return is_thesis_pair(pair) && wanted(pair); }))
    return;
  report.line(
      "\n## The thesis's pair events over (0, infinity)\n\nCounted by streaming: the ends of the intervals of scales "
      "at which two segments of the reduced convolution "
      "cross properly. The thesis has 56,238 and 56,996,430.\n");
  report.heading({"pair", "segments", "pairs that meet", "events", "pairs doubles did not decide"});
  for (const ScalingPair& pair : pairs) {
    if (!is_thesis_pair(pair) || !wanted(pair)) continue;
    const PairEventCount c =
        count_pair_events(pair.p, pair.q, pair.q_scales ? MovingOperand::q : MovingOperand::p).value();
    report.row({pair.name, count(c.segments), count(c.pairs_that_meet), count(c.events), count(c.exact_pairs)});
  }
}

void figures(Report& report, const std::vector<ScalingPair>& pairs, const Wanted& wanted, const std::string& folder) {
  for (const ScalingPair& pair : pairs) {
    if (!is_thesis_pair(pair) || !wanted(pair)) continue;
    FramesPlan plan;
    plan.scales = mixed_steps();
    plan.mode = FrameMode::window;  // every frame is an update, expensive ones too
    write_result(folder, pair.name == "monkey + bird" ? "figure-6.6.svg" : "figure-6.7.svg",
                 figure(measure_frames(pair, plan), pair.name + ": speed-up of frames"));
  }
  report.line("\n![figure 6.6](figure-6.6.svg)\n![figure 6.7](figure-6.7.svg)");
}

}  // namespace dymsum::bench
