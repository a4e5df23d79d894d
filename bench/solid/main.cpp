// dymsum_bench_solid: sums of solids of any shape, against CGAL's Nef polyhedra and Manifold.
#include <cmath>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <stdexcept>

#include "coordinate_kinds.h"
#include "page.h"
#include "solid/kinds.h"
#include "solid/measure.h"
#include "spread.h"

namespace dymsum::bench {
namespace {

constexpr const char* kUsage =
    "dymsum_bench_solid [--ours | --growth | --off-grid] [--coordinates KIND] [--minutes N] [--only TEXT]\n"
    "                   [--results DIR]\n"
    "  (default)      all pairs, against CGAL's Nef polyhedra and Manifold\n"
    "  --ours         ours alone\n"
    "  --growth       ours alone on tori and blobs of 250 to 20,000 triangles each\n"
    "  --minutes N    at most that long for each answer of the others (default 1)\n"
    "  --only TEXT    only pairs whose name contains TEXT\n"
    "  --results DIR  also write solid.md and solid.csv (with --growth solid-growth.md) into DIR\n"
    "Environment: DYMSUM_DATA, a folder with solid/ (else ../shared/data beside the checkout, where present);\n"
    "DYMSUM_PYTHON, an interpreter that has manifold3d (`./run bench solid` makes one).\n";

struct Options {
  bool ours = false, growth = false;
  double minutes = 1;
  std::string only, results;
  KindOptions coordinates;
};

std::string number(double v) { return fixed(v, v < 10 ? 2 : v < 100 ? 1 : 0); }

std::string same_volume(const RivalAnswer& theirs, const Ours& ours) {
  return std::abs(theirs.area - ours.volume) <= 1e-6 * std::abs(ours.volume) ? "same"
                                                                             : "differs: " + fixed(theirs.area, 3);
}
std::string time_of(const RivalAnswer& theirs) {
  return theirs.finished ? number(theirs.median_ms) : theirs.why_not.empty() ? "-" : theirs.why_not;
}
std::string ratio(const RivalAnswer& theirs, const Ours& ours) {
  return theirs.finished ? number(theirs.median_ms / quantile(ours.ms, 0.5)) : "-";
}

void table(const std::vector<SolidRow>& rows, bool rivals, Report& report) {
  report.line("\n## Ours: time and memory\n");
  report.line(
      "Milliseconds of the wall clock from two valid meshes to the exact sum: median, 99th percentile, worst. `best "
      "published`: the best research code's on this class of machine, on inputs perturbed. Memory: the process's peak "
      "over what it had before; of this the result; and what the peak has beside the result, per facet of the reduced "
      "convolution. Reading: validation of both meshes; writing: rounding, checking and "
      "formatting the triangles.\n");
  report.line(
      "| pair | triangles | median ms | p99 | worst | two threads ms | gain | limit | best published / ours | MB | "
      "result MB | bytes a facet beside it | reading ms | writing ms | faces | tight |");
  report.line("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
  for (const SolidRow& r : rows) {
    const Ours& o = r.ours;
    if (!o.wrong.empty()) {
      report.line("| " + r.name + " | " + o.wrong + " |");
      continue;
    }
    const double ms = quantile(o.ms, 0.5), two = quantile(o.two_threads_ms, 0.5);
    const double facets = static_cast<double>(o.stats.face_vertex + o.stats.edge_edge);
    report.line("| " + r.name + " | " + std::to_string(r.p_triangles) + ", " + std::to_string(r.q_triangles) + " | " +
                number(ms) + " | " + number(quantile(o.ms, 0.99)) + " | " + number(quantile(o.ms, 1)) + " | " +
                number(two) + " | " + number(ms / two) + " | " +
                (r.limit_ms > 0 ? number(r.limit_ms) + (ms <= r.limit_ms ? " met" : " NOT met") : "-") + " | " +
                (r.published_ms > 0 ? number(r.published_ms / ms) : "-") + " | " + fixed(o.peak_bytes / 1e6, 1) +
                " | " + fixed(o.result_bytes / 1e6, 1) + " | " +
                fixed(facets > 0 ? (o.peak_bytes - o.result_bytes) / facets : 0, 0) + " | " + number(o.validate_ms) +
                " | " + number(o.round_ms) + " | " + std::to_string(o.faces) + " | " + std::to_string(o.tight) + " |");
  }
  report.line("\n## Ours: work\n");
  report.line(
      "| pair | full convolution fv, ee | reduced fv (predicted) | ee (predicted) | deep inside | contacts | points | "
      "cells | tests: collision, tight | exact signs | ns a contact | stages ms |");
  report.line("|---|---|---|---|---|---|---|---|---|---|---|---|");
  for (const SolidRow& r : rows) {
    const Ours& o = r.ours;
    if (!o.wrong.empty()) continue;
    std::string stages;
    for (const auto& s : o.stats.stages)
      stages += (stages.empty() ? "" : ", ") + std::string(s.name) + " " + number(s.ms);
    report.line("| " + r.name + " | " + std::to_string(o.predicted.full_face_vertex) + ", " +
                std::to_string(o.predicted.full_edge_edge) + " | " + std::to_string(o.stats.face_vertex) + " (" +
                fixed(o.predicted.face_vertex, 0) + ") | " + std::to_string(o.stats.edge_edge) + " (" +
                fixed(o.predicted.edge_edge, 0) + ") | " + std::to_string(o.stats.inner_facets) + " | " +
                std::to_string(o.stats.contacts) + " | " + std::to_string(o.stats.points) + " | " +
                std::to_string(o.stats.cells) + " | " + std::to_string(o.stats.collision_tests) + ", " +
                std::to_string(o.stats.tight_tests) + " | " + std::to_string(o.stats.exact_signs) + " | " +
                fixed(o.stats.contacts > 0 ? 1e6 * quantile(o.ms, 0.5) / static_cast<double>(o.stats.contacts) : 0, 0) +
                " | " + stages + " |");
  }
  if (!rivals) return;
  report.line("\n## Beside CGAL and Manifold\n");
  report.line(
      "Processor time in ms of CGAL 5.5 `minkowski_sum_3` (EPECK, from Nef polyhedra) and of Manifold's "
      "`minkowski_sum` "
      "through Python: with both operands moved until the origin lies inside, and as they stand. Volumes are compared "
      "to 1e-6.\n");
  report.line(
      "| pair | ours ms | CGAL ms | / ours | volume | Manifold ms | / ours | volume | Manifold as it stands: volume |");
  report.line("|---|---|---|---|---|---|---|---|---|");
  for (const SolidRow& r : rows) {
    if (!r.ours.wrong.empty()) continue;
    const auto verdict = [&](const RivalAnswer& a) { return a.finished ? same_volume(a, r.ours) : std::string("-"); };
    report.line("| " + r.name + " | " + number(quantile(r.ours.ms, 0.5)) + " | " + time_of(r.cgal) + " | " +
                ratio(r.cgal, r.ours) + " | " + verdict(r.cgal) + " | " + time_of(r.manifold) + " | " +
                ratio(r.manifold, r.ours) + " | " + verdict(r.manifold) + " | " + verdict(r.unguarded) + " |");
  }
}

/// Geometric mean, median and least of a ratio over the pairs that have it.
void summary(const std::vector<SolidRow>& rows, Report& report) {
  const auto one = [&](const std::string& what, auto value) {
    std::vector<double> all;
    for (const SolidRow& r : rows)
      if (const double v = value(r); r.ours.wrong.empty() && v > 0) all.push_back(v);
    if (all.empty()) return;
    report.line("- " + what + ": geometric mean " + number(geometric_mean(all)) + ", median " +
                number(quantile(all, 0.5)) + ", least " + number(quantile(all, 0)) + ", of " +
                std::to_string(all.size()) + " pairs");
  };
  report.line("\n## Ratios\n");
  one("CGAL / ours",
      [](const SolidRow& r) { return r.cgal.finished ? r.cgal.median_ms / quantile(r.ours.ms, 0.5) : 0; });
  one("Manifold / ours",
      [](const SolidRow& r) { return r.manifold.finished ? r.manifold.median_ms / quantile(r.ours.ms, 0.5) : 0; });
  one("best published / ours", [](const SolidRow& r) { return r.published_ms / quantile(r.ours.ms, 0.5); });
  one("one thread / two threads",
      [](const SolidRow& r) { return quantile(r.ours.ms, 0.5) / quantile(r.ours.two_threads_ms, 0.5); });
}

void add_csv(const SolidRow& r, Report& report) {
  const Ours& o = r.ours;
  report.csv << '"' << r.name << "\"," << r.group << ',' << r.p_triangles << ',' << r.q_triangles << ','
             << quantile(o.ms, 0.5) << ',' << quantile(o.ms, 0.99) << ',' << quantile(o.ms, 1) << ','
             << quantile(o.two_threads_ms, 0.5) << ',' << o.peak_bytes << ',' << o.result_bytes << ',' << o.validate_ms
             << ',' << o.round_ms << ',' << o.stats.face_vertex << ',' << o.stats.edge_edge << ','
             << o.predicted.face_vertex << ',' << o.predicted.edge_edge << ',' << o.stats.inner_facets << ','
             << o.stats.contacts << ',' << o.stats.points << ',' << o.stats.cells << ',' << o.faces << ',' << o.tight
             << ',' << std::setprecision(12) << o.volume << ',' << (r.cgal.finished ? r.cgal.median_ms : 0) << ','
             << r.cgal.area << ',' << (r.manifold.finished ? r.manifold.median_ms : 0) << ',' << r.manifold.area << ','
             << r.unguarded.area << std::setprecision(6) << '\n';
}

constexpr const char* kColumns =
    "pair,group,p_triangles,q_triangles,ms,p99_ms,worst_ms,two_threads_ms,peak_bytes,result_bytes,validate_ms,round_ms,"
    "face_vertex,"
    "edge_edge,predicted_face_vertex,predicted_edge_edge,inner_facets,contacts,points,cells,faces,tight,volume,cgal_ms,"
    "cgal_volume,manifold_ms,manifold_volume,manifold_unguarded_volume\n";

void growth(Kind kind, Report& report) {
  report.line("# Growth of sums of solids\n");
  report.line(
      "`./run bench solid --growth --results docs/results` made this page. One thread, best of the runs; memory "
      "is the process's peak, result included.\n");
  if (kind) report.line("Coordinates: " + name(*kind) + ".\n");
  report.line("| operands | triangles each | ms | facets | contacts | MB | exponent of time | of memory |");
  report.line("|---|---|---|---|---|---|---|---|");
  for (const bool blobs : {false, true}) {
    double n0 = 0, ms0 = 0, bytes0 = 0;
    for (const int n : {250, 500, 1000, 2500, 5000, 10000, 20000}) {
      std::vector<std::string> notes;
      const std::vector<SolidPair> made = with_coordinates({growth_pair(blobs, n)}, kind, notes);
      for (const std::string& note : notes) report.line("| " + note + " |");
      if (made.empty()) continue;
      const SolidPair& pair = made.front();
      const Ours o = measure_ours(pair, 300);
      if (!o.wrong.empty()) {
        report.line("| " + pair.name + " | " + o.wrong + " |");
        continue;
      }
      const auto size = static_cast<double>(pair.p.faces.size());
      const double ms = quantile(o.ms, 0);
      const auto exponent = [&](double now, double before) {
        return n0 > 0 ? fixed(std::log(now / before) / std::log(size / n0), 2) : std::string();
      };
      report.line("| " + std::string(blobs ? "blobs" : "tori") + " | " + fixed(size, 0) + " | " + number(ms) + " | " +
                  std::to_string(o.stats.face_vertex + o.stats.edge_edge) + " | " + std::to_string(o.stats.contacts) +
                  " | " + fixed(o.peak_bytes / 1e6, 1) + " | " + exponent(ms, ms0) + " | " +
                  exponent(o.peak_bytes, bytes0) + " |");
      n0 = size, ms0 = ms, bytes0 = o.peak_bytes;
    }
  }
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--ours") options.ours = true;
    else if (word == "--growth") options.growth = true;
    else if (word == "--minutes" && i + 1 < argc) options.minutes = std::stod(argv[++i]);
    else if (word == "--only" && i + 1 < argc) options.only = argv[++i];
    else if (word == "--results" && i + 1 < argc) options.results = argv[++i];
    else if (!options.coordinates.take(argc, argv, i)) throw std::invalid_argument(std::string(kUsage) + kKindUsage);
  }
  return options;
}

std::string environment(const char* name, const std::string& otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : otherwise;
}

void run_kind(const Options& options, Kind kind) {
  Report report;
  const auto write = [&](const std::string& name, const std::string& text) {
    write_result(KindOptions::folder(options.results, kind), name, text);
  };
  if (options.growth) {
    growth(kind, report);
    write("solid-growth.md", report.markdown.str());
    return;
  }
  SolidProtocol protocol;
  protocol.limit_s = options.ours ? 0 : 60 * options.minutes;
  std::vector<SolidRow> rows;
  std::vector<std::string> notes;
  report.csv << kColumns;
  std::vector<SolidPair> pairs =
      solid_pairs(environment("DYMSUM_DATA", std::string(DYMSUM_SOURCE_DIR) + "/../shared/data"));
  std::erase_if(pairs, [&](const SolidPair& pair) { return pair.name.find(options.only) == std::string::npos; });
  for (const SolidPair& pair : with_coordinates(std::move(pairs), kind, notes)) {
    std::cerr << pair.name << "\n";
    rows.push_back(measure_pair(pair, protocol));
    add_csv(rows.back(), report);
  }
  report.line("# Sums of solids of any shape\n");
  report.line("`./run bench solid --results docs/results` made this page.");
  if (kind) report.line("\nCoordinates: " + name(*kind) + ".");
  for (const std::string& note : notes) report.line("\n" + note);
  table(rows, !options.ours, report);
  summary(rows, report);
  write("solid.md", report.markdown.str());
  write("solid.csv", report.csv.str());
}

int run(int argc, char** argv) {
  const Options options = parse(argc, argv);
  if (!options.coordinates.off_grid)
    for (const Kind& kind : options.coordinates.kinds) run_kind(options, kind);
  const bool all = !options.growth && options.only.empty() && !options.coordinates.chosen();
  return !(options.coordinates.off_grid || all) || measure_kinds(options.results) ? 0 : 3;
}

}  // namespace
}  // namespace dymsum::bench

int main(int argc, char** argv) { return dymsum::bench::guarded(dymsum::bench::run, argc, argv); }
