// The promises about speed and memory, and the thesis's own numbers.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "planar/report.h"
#include "spread.h"

namespace dymsum::bench {
namespace {

template <class Number>
std::string text(const char* format, Number a, double b = 0) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, static_cast<double>(a), b);
  return buffer;
}

const Row* find(const std::vector<Row>& rows, const std::string& name) {
  for (const Row& row : rows) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

double geometric_mean(const std::vector<Row>& rows, double (Row::*ratio)() const, const Group* group = nullptr) {
  std::vector<double> ratios;
  for (const Row& row : rows)
    if (row.reduced.finished && (group == nullptr || row.group == *group)) ratios.push_back((row.*ratio)());
  return bench::geometric_mean(ratios);
}

template <class Value, class Counts>
const Row* least(const std::vector<Row>& rows, Value&& value, Counts&& counts) {
  const Row* best = nullptr;
  for (const Row& row : rows) {
    if (counts(row) && (best == nullptr || value(row) < value(*best))) best = &row;
  }
  return best;
}

void add_ratio_of(std::vector<Target>& list, const std::vector<Row>& rows, const std::string& pair, double promised) {
  const Row* row = find(rows, pair);
  if (row == nullptr || !row->reduced.finished) return;
  list.push_back({pair + ": at least " + text("%.0f times CGAL's reduced convolution", promised),
                  text("%.0f times", row->ratio()), row->ratio() >= promised});
}

}  // namespace

std::vector<Target> targets(const std::vector<Row>& rows) {
  std::vector<Target> list;
  const auto measured = [](const Row& row) { return row.reduced.finished; };
  const auto ratio = [](const Row& row) { return row.ratio(); };

  const double mean = geometric_mean(rows, &Row::ratio);
  list.push_back({"geometric mean over all pairs, regions prepared: at least 100 times CGAL's reduced convolution",
                  text("%.0f times", mean), mean >= 100});
  const double fresh = geometric_mean(rows, &Row::fresh_ratio);
  list.push_back(
      {"geometric mean over all pairs, from points: at least 40 times", text("%.0f times", fresh), fresh >= 40});
  if (const Row* row = least(rows, ratio, [&](const Row& r) { return measured(r) && r.ours.vertices > 20; })) {
    list.push_back({"every pair with more than 20 vertices in the sum: at least 25 times",
                    text("least %.1f times, ", row->ratio()) + row->name, row->ratio() >= 25});
  }
  if (const Row* row =
          least(rows, ratio, [&](const Row& r) { return measured(r) && r.p_vertices + r.q_vertices > 20; })) {
    list.push_back({"every pair with more than 20 vertices together: at least 25 times",
                    text("least %.1f times, ", row->ratio()) + row->name, row->ratio() >= 25});
  }
  const auto slower =
      std::count_if(rows.begin(), rows.end(), [&](const Row& r) { return measured(r) && r.ratio() < 1; });
  list.push_back({"no pair slower than CGAL, regions prepared", text("%.0f slower", slower), slower == 0});
  const auto fresh_ratio = [](const Row& row) { return row.fresh_ratio(); };
  if (const Row* row = least(rows, fresh_ratio, measured)) {
    list.push_back({"no pair slower than CGAL, from points", text("least %.1f times, ", row->fresh_ratio()) + row->name,
                    row->fresh_ratio() >= 1});
  }
  add_ratio_of(list, rows, "monkey + bird", 100);
  add_ratio_of(list, rows, "neuron + disc 32", 100);
  add_ratio_of(list, rows, "star 200 + star 200, noise 0.9", 1000);
  if (const Row* row = least(rows, ratio, [&](const Row& r) { return measured(r) && r.group == Group::swim; })) {
    list.push_back({"every swim no-fit polygon: at most 1/50 of CGAL's time",
                    text("least %.1f times, ", row->ratio()) + row->name, row->ratio() >= 50});
  }
  const auto fewer_bytes = [](const Row& r) {
    return -static_cast<double>(r.ours.stats.peak_bytes) / static_cast<double>(r.ours.stats.reduced_segments);
  };
  const auto big = [](const Row& r) { return r.ours.stats.reduced_segments >= 1000 && r.ours.stats.peak_bytes > 0; };
  if (const Row* row = least(rows, fewer_bytes, big)) {
    list.push_back({"peak memory at most 120 bytes per reduced segment (sums of 1000 segments or more)",
                    text("most %.0f bytes, ", -fewer_bytes(*row)) + row->name, -fewer_bytes(*row) <= 120});
  }
  const auto wrong =
      std::count_if(rows.begin(), rows.end(), [](const Row& r) { return r.verdict == Verdict::mismatch; });
  const auto defects =
      std::count_if(rows.begin(), rows.end(), [](const Row& r) { return r.verdict == Verdict::cgal_defect; });
  list.push_back({"same holes, vertices and area as CGAL",
                  text("%.0f differ; %.0f more where CGAL contradicts itself", wrong, static_cast<double>(defects)),
                  wrong == 0});
  return list;
}

