#include "off_grid.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "page.h"
#include "spread.h"
#include "versus/rival.h"

namespace dymsum::bench {
namespace {

constexpr const char* kPage = "off-the-grid.md";
/// The order of the page's sections.
constexpr std::array<std::string_view, 10> kSuites{"planar", "scaling",       "cspace", "growing", "nesting",
                                                   "solid",  "moving-solids", "convex", "depth",   "python"};
constexpr const char* kOpening =
    "# Off the grid\n\n"
    "Benchmarks like to draw their shapes on a grid, where what is nearly equal is equal. Files hold other "
    "coordinates. "
    "Here every suite measures some of its inputs in five kinds of them, the same shapes each time:\n\n"
    "| kind | coordinates |\n|---|---|\n"
    "| grid | multiples of 2^-20 |\n"
    "| decimals | four decimals, more for shapes smaller than 1 |\n"
    "| single | single precision |\n"
    "| noise | doubles with all their bits; half of the zeros are 6e-17, as the cosine of a right angle is |\n"
    "| turned | turned by 30 degrees, solids about two axes, in doubles |\n\n"
    "*Times the grid* compares with the first row of an input. Off the grid a sum may have more vertices or faces: a "
    "plane face of a box that is turned in doubles is two triangles in planes of their own. So the time for one of "
    "them "
    "is compared, too. Solids are in triangles, convex ones are the hulls of their rounded vertices.\n\n"
    "The machine was not idle. All kinds of an input were measured by turns in one process; times are medians of "
    "processor time of all threads, and *times the grid* is the median of the ratios within a turn: trust the ratios. "
    "All sections: `./run bench off-the-grid --results docs/results`; one of them: "
    "`./run bench SUITE --off-grid --results docs/results`; a whole suite in one kind: "
    "`./run bench SUITE --coordinates KIND`.\n";

struct Measured {
  std::optional<OffGridWork> work;
  std::string why_not;
  std::size_t size = 0;
  std::vector<double> ms, ratios;
  Compared compared;

