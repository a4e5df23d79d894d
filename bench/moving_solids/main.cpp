// dymsum_bench_moving_solids: frames of sums of solids in motion, against sums from scratch at the same poses.
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <random>
#include <sstream>
#include <stdexcept>

#include "base/poll.h"
#include "coordinate_kinds.h"
#include "dymsum/moving_solid_sum.h"
#include "dymsum/solid_scale_events.h"
#include "moving_solids/kinds.h"
#include "page.h"
#include "solid/inputs.h"
#include "spatial/moving/dynamic_convolution.h"
#include "spread.h"
#include "thesis/solid_pair_events.h"

namespace dymsum::bench {
namespace {

constexpr const char* kUsage =
    "dymsum_bench_moving_solids [--frames N] [--off-grid] [--coordinates KIND] [--only TEXT] [--results DIR]\n"
    "  (default)      all motions\n"
    "  --frames N     of every motion (default 20)\n"
    "  --only TEXT    only pairs whose name contains TEXT\n"
    "  --events       the events of P + s Q over [1, 1.1] instead, against sums from scratch around each\n"
    "  --scattered    random orientations as a batch instead (N of --frames), against a posed_sum for each\n"
    "  --results DIR  also write moving-solids.md and moving-solids.csv into DIR\n"
    "Environment: DYMSUM_DATA, a folder with solid/ (else ../shared/data beside the checkout, where present).\n";

struct Options {
  int frames = 20;
  bool events = false, scattered = false;
  std::string only, results;
  KindOptions coordinates;
};

/// P's poses, one after the other.
struct Motion {
  std::string name;
  SolidPose (*pose)(int frame);
};

SolidPose turned_by(double steps, int frame) {
  return {*Rotation::about({1, 2, 3}, 2 * std::numbers::pi * frame / steps), {}};
}
SolidPose scaled_by(int percent, int axes, int frame) {
  SolidPose pose;
  const Scale s = *Scale::parse(std::to_string(100 + percent * frame) + "/100");
  for (int k = 0; k < axes; ++k) pose.scale[k] = s;
  return pose;
}
constexpr const char *kCoarse = "500 steps a turn", *kFine = "5,000 steps a turn";
const std::vector<Motion> kMotions = {
    {kCoarse, [](int k) { return turned_by(500, k); }},
    {kFine, [](int k) { return turned_by(5000, k); }},
    {"60 steps a turn", [](int k) { return turned_by(60, k); }},
    {"1 % scale steps", [](int k) { return scaled_by(1, 3, k); }},
    {"1 % along x", [](int k) { return scaled_by(1, 1, k); }},
};

const std::vector<std::string> kPairs = {"torus 256 + torus 256",
                                         "torus 1024 + torus 1024",
                                         "blob 1024 + blob 1024",
                                         "torus 1024 + ball 224",
                                         "grate 2 + grate 2",
                                         "grate 4 + grate 4",
                                         "comb 8 + upright comb 8",
                                         "gear 12 + gear 9",
                                         "gear 24 + turned gear 16",
                                         "block + thinner peg",
                                         "bunny-348.obj + bunny-128.off",
                                         "gc_fox.off + gc_bob_small.off"};

struct Row {
  std::vector<double> moving, fresh, convolution, fresh_convolution;
  double facets = 0, changed = 0, normals = 0, inner = 0;
  std::size_t rebuilt = 0;
  bool same = true;
};

/// The convolution alone, and one made from scratch in a space that is there already.
void add_convolutions(const spatial::SolidPair& pair, const Motion& motion, int frames, Row& row) {
  spatial::DynamicConvolution moving(pair);
  SpatialOptions options;
  options.threads = 1;
  for (int k = 0; k <= frames; ++k) {
    const spatial::PosePair poses{motion.pose(k), {}};
    spatial::SpaceOnDemand exact(pair, poses);
    exact();
    SpatialStats stats;
    spatial::StageWatch watch(options, stats);
    Stopwatch time;
    const spatial::ConvolutionWork& work = moving.set(poses, exact);
    const double update = time.lap();
    const spatial::ReducedConvolution fresh = reduced_convolution(exact(), pair.p, pair.q, watch);
    const double scratch = time.lap();
    const std::vector<std::uint32_t> slots = moving.in_order();
    row.same = row.same && slots.size() == fresh.facets.size();
    for (std::size_t f = 0; row.same && f < slots.size(); ++f)
      row.same = moving.slots()[slots[f]].corner == fresh.facets[f].corner;
    if (k == 0) continue;
    row.convolution.push_back(update), row.fresh_convolution.push_back(scratch);
    row.facets = static_cast<double>(slots.size());
    row.changed += static_cast<double>(work.added + work.removed) / frames;
    row.normals += static_cast<double>(work.normals_checked) / frames;
  }
}

Row measure(const Mesh& p, const Mesh& q, const Motion& motion, int frames) {
  Row row;
  add_convolutions(spatial::solid_pair(p, q), motion, frames, row);
  MovingSolidOptions options;
  MovingSolidSum moving = MovingSolidSum::create(p, q, options).value();
  options.mode = FrameMode::rebuild;
  MovingSolidSum fresh = MovingSolidSum::create(p, q, options).value();
  for (int k = 1; k <= frames; ++k) {
    const SolidFrameWork work = moving.set(motion.pose(k)).value();
    row.moving.push_back(work.ms), row.rebuilt += work.rebuilt;
    row.inner += static_cast<double>(work.inner_kept) / frames;
    row.fresh.push_back(fresh.set(motion.pose(k)).value().ms);
    row.same = row.same && moving.sum() == fresh.sum();
  }
  return row;
}

void add_row(const std::string& name, const Motion& motion, const Row& row, Report& report) {
  const Spread moving = spread(row.moving), fresh = spread(row.fresh), update = spread(row.convolution),
               scratch = spread(row.fresh_convolution);
  report.row({name, motion.name, fixed(row.facets, 0), fixed(row.changed, 0), fixed(row.normals, 0),
              fixed(update.mean, 3), fixed(scratch.mean, 2), ratio(scratch.mean, update.mean, 1),
              ratio(fresh.mean, update.mean, 0), fixed(moving.median, 1), fixed(moving.mean, 1), fixed(moving.p99, 1),
              fixed(moving.worst, 1), fixed(fresh.median, 1), ratio(fresh.median, moving.median, 2),
              ratio(fresh.mean, moving.mean, 2), std::to_string(row.rebuilt), fixed(row.inner, 0),
              row.same ? "same" : "DIFFERENT"});
}

/// Gains of every pair at one motion.
struct Gains {
  std::vector<double> median, mean, convolution;

