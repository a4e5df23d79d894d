// dymsum_bench_edits: steps of edited sums against sums from scratch.
#include <time.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "coordinate_kinds.h"
#include "dymsum/editable_sum.h"
#include "dymsum/shapes.h"
#include "oracles/random.h"
#include "page.h"
#include "planar/pairs.h"
#include "scaling/pairs.h"
#include "spread.h"

namespace dymsum::bench {
namespace {

constexpr const char* kUsage =
    "dymsum_bench_edits [--coordinates KIND] [--only TEXT] [--steps N] [--results DIR]\n"
    "  --only TEXT    only pairs whose name contains TEXT\n"
    "  --steps N      steps of every row [200]\n"
    "  --results DIR  also write edits.md into DIR\n";

struct Options {
  std::string only, results;
  int steps = 200;
  KindOptions coordinates;
};

double processor_ms() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

Point vertex_at(const Region& region, std::uint32_t index) {
  for (const Part& part : region.parts()) {
    if (index < part.outer.size()) return part.outer[index];
    index -= static_cast<std::uint32_t>(part.outer.size());
    for (const Ring& hole : part.holes) {
      if (index < hole.size()) return hole[index];
      index -= static_cast<std::uint32_t>(hole.size());
    }
  }
  throw std::logic_error("no such vertex");
}

// A step: so many vertices of P in a row, each moved by up to a fraction of the typical edge.
std::vector<Edit> step_of(oracles::Random& random, const Region& p, int vertices) {
  const auto n = static_cast<std::uint32_t>(p.vertex_count());
  const auto first = static_cast<std::uint32_t>(random.below(static_cast<int>(n)));
  const auto box = bounds(p);
  const double reach = 0.2 * std::max(box[2] - box[0], box[3] - box[1]) / static_cast<double>(n);
  std::vector<Edit> edits;
  for (int k = 0; k < vertices; ++k) {
    const std::uint32_t v = (first + static_cast<std::uint32_t>(k)) % n;
    const Point at = vertex_at(p, v);
    edits.push_back(
        Edit::move(MovingOperand::p, v, {at.x + reach * random.signed_unit(), at.y + reach * random.signed_unit()}));
  }
  return edits;
}

struct Row {
  std::vector<double> edited, fresh;
  int refused = 0, rebuilt = 0, degenerate = 0, compared = 0, different = 0;
  double making = 0, events = 0;
};

Row measure(const ScalingPair& pair, int vertices, int steps) {
  Row row;
  oracles::Random random(1);
  double begin = processor_ms();
  EditableSum sum = EditableSum::create(pair.p, pair.q).value();
  row.making = processor_ms() - begin;
  while (static_cast<int>(row.edited.size()) < steps && row.refused < 50 * steps) {
    const std::vector<Edit> edits = step_of(random, sum.p(), vertices);
    begin = processor_ms();
    const Result<FrameChanges> made = sum.edit(edits);
    const double ms = processor_ms() - begin;
    if (!made) {
      ++row.refused;
      continue;
    }
    row.edited.push_back(ms);
    row.rebuilt += sum.work().rebuilt;
    row.degenerate += sum.work().degenerate;
    row.events += static_cast<double>(sum.work().events_changed);
    RegionData data = sum.p().data();
    begin = processor_ms();
    const Region p = Region::create(std::move(data)).value();
    const PlanarSum scratch = minkowski_sum(p, pair.q).value();
    row.fresh.push_back(processor_ms() - begin);
    if (row.edited.size() % 20 != 0) continue;
    ++row.compared;
    row.different += !(scratch == sum.sum());
  }
  return row;
}

void write_row(Report& report, const std::string& name, int vertices, const Row& row, std::vector<std::string>& bad) {
  const Spread edited = spread(row.edited), fresh = spread(row.fresh);
  report.row({name, std::to_string(vertices), std::to_string(edited.count), std::to_string(row.refused),
              std::to_string(row.rebuilt) + ", " + std::to_string(row.degenerate),
              fixed(row.events / std::max<double>(1, static_cast<double>(edited.count)), 0), fixed(row.making, 2),
              fixed(fresh.median, 3), fixed(edited.median, 3), fixed(edited.mean, 3), fixed(edited.worst, 3),
              "**" + ratio(fresh.median, edited.median, 1) + "**", "**" + ratio(fresh.mean, edited.mean, 1) + "**",
              std::to_string(row.compared) + ", " + std::to_string(row.different)});
  if (row.different != 0) bad.push_back(name);
}

// P is edited. First those that are promised, with their usual partners.
std::vector<ScalingPair> edited_pairs(const std::string& data) {
  std::vector<ScalingPair> pairs, others = sweep_pairs(data, Snapping::raw);
  const auto find = [&](const std::string& name) -> const ScalingPair& {
    return *std::find_if(others.begin(), others.end(), [&](const ScalingPair& pair) { return pair.name == name; });
  };
  if (!data.empty()) {
    const ScalingPair monkey = find("monkey + bird"), dog = find("dog + bird"), neuron = find("neuron + egg");
    pairs.push_back(monkey);
    pairs.push_back({"neuron + disc 32", neuron.p, shapes::disc(32, 1, shapes::demo_snap(1)), false});
    pairs.push_back({"bird + dog", dog.q, dog.p, false});
  }
  pairs.push_back({"star 200 + star 200", shapes::noisy_star(200, 0.5, 1), shapes::noisy_star(200, 0.5, 2), false});
  for (ScalingPair& pair : others)
    if (pair.name != "star 500 + star 500" && pair.name != "monkey + bird") pairs.push_back(std::move(pair));
  pairs.push_back({"grate 12 + grate 12", shapes::grate(12, 2, 1, 23), shapes::grate(12, 1, 0.5, 12), false});
  return pairs;
}

void table(Report& report, const Options& options, const std::string& data, Kind kind) {
  report.heading({"pair", "vertices", "steps", "refused", "from scratch, result only", "events a step", "making ms",
                  "fresh ms, median", "step ms, median", "mean", "worst", "fresh / step, median", "mean",
                  "compared, different"});
  std::vector<std::string> notes, bad;
  for (const ScalingPair& pair : with_coordinates(edited_pairs(data), kind, notes)) {
    if (pair.name.find(options.only) == std::string::npos) continue;
    for (const int vertices : {1, 10, 100})
      if (static_cast<std::size_t>(vertices) < pair.p.vertex_count())
        write_row(report, pair.name, vertices, measure(pair, vertices, options.steps), bad);
  }
  for (const std::string& note : notes) report.line("\n" + note);
  report.line("");
  report.promise("sums equal those from scratch", std::to_string(bad.size()) + " rows differ", bad.empty());
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--only" && i + 1 < argc) options.only = argv[++i];
    else if (word == "--steps" && i + 1 < argc) options.steps = std::stoi(argv[++i]);
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
        "# Edited sums\n\nWritten by `./run bench edits --results docs/results`. Processor times in milliseconds of "
        "one "
        "thread. A step moves vertices of P that follow one another, each by up to a fifth of the extent over the "
        "number "
        "of vertices along each axis; refused steps are not counted. Fresh: the edited P is made a region and summed "
        "with Q, "
        "which has been summed before. Making: `EditableSum::create`.\n");
    if (kind) report.line("Coordinates: " + name(*kind) + ".\n");
    if (data.empty()) report.line("No data folder (DYMSUM_DATA): the thesis's polygons are left out.\n");
    table(report, options, data, kind);
    write_result(KindOptions::folder(options.results, kind), "edits.md", report.markdown.str());
  }
  return 0;
}

}  // namespace
}  // namespace dymsum::bench

int main(int argc, char** argv) { return dymsum::bench::guarded(dymsum::bench::run, argc, argv); }
