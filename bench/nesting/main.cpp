// dymsum_bench_nesting: whole tables of no-fit polygons of nesting instances against CGAL's sums of the same pairs.
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "coordinate_kinds.h"
#include "dymsum/cspace_obstacle.h"
#include "dymsum/nesting.h"
#include "dymsum/nfp_table.h"
#include "dymsum/shapes.h"
#include "nesting/against_cgal.h"
#include "nesting/kinds.h"
#include "page.h"
#include "planar/pairs.h"
#include "thesis/thesis_shapes.h"
#include "versus/rival.h"

namespace dymsum::bench {
namespace {

constexpr const char* kUsage =
    "dymsum_bench_nesting [--off-grid] [--coordinates KIND] [--only TEXT] [--orientations N] [--data DIR]\n"
    "                     [--results DIR]\n"
    "  --only TEXT       only instances whose name contains TEXT\n"
    "  --orientations N  equally spaced ones [8]\n"
    "  --data DIR        the folder with nesting/swim.json and others (DYMSUM_DATA)\n"
    "  --results DIR     also write nesting.md and nesting.csv into DIR\n";

struct Options {
  std::string only, data, results;
  int orientations = 8;
  KindOptions coordinates;
};

struct Instance {
  std::string name;
  TableInput input;
};

TableInput input_of(const NestingInstance& instance, const std::vector<Rational>& degrees) {
  TableInput input;
  for (const NestingItem& item : instance.items)
    input.items.push_back({item.name, repair(item.shape).value().region, degrees});
  return input;
}

std::vector<Instance> instances(const Options& options) {
  std::vector<Rational> degrees;
  for (int k = 0; k < options.orientations; ++k) degrees.push_back(Rational::of(360 * k, options.orientations).value());
  std::vector<Instance> all;
  const std::filesystem::path folder = std::filesystem::path(options.data) / "nesting";
  for (const char* const name : {"swim", "shirts", "trousers"}) {
    const std::string file = (folder / (std::string(name) + ".json")).string();
    if (!options.data.empty() && std::filesystem::exists(file))
      all.push_back({name, input_of(read_nesting_instance(file).value(), degrees)});
  }
  Instance made{"generated", {}};
  for (const shapes::Named& shape : shapes::thesis_like_set())
    if (shape.region.vertex_count() < 100) made.input.items.push_back({std::string(shape.name), shape.region, degrees});
  all.push_back(std::move(made));
  return all;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The best of some runs of whole tables.
double table_ms(const NfpTable& table, int threads, bool processor_time) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 25; ++k) {
    const double cpu = cpu_ms();
    const auto start = std::chrono::steady_clock::now();
    TableOptions options;
    options.threads = threads;
    const TableResult result = compute_table(table, options).value();
    best = std::min(best, processor_time ? cpu_ms() - cpu : 1e3 * seconds_since(start));
  }
  return best;
}

/// The exact sums behind a table, each as the table computes it: quarter turns of regions that were turned before, one
/// of each mirrored pair.
class ExactSums {
 public:
  explicit ExactSums(const NfpTable& table) : table_(table) {
    for (const TableRow& row : table.rows()) {
      const double degrees = table.angles()[row.angle].degrees.to_double();
      const bool quarter = std::fmod(degrees, 90) == 0;
      const double mirrored = degrees == 0 ? 0 : 360 - degrees;
      const auto rank = std::tuple{row.fixed, row.moving, degrees}, other = std::tuple{row.moving, row.fixed, mirrored};
      if (quarter && other < rank) continue;
      rows_.push_back(&row);
      turned_.push_back(quarter ? turned(table.input().items[row.moving].shape, static_cast<int>(degrees) / 90)
                                : std::optional<Region>());
    }
  }
  std::size_t count() const { return rows_.size(); }

  double best_ms() const {
    double best = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 5; ++k) {
      const double start = cpu_ms();
      std::size_t vertices = 0;
      for (std::size_t i = 0; i < rows_.size(); ++i) vertices += sum(i).vertex_count();
      best = std::min(best, cpu_ms() - start);
      if (vertices == 0) throw std::logic_error("sums without vertices");
    }
    return best;
  }

 private:
  static Region turned(const Region& shape, int quarters) {
    RegionData data = shape.data();
    const auto turn = [quarters](std::vector<Point>& points) {
      for (int k = 0; k < quarters; ++k)
        for (Point& p : points) p = {-p.y, p.x};
    };
    for (Part& part : data.parts) {
      turn(part.outer);
      for (Ring& hole : part.holes) turn(hole);
    }
    return Region::create(std::move(data)).value();
  }
  PlanarSum sum(std::size_t i) const {
    const TableRow& row = *rows_[i];
    const Region& fixed = table_.input().items[row.fixed].shape;
    if (turned_[i]) return nfp(fixed, *turned_[i]).value();
    return cspace_slice(table_.input().items[row.moving].shape, fixed, table_.angles()[row.angle].orientation).value();
  }