  void add(const Row& row) {
    median.push_back(spread(row.fresh).median / spread(row.moving).median);
    mean.push_back(spread(row.fresh).mean / spread(row.moving).mean);
    convolution.push_back(spread(row.fresh_convolution).mean / spread(row.convolution).mean);
  }
  static void promise_least(Report& report, const std::string& text, const std::vector<double>& gains, double queried) {
    const auto [least, most] = std::minmax_element(gains.begin(), gains.end());
    report.promise(text + ", on every pair", fixed(*least, 2) + " to " + fixed(*most, 2), *least >= queried);
  }
};

void add_csv(const std::string& name, const Motion& motion, const Row& row, std::ostream& csv) {
  const auto list = [&](const std::vector<double>& times) {
    csv << ",";
    for (std::size_t i = 0; i < times.size(); ++i) csv << (i > 0 ? " " : "") << fixed(times[i], 3);
  };
  csv << name << ",\"" << motion.name << "\"";
  list(row.moving), list(row.fresh);
  csv << "\n";
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--frames" && i + 1 < argc) options.frames = std::atoi(argv[++i]);
    else if (word == "--only" && i + 1 < argc) options.only = argv[++i];
    else if (word == "--events") options.events = true;
    else if (word == "--scattered") options.scattered = true;
    else if (word == "--results" && i + 1 < argc) options.results = argv[++i];
    else if (!options.coordinates.take(argc, argv, i)) throw std::invalid_argument(std::string(kUsage) + kKindUsage);
  }
  if (options.frames < 1) throw std::invalid_argument(kUsage);
  return options;
}

/// Those of kPairs that are requested, in coordinates of a kind.
std::vector<SolidPair> wanted_pairs(const Options& options, const std::string& data, Kind kind, Report& report) {
  std::vector<SolidPair> pairs = solid_pairs(data);
  std::erase_if(pairs, [&](const SolidPair& pair) {
    return std::find(kPairs.begin(), kPairs.end(), pair.name) == kPairs.end() ||
           pair.name.find(options.only) == std::string::npos;
  });
  std::vector<std::string> notes;
  pairs = with_coordinates(std::move(pairs), kind, notes);
  if (kind) report.line("Coordinates: " + name(*kind) + ".\n");
  for (const std::string& note : notes) report.line(note + "\n");
  return pairs;
}

/// Events over [1, 1.1], their time, and that of a sum from scratch on both sides of every one.
int run_events(const Options& options, const std::string& data, Kind kind) {
  Report report;
  const std::vector<SolidPair> pairs = wanted_pairs(options, data, kind, report);
  report.heading({"pair", "facets", "events", "topology", "candidates", "exact points", "sums compared", "ms",
                  "ms a sum", "from scratch around each, ms", "gain", "pair events", "ms"});
  const Scale low = *Scale::parse("1"), high = *Scale::parse("1.1");
  for (const SolidPair& pair : pairs) {
    const Mesh p = Mesh::create(pair.p).value(), q = Mesh::create(pair.q).value();
    Stopwatch time;
    const SolidScaleEvents sum = SolidScaleEvents::create(p, q).value();
    SolidEventWork work;
    const std::vector<ScaleEvent> events = sum.events(low, high, {}, &work).value();
    const double ms = time.lap();
    std::size_t topology = 0;
    for (const ScaleEvent& e : events) topology += e.topology;
    time.lap();
    if (!sum.at(low).ok()) return 3;
    const double at = time.lap(), scratch = at * 2 * static_cast<double>(events.size());
    const SolidPairEventCount met = count_solid_pair_events(p, q).value();
    report.row({pair.name, std::to_string(sum.facet_count()), std::to_string(events.size()), std::to_string(topology),
                std::to_string(work.candidates), std::to_string(work.points), std::to_string(work.sums), fixed(ms, 0),
                fixed(at, 1), fixed(scratch, 0), ratio(scratch, ms, 1), std::to_string(met.events()),
                fixed(time.lap(), 0)});
  }
  write_result(KindOptions::folder(options.results, kind), "moving-solids-events.md", report.markdown.str());
  return 0;
}

/// Batches of random orientations, and a sum from scratch for each by itself.
int run_scattered(const Options& options, const std::string& data, Kind kind) {
  std::mt19937_64 random(1);
  const auto part = [&] { return static_cast<std::int64_t>(random() % 2001) - 1000; };
  std::vector<SolidPose> poses;
  for (int k = 0; k < options.frames; ++k)
    poses.push_back({Rotation::of(1 + part() / 2, part(), part(), part()).value(), {}});
  Report report;
  const std::vector<SolidPair> pairs = wanted_pairs(options, data, kind, report);
  report.heading(
      {"pair", "poses", "one by one, ms a pose", "batch", "gain", "batch on two threads", "gain", "results"});
  bool same = true;
  for (const SolidPair& pair : pairs) {
    const Mesh p = Mesh::create(pair.p).value(), q = Mesh::create(pair.q).value();
    std::vector<SpatialSum> sums;
    Stopwatch time;
    for (const SolidPose& pose : poses) sums.push_back(posed_sum(p, q, pose).value());
    const double n = options.frames, alone = time.lap() / n;
    const auto batch = [&](int threads) {
      MovingSolidOptions own;
      own.threads = threads;
      std::vector<SpatialSum> made(poses.size());
      const auto visit = [&](std::size_t k, const SpatialSum& sum) { made[k] = sum; };
      time.lap();
      (void)posed_sums(p, q, poses, {}, visit, own).value();
      const double ms = time.lap() / n;
      same = same && made == sums;
      return ms;
    };
    const double one = batch(1), two = batch(2);
    report.row({pair.name, std::to_string(poses.size()), fixed(alone, 1), fixed(one, 1), ratio(alone, one, 2),
                fixed(two, 1), ratio(alone, two, 2), same ? "same" : "DIFFERENT"});
  }
  write_result(KindOptions::folder(options.results, kind), "moving-solids-scattered.md", report.markdown.str());
  return same ? 0 : 3;
}

int run_motions(const Options& options, const std::string& data, Kind kind) {
  Report report;
  report.line("# Sums of solids in motion\n");
  report.line("`./run bench moving-solids --results docs/results` made this page.\n");
  report.line(
      "P turns about (1, 2, 3), or scales. Milliseconds on one thread: the facets of the convolution after each move, "
      "and "
      "all of them from scratch; a frame of a MovingSolidSum, and the sum from scratch at the same exact pose, by "
      "turns. "
      "A gain below 1 is a loss. `changed`: facets that came or went in a frame; `inner`: those that balls keep out. "
      "The "
      "last column compares every frame's facets and sum with those from scratch. `whole sum / update`: the sum from "
      "scratch over the update of its convolution. All frames are in moving-solids.csv.\n");
  const std::vector<SolidPair> pairs = wanted_pairs(options, data, kind, report);
  report.heading({"pair", "motion", "facets", "changed", "normals looked at", "convolution ms", "from scratch", "gain",
                  "whole sum / update", "frame median ms", "mean", "p99", "worst", "from scratch", "gain of medians",
                  "of means", "frames from scratch", "inner", "results"});
  bool same = true;
  Gains coarse, fine;
  std::ostringstream csv;
  csv << "pair,motion,frames_ms,from_scratch_ms\n";
  for (const SolidPair& pair : pairs) {
    const Mesh p = Mesh::create(pair.p).value(), q = Mesh::create(pair.q).value();
    for (const Motion& motion : kMotions) {
      const Row row = measure(p, q, motion, options.frames);
      add_row(pair.name, motion, row, report);
      add_csv(pair.name, motion, row, csv);
      if (motion.name == kCoarse) coarse.add(row);
      if (motion.name == kFine) fine.add(row);
      same = same && row.same;
    }
  }
  if (!coarse.mean.empty()) {
    report.line("\n## Promises\n");
    coarse.promise_least(report, "the median frame at least 5 times faster than from scratch", coarse.median, 5);
    coarse.promise_least(report, "the mean frame at least 2.5 times", coarse.mean, 2.5);
    coarse.promise_least(report, "the convolution alone at least 20 times", coarse.convolution, 20);
    fine.promise_least(report, "5,000 steps a turn: the mean frame at least 6 times", fine.mean, 6);
    report.promise("every frame is the sum from scratch", same ? "all" : "NOT all", same);
  }
  const std::string folder = KindOptions::folder(options.results, kind);
  write_result(folder, "moving-solids.md", report.markdown.str());
  write_result(folder, "moving-solids.csv", csv.str());
  return same ? 0 : 3;
}

int run(int argc, char** argv) {
  const Options options = parse(argc, argv);
  const char* given = std::getenv("DYMSUM_DATA");
  const std::string data = given != nullptr ? given : std::string(DYMSUM_SOURCE_DIR) + "/../shared/data";
  int code = 0;
  if (!options.coordinates.off_grid)
    for (const Kind& kind : options.coordinates.kinds)
      code = std::max(code, options.events      ? run_events(options, data, kind)
                            : options.scattered ? run_scattered(options, data, kind)
                                                : run_motions(options, data, kind));
  const bool all = !options.events && !options.scattered && options.only.empty() && !options.coordinates.chosen();
  if ((options.coordinates.off_grid || all) && !measure_kinds(options.results)) code = 3;
  return code;
}

}  // namespace
}  // namespace dymsum::bench

int main(int argc, char** argv) { return dymsum::bench::guarded(dymsum::bench::run, argc, argv); }
