// dymsum_bench_planar: our planar sums measured against CGAL and both Clippers in one process.
#include <algorithm>
#include <iostream>
#include <stdexcept>
#include <string>

#include "coordinate_kinds.h"
#include "page.h"
#include "planar/growth.h"
#include "planar/kinds.h"
#include "planar/report.h"

namespace dymsum::bench {
namespace {

struct Options {
  bool demo = false, ours = false, quick = false, growth = false;
  std::string results, only;
  KindOptions coordinates;
};

constexpr const char* kUsage =
    "dymsum_bench_planar [--demo | --ours | --growth | --off-grid] [--coordinates KIND] [--quick] [--only TEXT]\n"
    "                    [--results DIR]\n"
    "  (default)      all pairs against CGAL's reduced convolution, its other methods where they finish, Clipper 6\n"
    "                 and Clipper2\n"
    "  --demo         a short table, under a minute\n"
    "  --ours         our engine alone, with its work and what a piece of work costs\n"
    "  --growth       our engine alone on ever larger operands; with --results growth.md\n"
    "  --quick        of the rivals, CGAL's reduced convolution only\n"
    "  --only TEXT    only pairs whose name contains TEXT\n"
    "  --results DIR  also write planar.csv, planar.md and the figures into DIR\n"
    "Environment: DYMSUM_DATA, a folder with planar/ and nesting/ (else ../shared/data beside the checkout, where "
    "present).\n";

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--demo") options.demo = true;
    else if (word == "--ours") options.ours = true;
    else if (word == "--growth") options.growth = true;
    else if (word == "--quick") options.quick = true;
    else if (word == "--only" && i + 1 < argc) options.only = argv[++i];
    else if (word == "--results" && i + 1 < argc) options.results = argv[++i];
    else if (!options.coordinates.take(argc, argv, i)) throw std::invalid_argument(std::string(kUsage) + kKindUsage);
  }
  return options;
}

/// Seconds for each of the rivals other than CGAL's reduced convolution. The many small pairs get little: where the
/// full convolution or a decomposition needs longer than that, it is not in the running.
double others_limit_s(const Pair& pair, const Options& options) {
  if (options.ours || options.quick) return 0;
  if (options.demo) return 1;
  if (pair.group == Group::swim || pair.group == Group::shirts) return 0;
  if (pair.group == Group::thesis) return pair.p.vertex_count() * pair.q.vertex_count() <= 4000 ? 2 : 0;
  return 10;
}

bool is_table(Group group) { return group == Group::swim || group == Group::shirts; }

/// The pairs in coordinates of a kind; 3 where an answer is wrong, 2 where the pages cannot be written.
int run_kind(const Options& options, Kind kind) {
  const std::string data = data_folder(), folder = KindOptions::folder(options.results, kind);
  Pairs pairs = options.demo ? demo_pairs(data) : all_pairs(data);
  set_coordinates(pairs, kind);
  if (kind) std::cout << "\nCoordinates: " << name(*kind) << "\n";
  for (const std::string& note : pairs.notes) std::cout << note << "\n";
  std::cout << "Times: median (and least) processor time in milliseconds; inputs are built before the clock starts, "
               "but in \"fresh\": our regions "
               "from points,\nwith all checks, and one sum. CGAL: 5.5.1,\nreduced convolution with EPECK, unless "
               "another column. Ratio: CGAL / ours. Check: holes, "
               "vertices, area.\n\n";
  if (options.ours) print_work_heading(std::cout);
  else print_heading(std::cout);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < pairs.list.size(); ++i) {
    const Pair& pair = pairs.list[i];
    if (pair.name.find(options.only) == std::string::npos) continue;
    std::cerr << "[" << i + 1 << "/" << pairs.list.size() << "] " << pair.name << "\n";
    rows.push_back(measure_pair(pair, {!options.ours, others_limit_s(pair, options)}));
    const Row& row = rows.back();
    if (options.ours) {
      if (!is_table(row.group)) print_work(std::cout, row);
    } else if (!is_table(row.group) || (row.verdict != Verdict::equal && row.verdict != Verdict::unknown)) {
      print_row(std::cout, row);
    }
    std::cout.flush();
  }
  if (!options.ours) {
    for (const Group group : {Group::swim, Group::shirts}) print_table(std::cout, group, rows);
    print_summary(std::cout, rows);
    if (options.demo || !options.only.empty()) {
      std::cout << "\nThe promises are measured over all pairs: ./run bench planar\n";
    } else {
      print_promises(std::cout, rows);
    }
  }
  if (!folder.empty() && !write_results(folder, rows)) {
    std::cerr << "cannot write into " << folder << "\n";
    return 2;
  }
  const bool mismatch =
      std::any_of(rows.begin(), rows.end(), [](const Row& r) { return r.verdict == Verdict::mismatch; });
  return mismatch ? 3 : 0;
}

int run(int argc, char** argv) {
  const Options options = parse(argc, argv);
  int code = 0;
  if (!options.coordinates.off_grid)
    for (const Kind& kind : options.coordinates.kinds) {
      if (!options.growth) {
        code = std::max(code, run_kind(options, kind));
      } else if (!measure_growth(8000, kind, KindOptions::folder(options.results, kind), std::cout)) {
        std::cerr << "cannot write into " << options.results << "\n";
        return 2;
      }
    }
  const bool all = !options.demo && !options.ours && !options.growth && options.only.empty();
  if (options.coordinates.off_grid || (all && !options.coordinates.chosen()))
    code = std::max(code, measure_kinds(options.results) ? 0 : 3);
  return code;
}

}  // namespace
}  // namespace dymsum::bench

int main(int argc, char** argv) { return dymsum::bench::guarded(dymsum::bench::run, argc, argv); }