  double median_ms() const { return quantile(ms, 0.5); }
  double each_ms() const { return size > 0 ? median_ms() / static_cast<double>(size) : 0; }
};

/// Runs until the clock sees it; the mean of the runs.
double timed(Measured& m) {
  constexpr double kLeastMs = 4;
  int runs = 0;
  const double start = cpu_ms();
  double used = 0;
  do {
    m.size = m.work->run();
    ++runs;
    used = cpu_ms() - start;
  } while (used < kLeastMs);
  return std::max(used - clock_ms(), 1e-6) / runs;
}

/// What fails is said in the row.
template <class Step>
void attempt(Measured& m, Step&& step) {
  try {
    step();
  } catch (const std::exception& error) {
    m.work.reset();
    m.why_not = error.what();
  }
}

using Kinds = std::map<Coordinates, Measured>;

Kinds measure(const OffGridCase& input) {
  constexpr int kLeastTurns = 3, kMostTurns = 9;
  constexpr double kEnoughMs = 3000;
  Kinds kinds;
  for (const Coordinates kind : kCoordinates) {
    Measured& m = kinds[kind];
    attempt(m, [&] {
      Result<OffGridWork> work = input.prepare(kind);
      if (!work) throw std::runtime_error(work.error().to_string());
      m.work = *std::move(work);
      m.work->run();  // once before the clock runs: what shapes keep of themselves is there then
    });
  }
  double used = 0;
  for (int turn = 0; turn < kLeastTurns || (turn < kMostTurns && used < kEnoughMs); ++turn) {
    if (used > 10 * kEnoughMs) break;
    double grid = 0;
    for (const Coordinates kind : kCoordinates) {
      Measured& m = kinds[kind];
      if (!m.work) continue;
      attempt(m, [&] {
        m.ms.push_back(timed(m));
        used += m.ms.back();
        if (kind == Coordinates::grid) grid = m.ms.back();
        if (grid > 0) m.ratios.push_back(m.ms.back() / grid);
      });
    }
  }
  for (auto& [kind, m] : kinds)
    if (m.work) attempt(m, [&, &m = m] { m.compared = m.work->compare(); });
  return kinds;
}

std::string three_digits(double v) {
  std::ostringstream text;
  text.precision(3);
  text << std::fixed;
  text.precision(v < 1 ? 3 : v < 10 ? 2 : v < 100 ? 1 : 0);
  text << v;
  return text.str();
}

void add_rows(Report& report, const OffGridPlan& plan, const std::string& input, const Kinds& kinds) {
  const double grid_each = kinds.at(Coordinates::grid).each_ms();
  for (const auto& [kind, m] : kinds) {
    std::vector<std::string> cells{input, name(kind)};
    if (!m.work) {
      cells.push_back("not measured: " + m.why_not);
      cells.resize(plan.opponent.empty() ? 8 : 10);
      report.row(cells);
      continue;
    }
    const double ms = m.median_ms();
    cells.insert(cells.end(), {three_digits(ms), ratio(quantile(m.ratios, 0.5), 1, 2), std::to_string(m.size),
                               three_digits(1e3 * m.each_ms()), ratio(m.each_ms(), grid_each, 2)});
    if (!plan.opponent.empty()) {
      const double theirs = m.compared.rival_ms;
      cells.push_back(theirs > 0 ? three_digits(theirs) : "-");
      cells.push_back(ratio(theirs, ms, 2));
    }
    cells.push_back(m.compared.verdict);
    report.row(cells);
  }
}

/// The largest ratio, and the mean of every kind.
void add_summary(Report& report, const std::vector<std::pair<std::string, Kinds>>& all) {
  double worst = 0;
  std::string where, means;
  for (const Coordinates kind : kCoordinates) {
    if (kind == Coordinates::grid) continue;
    std::vector<double> ratios;
    for (const auto& [input, kinds] : all) {
      const Measured& m = kinds.at(kind);
      if (!m.work || m.ratios.empty()) continue;
      ratios.push_back(quantile(m.ratios, 0.5));
      if (ratios.back() > worst) worst = ratios.back(), where = input + ", " + name(kind);
    }
    means += (means.empty() ? "" : ", ") + name(kind) + " " + fixed(geometric_mean(ratios), 2);
  }
  if (where.empty()) return;
  report.line("\nTimes the grid: at most " + fixed(worst, 2) + " (" + where + "); geometric means: " + means + ".");
}

/// The page's sections by the suite in their headings.
std::map<std::string, std::string> sections_of(const std::string& file) {
  std::ifstream in(file);
  std::map<std::string, std::string> sections;
  std::string suite;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("## ")) suite = line.substr(3);
    if (!suite.empty()) sections[suite] += line + "\n";
  }
  return sections;
}

void put_section(const std::string& folder, const std::string& suite, const std::string& text) {
  std::map<std::string, std::string> sections = sections_of(folder + "/" + kPage);
  sections[suite] = text;
  std::string page = kOpening;
  for (const std::string_view known : kSuites) {
    const auto at = sections.find(std::string(known));
    if (at == sections.end()) continue;
    while (at->second.ends_with("\n\n")) at->second.pop_back();
    page += "\n" + at->second;
  }
  write_result(folder, kPage, page);
}

}  // namespace

bool off_grid_table(const OffGridPlan& plan, const std::vector<OffGridCase>& cases, const std::string& folder) {
  Report report;
  std::cout << "\n# Off the grid\n\n";
  report.line("## " + plan.suite + "\n");
  report.line(plan.title + " " + plan.compared + "\n");
  std::vector<std::string> heading{
      "input", "coordinates", "ms", "times the grid", "result", "us a " + plan.unit, "times the grid"};
  if (!plan.opponent.empty()) heading.insert(heading.end(), {plan.opponent + " ms", "/ ours"});
  heading.push_back("compared");
  report.heading(heading);
  std::vector<std::pair<std::string, Kinds>> all;
  bool right = true;
  for (const OffGridCase& input : cases) {
    std::cerr << input.name << "\n";
    all.emplace_back(input.name, measure(input));
    add_rows(report, plan, input.name, all.back().second);
    for (const auto& [kind, m] : all.back().second) right = right && !m.compared.wrong;
  }
  add_summary(report, all);
  if (!folder.empty()) put_section(folder, plan.suite, report.markdown.str());
  return right;
}

}  // namespace dymsum::bench
