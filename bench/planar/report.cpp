#include "planar/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <sstream>

namespace dymsum::bench {
namespace {

std::string milliseconds(double ms) {
  char text[32];
  if (ms < 1) {
    std::snprintf(text, sizeof text, "%.4f", ms);
  } else {
    std::snprintf(text, sizeof text, ms < 100 ? "%.2f" : "%.0f", ms);
  }
  return text;
}

std::string times(RivalAnswer answer) {
  if (answer.finished) return milliseconds(answer.median_ms);
  if (answer.why_not.rfind("stopped after", 0) == 0) return answer.why_not.replace(0, 14, ">");
  if (answer.why_not.rfind("crashed", 0) == 0) return "crash";
  if (answer.why_not == "cannot take holes") return "holes";
  if (answer.why_not == "not built") return "-";
  return answer.why_not.empty() ? "-" : "failed";
}

std::string ratio_text(double ratio) {
  if (!std::isfinite(ratio)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, ratio < 10 ? "%.1f" : "%.0f", ratio);
  return text;
}

const char* verdict_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::equal:
      return "equal";
    case Verdict::cgal_defect:
      return "CGAL wrong";
    case Verdict::mismatch:
      return "MISMATCH";
    case Verdict::unknown:
      return "no answer";
  }
  return "";
}

double area_error(const Row& row, const RivalAnswer& answer) {
  return std::fabs(answer.area - row.ours.area) / std::fabs(row.ours.area);
}
/// Its time, with a star where its answer differs.
std::string clipper_times(const Row& row, const RivalAnswer& answer) {
  return times(answer) + (answer.finished && !row.agrees(answer) ? "*" : "");
}

double per(double amount, double count) { return count > 0 ? amount / count : 0; }

}  // namespace

void print_heading(std::ostream& out) {
  char line[256];
  std::snprintf(line, sizeof line, "%-32s %9s %8s %6s %5s | %9s %9s | %9s %9s %7s | %8s %8s %8s %8s %8s | %s\n", "pair",
                "corners", "reduced", "sum", "holes", "ours ms", "fresh", "CGAL ms", "(min)", "ratio", "full",
                "bisector", "vertical", "Clipper6", "Clipper2", "check");
  out << line;
}

void print_row(std::ostream& out, const Row& row) {
  char line[320];
  const OurAnswer& ours = row.ours;
  const std::string sizes = std::to_string(row.p_vertices) + "+" + std::to_string(row.q_vertices);
  std::snprintf(line, sizeof line, "%-32s %9s %8llu %6zu %5zu | %9s %9s | %9s %9s %7s | %8s %8s %8s %8s %8s | %s\n",
                row.name.c_str(), sizes.c_str(), static_cast<unsigned long long>(ours.convolution.reduced),
                ours.vertices, ours.holes, milliseconds(ours.median_ms).c_str(), milliseconds(ours.fresh_ms).c_str(),
                times(row.reduced).c_str(), row.reduced.finished ? milliseconds(row.reduced.min_ms).c_str() : "-",
                row.reduced.finished ? ratio_text(row.ratio()).c_str() : "-", times(row.full).c_str(),
                times(row.angle_bisector).c_str(), times(row.vertical).c_str(), times(row.clipper).c_str(),
                times(row.clipper2).c_str(), verdict_text(row.verdict));
  out << line;
  if (!row.remark.empty()) out << "    " << row.remark << "\n";
  for (const auto& [name, answer] : {std::pair{"Clipper 6", &row.clipper}, {"Clipper2", &row.clipper2}}) {
    if (!answer->finished || row.agrees(*answer)) continue;
    std::snprintf(line, sizeof line, "    %s differs: area off by %.1e, %zu holes\n", name, area_error(row, *answer),
                  answer->holes);
    out << line;
  }
}

void print_table(std::ostream& out, Group group, const std::vector<Row>& rows) {
  double ours = 0, cgal = 0, least = INFINITY;
  std::size_t count = 0, equal = 0;
  for (const Row& row : rows) {
    if (row.group != group || !row.reduced.finished) continue;
    ours += row.ours.median_ms;
    cgal += row.reduced.median_ms;
    least = std::min(least, row.ratio());
    equal += row.verdict == Verdict::equal;
    ++count;
  }
  if (count == 0) return;
  char line[256];
  std::snprintf(
      line, sizeof line,
      "%-32s %zu no-fit polygons | ours %s ms each | CGAL %s ms each | ratio of totals %s, least %s | %zu equal\n",
      name(group), count, milliseconds(per(ours, count)).c_str(), milliseconds(per(cgal, count)).c_str(),
      ratio_text(cgal / ours).c_str(), ratio_text(least).c_str(), equal);
  out << line;
}

void print_work_heading(std::ostream& out) {
  char line[256];
  std::snprintf(line, sizeof line, "%-32s %4s %8s %8s %8s %8s %6s %6s | %9s %8s %8s %8s | %s\n", "pair", "tier",
                "reduced", "live", "pairs", "crossing", "loops", "tests", "ms", "ns/seg", "ns/cross", "B/seg",
                "stages, ms");
  out << line;
}

