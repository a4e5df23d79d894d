// dymsum_bench_families: families of sums against sums from scratch, ours and the thesis's.
#include <cmath>
#include <stdexcept>

#include "coordinate_kinds.h"
#include "dymsum/shapes.h"
#include "families/measure.h"
#include "families/solids.h"
#include "page.h"
#include "planar/pairs.h"

namespace dymsum::bench {
namespace {

constexpr const char* kUsage =
    "dymsum_bench_families [--coordinates KIND] [--only TEXT] [--part NAME] [--results DIR]\n"
    "  --only TEXT    only pairs whose name contains TEXT\n"
    "  --part NAME    only one of: making, turning, table, solids\n"
    "  --results DIR  also write families.md into DIR\n";

struct Options {
  std::string only, part, results;
  KindOptions coordinates;
  bool wants(const std::string& name) const { return part.empty() || part == name; }
  bool wants(const ScalingPair& pair) const { return pair.name.find(only) != std::string::npos; }
};

Scale ratio_of(std::int64_t n, std::int64_t d) { return Scale::of(Rational::of(n, d).value()).value(); }

void heading(Report& report) {
  report.heading({"pair", "interval", "vertices", "events, visible", "names", "MB", "making ms", "in static sums",
                  "static ms, mean", "at ms, mean", "median", "p99", "worst", "static / at, mean", "least", "paid",
                  "compared, different"});
}

void write_row(Report& report, const FamilyRow& row) {
  const double gain = row.static_ms.mean - row.at_ms.mean;
  report.row({row.name, row.interval, std::to_string(row.vertices),
              std::to_string(row.events) + ", " + std::to_string(row.visible), std::to_string(row.names),
              fixed(static_cast<double>(row.bytes) * 1e-6, 1), fixed(row.making_ms, 0),
              ratio(row.making_ms, row.static_ms.mean, 0), fixed(row.static_ms.mean, 3), fixed(row.at_ms.mean, 4),
              fixed(row.at_ms.median, 4), fixed(row.at_ms.p99, 4), fixed(row.at_ms.worst, 4),
              "**" + ratio(row.static_ms.mean, row.at_ms.mean, 1) + "**", fixed(row.least, 1),
              gain > 0 ? fixed(std::ceil(row.making_ms / gain), 0) : "never",
              std::to_string(row.compared) + ", " + std::to_string(row.different)});
}

void making(Report& report, const Options& options, const std::string& data, Kind kind) {
  report.line(
      "\n## Making a family, and queries\n\nP scales. Static: the sum from scratch at the same exact scale, of "
      "operands "
      "that have been summed before; a query is `at(s)`, 100 random scales, each the median of three. Paid: queries "
      "after "
      "which making has paid.\n");
  heading(report);
  std::vector<std::string> notes;
  std::vector<ScalingPair> pairs = sweep_pairs(data, Snapping::raw);
  pairs.push_back({"star 400 + star 400", shapes::noisy_star(400, 0.5, 1), shapes::noisy_star(400, 0.5, 2)});
  for (const ScalingPair& pair : with_coordinates(std::move(pairs), kind, notes)) {
    if (!options.wants(pair)) continue;
    const bool wide = pair.name == "dog + dog" || pair.name == "dog + bird" || pair.name == "star + star";
    const bool narrow = pair.name == "star 400 + star 400" || pair.name == "star 500 + star 500";
    const double low = wide ? 0.1 : narrow ? 1 : 0.5, high = wide ? 10 : narrow ? 1.1 : 2;
    FamilyPlan plan{wide     ? ratio_of(1, 10)
                    : narrow ? ratio_of(1, 1)
                             : ratio_of(1, 2),
                    wide     ? ratio_of(10, 1)
                    : narrow ? ratio_of(11, 10)
                             : ratio_of(2, 1),
                    scales_in(low + 1e-3, high - 1e-3, 100)};
    write_row(report, measure_family(pair, plan));
  }
  for (const std::string& note : notes) report.line("\n" + note);
}

/// P turns.
void turning(Report& report, const Options& options, const std::string& data, Kind kind) {
  report.line(
      "\n## A whole turn\n\nP turns about the origin. Static: the sum from scratch at the same exact orientation. 100 "
      "random orientations, with tangents of half the angle of some 20 bits.\n");
  heading(report);
  std::vector<std::string> notes;
  std::vector<ScalingPair> pairs;
  for (ScalingPair& pair : sweep_pairs(data, Snapping::raw))
    if (pair.name == "dog + dog" || pair.name == "dog + bird" || pair.name == "star + star" ||
        pair.name == "star 100 + star 100")
      pairs.push_back(std::move(pair));
  pairs.push_back({"gear 24 + gear 16", shapes::gear(24, 0.9, 1, 0x1p-20), shapes::gear(16, 0.7, 0.8, 0x1p-20)});
  double least = INFINITY;
  for (const ScalingPair& pair : with_coordinates(std::move(pairs), kind, notes)) {
    if (!options.wants(pair)) continue;
    const FamilyRow row = measure_turn(pair, 100);
    least = std::min(least, row.static_ms.mean / row.at_ms.mean);
    write_row(report, row);
  }
  for (const std::string& note : notes) report.line("\n" + note);
  if (least == INFINITY) return;
  report.line("");
  report.promise("turning: 10 times our static engine on the mean of every pair", fixed(least, 1) + " times at least",
                 least >= 10);
}

void table_6_1(Report& report, const Options& options, Kind kind) {
  report.line(
      "\n## Table 6.1\n\n100 random scales in [0.1, 10], steps of 0.1; rows scale. Each cell: speed-up of a query over "
      "the "
      "thesis's baseline (all pairs, from scratch) / over our static engine (means). Shapes with the vertex counts of "
      "the thesis's. The family of [1/10, 10] is made before, as the thesis's events are.\n");
  report.heading({"", "dog", "G1", "G2", "G3", "G4"});
  std::vector<std::string> cells, notes;
  double baseline = 0, statics = 0, least = INFINITY, making = 0;
  std::size_t count = 0, different = 0;
  for (const ScalingPair& pair : with_coordinates(table_pairs(), kind, notes)) {
    if (!options.wants(pair)) continue;
    const FamilyRow row = measure_family(pair, {ratio_of(1, 10), ratio_of(10, 1), tenths(100), 5});
    const double ours = row.static_ms.mean / row.at_ms.mean;
    least = std::min(least, ours);
    baseline += row.scratch_ms / row.at_ms.mean;
    statics += ours;
    making += row.making_ms / row.static_ms.mean;
    different += row.different;
    if (cells.empty()) cells = {pair.name.substr(0, pair.name.find(' '))};
    cells.push_back(ratio(row.scratch_ms, row.at_ms.mean, 0) + " / " + fixed(ours, 1));
    ++count;
    if (cells.size() == 6) report.row(std::exchange(cells, {}));
  }
  if (!cells.empty()) report.row(cells);
  if (count == 0) return;
  const auto mean = [&](double sum) { return sum / static_cast<double>(count); };
  report.line("");
  report.promise("150 times the thesis's baseline on the mean (the thesis: 150.7)", fixed(mean(baseline), 0) + " times",
                 mean(baseline) >= 150);
  report.promise("10 times our static engine on the mean", fixed(mean(statics), 1) + " times", mean(statics) >= 10);
  report.promise("4 times our static engine on every pair", fixed(least, 1) + " times at least", least >= 4);
  report.promise("sums equal those from scratch", std::to_string(different) + " differ", different == 0);
  report.line("- making takes " + fixed(mean(making), 0) + " static sums on the mean");
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--only" && i + 1 < argc) options.only = argv[++i];
    else if (word == "--part" && i + 1 < argc) options.part = argv[++i];
    else if (word == "--results" && i + 1 < argc) options.results = argv[++i];
    else if (!options.coordinates.take(argc, argv, i)) throw std::invalid_argument(std::string(kUsage) + kKindUsage);
  }
  return options;
}

int run(int argc, char** argv) {
  const Options options = parse(argc, argv);
  const std::string data = data_folder();
  for (const Kind& kind : options.coordinates.kinds) {
    Report report;
    report.line(
        "# Families of sums\n\nWritten by `./run bench families --results docs/results`. Processor times in "
        "milliseconds "
        "of one thread; reading the clock is taken off all of them. Queries are compared with sums from scratch.");
    if (kind) report.line("\nCoordinates: " + name(*kind) + ".");
    if (data.empty()) report.line("\nNo data folder (DYMSUM_DATA): the thesis's polygons are left out.");
    if (options.wants("making")) making(report, options, data, kind);
    if (options.wants("turning")) turning(report, options, data, kind);
    if (options.wants("table")) table_6_1(report, options, kind);
    if (options.wants("solids") && !kind) {
      measure_solid_scalings(report, options.only, data);
      measure_solid_turns(report, options.only, data);
    }
    write_result(KindOptions::folder(options.results, kind), "families.md", report.markdown.str());
  }
  return 0;
}

}  // namespace
}  // namespace dymsum::bench

int main(int argc, char** argv) { return dymsum::bench::guarded(dymsum::bench::run, argc, argv); }
