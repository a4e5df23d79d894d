// dymsum_bench_growing: the complex of growing discs against CGAL's segment Delaunay graph; frames and barcodes against
// sums from scratch.
#include <cmath>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "coordinate_kinds.h"
#include "dymsum/region_io.h"
#include "dymsum/shapes.h"
#include "growing/diagram.h"
#include "growing/frames.h"
#include "growing/kinds.h"
#include "page.h"
#include "planar/pairs.h"

namespace dymsum::bench {
namespace {

constexpr const char* kUsage =
    "dymsum_bench_growing [--only TEXT] [--long | --off-grid] [--coordinates KIND] [--data DIR] [--results DIR]\n"
    "  --only TEXT    only regions whose name contains TEXT\n"
    "  --long         generated regions up to 100000 vertices\n"
    "  --data DIR     the folder with planar/beetle.poly and others (DYMSUM_DATA)\n"
    "  --results DIR  also write growing.md and growing.csv into DIR\n";

struct Options {
  std::string only, data, results;
  bool extended = false;
  KindOptions coordinates;
};

void add_real(std::vector<std::pair<std::string, Region>>& all, const std::string& data) {
  const std::filesystem::path folder = std::filesystem::path(data) / "planar";
  for (const char* const name : {"beetle", "monkey", "neuron", "dog"}) {
    const std::string file = (folder / (std::string(name) + ".poly")).string();
    if (data.empty() || !std::filesystem::exists(file)) continue;
    const RegionData read = read_region_data(file).value();
    all.emplace_back(name, repair(read).value().region);
  }
}

std::vector<std::pair<std::string, Region>> regions(const Options& options, Kind kind, Report& report) {
  std::vector<std::pair<std::string, Region>> all;
  add_real(all, options.data);
  for (int n = 100; n <= (options.extended ? 100000 : 10000); n *= 10) {
    const int holes = static_cast<int>(std::sqrt(n / 4.0)) * static_cast<int>(std::sqrt(n / 4.0));
    all.emplace_back("star " + std::to_string(n), shapes::noisy_star(n, 0.3, 1));
    all.emplace_back("comb " + std::to_string(n), shapes::comb(n / 4, 2, 1, 3));
    all.emplace_back("grate " + std::to_string(n), shapes::grate(holes, 2, 1, 3));
    all.emplace_back("spiral " + std::to_string(n),
                     shapes::spiral(std::max(1, n / 200), 100, 1, 0.4, shapes::demo_snap(std::max(1, n / 200) + 1.4)));
  }
  std::erase_if(all, [&](auto& named) {
    if (named.first.find(options.only) == std::string::npos) return true;
    const Result<Region> made = with_coordinates(named.second, kind);
    if (!made) report.line(named.first + ": left out: " + made.error().to_string() + "\n");
    else named.second = *made;
    return !made;
  });
  return all;
}

Options parse(int argc, char** argv) {
  Options options;
  options.data = data_folder();
  for (int i = 1; i < argc; ++i) {
    const auto value = [&](const char* flag) -> const char* {
      return std::strcmp(argv[i], flag) == 0 && i + 1 < argc ? argv[++i] : nullptr;
    };
    if (const char* text = value("--only")) options.only = text;
    else if (std::strcmp(argv[i], "--long") == 0) options.extended = true;
    else if (const char* folder = value("--data")) options.data = folder;
    else if (const char* dir = value("--results")) options.results = dir;
    else if (!options.coordinates.take(argc, argv, i)) throw std::invalid_argument(std::string(kUsage) + kKindUsage);
  }
  return options;
}

void run_kind(const Options& options, Kind kind) {
  Report report;
  report.csv << "region,measure,value\n";
  report.line("# Growing discs\n");
  report.line(
      "`./run bench growing --results docs/results` made this page. Medians of wall time.\n\n"
      "## The complex\n\n"
      "Against CGAL's segment Delaunay graph with exact predicates (its filtered traits, doubles as input, spatial "
      "order), which holds both sides of the boundary, decides no order of radii and constructs nothing. Ours: each "
      "side by itself, one thread unless it says otherwise, all discs sorted by radius exactly.\n");
  if (kind) report.line("Coordinates: " + name(*kind) + ".\n");
  const auto all = regions(options, kind, report);
  const auto runs = [](const Region& region) { return region.vertex_count() > 2000 ? 1 : 3; };
  std::vector<DiagramRow> diagrams;
  for (const auto& [name, region] : all) diagrams.push_back(measure_diagram(name, region, runs(region), true));
  report_diagrams(report, diagrams);

  report.line("\n## Frames\n\nSums at 200 radii up to a quarter of the extent, from what is kept and from nothing.\n");
  std::vector<FrameRow> frames;
  for (const auto& [name, region] : all)
    if (region.vertex_count() <= 2000) frames.push_back(measure_frames(name, region, 0.25, 200, 3));
  report_frames(report, frames);

  report.line(
      "\n## Barcodes\n\nAll events and bars of the discs outside, against looking at sums: 400 radii up to a quarter "
      "of "
      "the extent, timed at 8 of them.\n");
  std::vector<BarcodeRow> barcodes;
  for (const auto& [name, region] : all)
    if (region.vertex_count() <= 2000) barcodes.push_back(measure_barcode(name, region, 0.25, 400, 8));
  report_barcodes(report, barcodes);
  const std::string folder = KindOptions::folder(options.results, kind);
  write_result(folder, "growing.md", report.markdown.str());
  write_result(folder, "growing.csv", report.csv.str());
}

int run(int argc, char** argv) {
  const Options options = parse(argc, argv);
  if (!options.coordinates.off_grid)
    for (const Kind& kind : options.coordinates.kinds) run_kind(options, kind);
  const bool all = options.only.empty() && !options.extended && !options.coordinates.chosen();
  return !(options.coordinates.off_grid || all) || measure_kinds(options.results) ? 0 : 3;
}

}  // namespace
}  // namespace dymsum::bench

int main(int argc, char** argv) { return dymsum::bench::guarded(dymsum::bench::run, argc, argv); }