void print_work(std::ostream& out, const Row& row) {
  char line[256];
  const SumStats& stats = row.ours.stats;
  const double segments = static_cast<double>(stats.reduced_segments);
  std::snprintf(line, sizeof line, "%-32s %4d %8.0f %8llu %8llu %8llu %6llu %6llu | %9s %8.0f %8.0f %8.0f |",
                row.name.c_str(), stats.tier_bits, segments, static_cast<unsigned long long>(stats.live_segments),
                static_cast<unsigned long long>(stats.pair_tests), static_cast<unsigned long long>(stats.crossings),
                static_cast<unsigned long long>(stats.loops), static_cast<unsigned long long>(stats.collision_tests),
                milliseconds(row.ours.median_ms).c_str(), 1e6 * per(row.ours.median_ms, segments),
                1e6 * per(row.ours.median_ms, static_cast<double>(stats.crossings)),
                per(static_cast<double>(stats.peak_bytes), segments));
  out << line;
  for (const SumStats::Stage& stage : stats.stages) out << ' ' << stage.name << ' ' << milliseconds(stage.ms);
  out << "\n";
}

std::string to_csv(const std::vector<Row>& rows) {
  std::ostringstream out;
  out.precision(9);
  out << "group,pair,p_vertices,q_vertices,full,kinetic,reduced,tier,vertices,holes,area,ours_median_ms,ours_min_ms,"
         "ours_fresh_ms,ours_runs,cgal_median_ms,cgal_min_ms,cgal_runs,ratio,cgal_full_ms,cgal_bisector_ms,cgal_"
         "vertical_ms,clipper_"
         "ms,clipper2_ms,"
         "live_segments,pair_tests,crossings,loops,collision_tests,peak_bytes,check,remark\n";
  const auto ms = [&](const RivalAnswer& answer) {
    if (answer.finished) out << answer.median_ms;
    out << ',';
  };
  for (const Row& row : rows) {
    const OurAnswer& o = row.ours;
    out << name(row.group) << ",\"" << row.name << "\"," << row.p_vertices << ',' << row.q_vertices << ','
        << o.convolution.full << ',' << o.convolution.kinetic << ',' << o.convolution.reduced << ','
        << o.stats.tier_bits << ',' << o.vertices << ',' << o.holes << ',' << o.area << ',' << o.median_ms << ','
        << o.min_ms << ',' << o.fresh_ms << ',' << o.runs << ',';
    ms(row.reduced);
    if (row.reduced.finished) out << row.reduced.min_ms;
    out << ',' << row.reduced.runs << ',';
    if (row.reduced.finished) out << row.ratio();
    out << ',';
    for (const RivalAnswer* other : {&row.full, &row.angle_bisector, &row.vertical, &row.clipper, &row.clipper2})
      ms(*other);
    out << o.stats.live_segments << ',' << o.stats.pair_tests << ',' << o.stats.crossings << ',' << o.stats.loops << ','
        << o.stats.collision_tests << ',' << o.stats.peak_bytes << ',' << verdict_text(row.verdict) << ",\""
        << row.remark << "\"\n";
  }
  return out.str();
}

std::string to_markdown(const std::vector<Row>& rows) {
  std::ostringstream out;
  out << "# Planar sums against CGAL 5.5.1, Clipper 6 and Clipper2\n\nMade by `./run bench planar --results "
         "docs/results`. Times "
         "are "
         "medians in milliseconds of processor time on one machine, less what reading the clock takes; trust the "
         "ratios.\n\n";
  out << "| promise | measured | |\n|---|---|---|\n";
  for (const Target& target : targets(rows)) {
    out << "| " << target.promise << " | " << target.measured << " | " << (target.met ? "met" : "**NOT met**")
        << " |\n";
  }
  out << "\nRegions keep what sums need of them (walks, direction lists, boxes), as in a table of no-fit polygons; the "
         "medians do not hold "
         "making it. Column *fresh* starts from points: both regions are made and checked in it, and summed once; "
         "CGAL's times hold the sum of "
         "polygons that are there and checks nothing.\n";
  out << "\n## Sizes of the convolutions\n\n";
  for (const std::string& line : thesis_counts(rows)) out << "- " << line << "\n";
  out << "\n## Beside Clipper\n\nBoth sum on a grid of 28 bits; a star below: their holes differ from ours, or their "
         "area "
         "by more than 1e-6.\n\n";
  for (const std::string& line : clipper_lines(rows)) out << "- " << line << "\n";
  Group group = Group::thesis;
  bool first = true;
  for (const Row& row : rows) {
    if (first || row.group != group) {
      out << "\n## " << name(row.group)
          << "\n\n| pair | corners | reduced | sum | holes | ours | fresh | CGAL reduced convolution | "
             "ratio | CGAL full | bisector | vertical | Clipper 6 | Clipper2 | check "
             "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    }
    first = false;
    group = row.group;
    out << "| " << row.name << " | " << row.p_vertices << " + " << row.q_vertices << " | "
        << row.ours.convolution.reduced << " | " << row.ours.vertices << " | " << row.ours.holes << " | "
        << milliseconds(row.ours.median_ms) << " | " << milliseconds(row.ours.fresh_ms) << " | " << times(row.reduced)
        << " | " << (row.reduced.finished ? ratio_text(row.ratio()) : "-") << " | " << times(row.full) << " | "
        << times(row.angle_bisector) << " | " << times(row.vertical) << " | " << clipper_times(row, row.clipper)
        << " | " << clipper_times(row, row.clipper2) << " | " << verdict_text(row.verdict) << " |\n";
  }
  return out.str();
}

}  // namespace dymsum::bench