  const NfpTable& table_;
  std::vector<const TableRow*> rows_;
  std::vector<std::optional<Region>> turned_;
};

void measure_instance(Report& report, const Instance& instance) {
  const NfpTable table = NfpTable::create(instance.input).value();
  const double one_cpu = table_ms(table, 1, true), one = table_ms(table, 1, false), two = table_ms(table, 2, false);
  const ExactSums sums(table);
  const double sums_ms = sums.best_ms();
  const Rivalry rivalry = against_cgal(table);
  report.row({instance.name, std::to_string(instance.input.items.size()), std::to_string(table.rows().size()),
              std::to_string(table.task_count()), fixed(rivalry.cgal_ms, 1), fixed(one_cpu, 1),
              ratio(rivalry.cgal_ms, one_cpu, 1), fixed(sums_ms, 1), ratio(rivalry.cgal_ms, sums_ms, 1),
              ratio(one, two, 2), std::to_string(rivalry.equal) + " of " + std::to_string(rivalry.rows),
              std::to_string(rivalry.witnessed)});
  for (const auto& [measure, value] : {std::pair{"cgal_ms", rivalry.cgal_ms}, std::pair{"table_ms", one_cpu},
                                       std::pair{"sums_ms", sums_ms}, std::pair{"two_threads", one / two}})
    report.csv << instance.name << ',' << measure << ',' << value << '\n';
}

Options parse(int argc, char** argv) {
  Options options;
  options.data = data_folder();
  for (int i = 1; i < argc; ++i) {
    const auto value = [&](const char* flag) -> const char* {
      return std::strcmp(argv[i], flag) == 0 && i + 1 < argc ? argv[++i] : nullptr;
    };
    if (const char* text = value("--only")) options.only = text;
    else if (const char* count = value("--orientations")) options.orientations = std::max(1, std::atoi(count));
    else if (const char* folder = value("--data")) options.data = folder;
    else if (const char* dir = value("--results")) options.results = dir;
    else if (!options.coordinates.take(argc, argv, i)) throw std::invalid_argument(std::string(kUsage) + kKindUsage);
  }
  return options;
}

/// An item that rounding spoils is left out.
void set_coordinates(Instance& instance, Kind kind, Report& report) {
  std::erase_if(instance.input.items, [&](TableItem& item) {
    const Result<Region> made = with_coordinates(item.shape, kind);
    if (made) item.shape = *made;
    else report.row({instance.name, item.name + " left out: " + made.error().to_string()});
    return !made;
  });
}

void run_kind(const Options& options, Kind kind) {
  Report report;
  report.line("# Tables of no-fit polygons\n");
  report.line(
      "`./run bench nesting --results docs/results` made this page. All ordered pairs of items at " +
      std::to_string(options.orientations) +
      " relative angles. Processor time, but for the gain of two threads, which is of wall time. CGAL: reduced "
      "convolution with its exact kernel, one sum a row, operands made before the clock starts, results not rounded. "
      "Table: the whole of "
      "`compute_table`, rounded to doubles and as well-known binary, with mirrored rows made of one another. "
      "Sums: the exact sums of the tasks alone, not rounded either.\nCompared: parts, holes, vertices and area; where "
      "they differ, how "
      "often CGAL's vertical decomposition says what we say.\n");
  if (kind) report.line("Coordinates: " + name(*kind) + ".\n");
  report.heading({"instance", "items", "rows", "tasks", "CGAL ms", "table ms", "CGAL / table", "sums ms", "CGAL / sums",
                  "two threads", "equal", "differ, witnessed"});
  report.csv << "instance,measure,value\n";
  std::vector<Instance> all = instances(options);
  for (Instance& instance : all) {
    if (instance.name.find(options.only) == std::string::npos) continue;
    set_coordinates(instance, kind, report);
    measure_instance(report, instance);
  }
  const std::string folder = KindOptions::folder(options.results, kind);
  write_result(folder, "nesting.md", report.markdown.str());
  write_result(folder, "nesting.csv", report.csv.str());
}

int run(int argc, char** argv) {
  const Options options = parse(argc, argv);
  if (!options.coordinates.off_grid)
    for (const Kind& kind : options.coordinates.kinds) run_kind(options, kind);
  const bool all = options.only.empty() && !options.coordinates.chosen();
  return !(options.coordinates.off_grid || all) || measure_kinds(options.results) ? 0 : 3;
}

}  // namespace
}  // namespace dymsum::bench

int main(int argc, char** argv) { return dymsum::bench::guarded(dymsum::bench::run, argc, argv); }