std::vector<std::string> thesis_counts(const std::vector<Row>& rows) {
  struct Printed {
    const char* pair;
    double reduced, full;  // full 0: not printed
  };
  std::vector<std::string> lines;
  for (const Printed& printed : {Printed{"neuron + small disc 32", 3196, 0}, Printed{"monkey + bird", 16425, 0},
                                 Printed{"dog + bird (real)", 2921, 38342}, Printed{"star + star (real)", 382, 1608}}) {
    const Row* row = find(rows, printed.pair);
    if (row == nullptr) continue;
    const double reduced = static_cast<double>(row->ours.convolution.reduced);
    const double full = static_cast<double>(row->ours.convolution.full);
    std::string line = std::string(printed.pair) + text(": %.0f reduced of %.0f full segments; ", reduced, full) +
                       text("the thesis prints %.0f", printed.reduced);
    if (printed.full > 0) line += text(" of %.0f", printed.full);
    line += text(" (reduced %+.2f %%", 100 * (reduced / printed.reduced - 1));
    if (printed.full > 0) line += text(", full %+.2f %%", 100 * (full / printed.full - 1));
    line += ")";
    if (row->p_corners + row->q_corners != row->p_vertices + row->q_vertices) {
      line += text("; ours drop collinear vertices first, %.0f of the first", row->p_vertices - row->p_corners) +
              text(" and %.0f of the second operand", row->q_vertices - row->q_corners);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<std::string> clipper_lines(const std::vector<Row>& rows) {
  std::vector<std::string> lines;
  for (const auto& [name, answer] : {std::pair{"Clipper 6", &Row::clipper}, {"Clipper2", &Row::clipper2}}) {
    std::vector<double> ratios;
    std::size_t slower = 0, different = 0;
    for (const Row& row : rows) {
      if (!(row.*answer).finished) continue;
      ratios.push_back((row.*answer).median_ms / row.ours.median_ms);
      slower += ratios.back() < 1;
      different += !row.agrees(row.*answer);
    }
    if (ratios.empty()) continue;
    lines.push_back(std::string(name) +
                    text(" / ours: geometric mean %.0f, least %.1f", geometric_mean(ratios), quantile(ratios, 0)) +
                    text(", of %.0f pairs; ours slower on %.0f", ratios.size(), static_cast<double>(slower)) +
                    text("; another answer on %.0f", different));
  }
  return lines;
}

void print_summary(std::ostream& out, const std::vector<Row>& rows) {
  out << "\n== Sizes of the convolutions\n";
  for (const std::string& line : thesis_counts(rows)) out << line << "\n";
  out << "\n== Ratios to CGAL's reduced convolution, geometric means: regions prepared, from points\n";
  for (const Group group : {Group::real, Group::stars, Group::holes, Group::swim, Group::shirts, Group::thesis}) {
    const double mean = geometric_mean(rows, &Row::ratio, &group);
    if (mean > 0)
      out << name(group) << ": " << text("%.0f, %.1f", mean, geometric_mean(rows, &Row::fresh_ratio, &group)) << "\n";
  }
  for (const std::string& line : clipper_lines(rows)) out << line << "\n";
  const Row* best = least(
      rows, [](const Row& r) { return r.ratio_to_best_cgal(); }, [](const Row& r) { return r.reduced.finished; });
  if (best != nullptr) {
    out << "against whichever CGAL method was fastest: least " << text("%.1f", best->ratio_to_best_cgal()) << ", "
        << best->name << "\n";
  }
}

void print_promises(std::ostream& out, const std::vector<Row>& rows) {
  out << "\n== Promises\n";
  for (const Target& target : targets(rows)) {
    out << (target.met ? "met      " : "NOT met  ") << target.promise << ": " << target.measured << "\n";
  }
}

}  // namespace dymsum::bench
