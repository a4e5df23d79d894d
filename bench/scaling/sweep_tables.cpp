#include "scaling/sweep_tables.h"

#include <algorithm>
#include <numbers>
#include <random>
#include <sstream>

namespace dymsum::bench {
namespace {

constexpr const char *kScattered = "1:2:1%, scattered", *kRatio = "1:2:1% in x, three quarters of it in y";

struct NamedScales {
  std::string name;
  std::vector<ScaleXY> scales;
};

NamedScales sweep(const char* from, const char* to, const char* step, StepKind kind) {
  const std::string text = std::string(from) + ":" + to + ":" + step + (kind == StepKind::percent ? "%" : "");
  NamedScales list{text, {}};
  for (const Scale& s :
       scale_steps(Scale::parse(from).value(), Scale::parse(to).value(), parse_scale_step(step).value(), kind, 10000)
           .value())
    list.scales.push_back({s, s});
  return list;
}

std::vector<NamedScales> scale_lists() {
  std::vector<NamedScales> lists{sweep("1", "1.5", "0.01", StepKind::difference),
                                 sweep("1", "2", "1", StepKind::percent), sweep("1", "2", "0.1", StepKind::percent)};
  NamedScales scattered{kScattered, lists[1].scales};
  std::mt19937 random(1);
  for (std::size_t i = scattered.scales.size(); i > 1; --i)
    std::swap(scattered.scales[i - 1], scattered.scales[random() % i]);
  lists.push_back(std::move(scattered));
  NamedScales ratio{kRatio, lists[1].scales};
  for (ScaleXY& at : ratio.scales) at.y = Scale::of(at.x.exact() * Rational::of(3, 4).value()).value();
  lists.push_back(std::move(ratio));
  return lists;
}

std::vector<Orientation> whole_turn(int steps) {
  std::vector<Orientation> thetas;
  for (int k = 0; k < steps; ++k)
    thetas.push_back(Orientation::nearest(2 * std::numbers::pi * k / steps, 1e-6).value());
  return thetas;
}

void heading(Report& report) {
  report.heading({"pair", "coordinates", "vertices", "static ms", "from points", "rounded", "frames", "mean", "median",
                  "p99", "worst", "back: mean", "p99", "worst", "windows, from scratch, touching", "two threads: mean",
                  "p99", "worst", "compared, different"});
}

std::string count(std::uint64_t n) { return std::to_string(n); }
std::string ms(double v) { return v > 0 ? fixed(v, v < 1 ? 3 : 2) : "-"; }

enum class Way { there, back };

/// Frames of any number of rounds, each in static sums at its position.
std::vector<double> waits(const SweepRow& r, const std::vector<double>& frames, Way way) {
  std::vector<double> all;
  const std::size_t positions = r.statics.size();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::size_t position = way == Way::there ? i % positions : positions - 2 - i % (positions - 1);
    all.push_back(frames[i] / std::max(r.statics[position], 1e-6));
  }
  return all;
}

std::vector<double> joined(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<double> two_thread_waits(const SweepRow& r) {
  return joined(waits(r, r.two_there, Way::there), waits(r, r.two_back, Way::back));
}

void line(Report& report, const SweepRow& r) {
  const Spread statics = spread(r.statics), there = spread(r.there), back = spread(r.back);
  const Spread there_waits = spread(waits(r, r.there, Way::there)), back_waits = spread(waits(r, r.back, Way::back));
  const Spread two = spread(joined(r.two_there, r.two_back)), two_waits = spread(two_thread_waits(r));
  const auto wait = [](double v) { return v > 0 ? fixed(v, 2) : "-"; };
  report.row({r.name, r.coordinates, count(r.vertices), ms(statics.mean), ms(r.fresh.mean), ms(r.rounded.mean),
              count(there.count), "**" + ratio(statics.mean, there.mean, 1) + "**",
              ratio(statics.median, there.median, 1), wait(there_waits.p99), wait(there_waits.worst),
              ratio(statics.mean, back.mean, 1), wait(back_waits.p99), wait(back_waits.worst),
              count(r.windows) + ", " + count(r.rebuilt) + ", " + count(r.degenerate), ratio(statics.mean, two.mean, 1),
              wait(two_waits.p99), wait(two_waits.worst), count(r.compared) + ", " + count(r.different)});
}

/// The pairs with the names of their coordinates: raw and snapped ones below each other, or those of a kind.
std::vector<std::pair<std::string, ScalingPair>> named_pairs(Report& report, const std::string& data, Kind kind) {
  std::vector<std::pair<std::string, ScalingPair>> named;
  std::vector<std::string> notes;
  const std::vector<ScalingPair> raw = with_coordinates(sweep_pairs(data, Snapping::raw), kind, notes);
  if (kind) {
    for (const std::string& note : notes) report.line(note + "\n");
    for (const ScalingPair& pair : raw) named.emplace_back(name(*kind), pair);
    return named;
  }
  const std::vector<ScalingPair> snapped = sweep_pairs(data, Snapping::snapped);
  for (std::size_t i = 0; i < raw.size(); ++i) {
    named.emplace_back("raw", raw[i]);
    named.emplace_back("snapped", snapped[i]);
  }
  return named;
}

template <class Positions>
void table(Report& report, const std::vector<std::pair<std::string, ScalingPair>>& pairs, const Wanted& wanted,
           const std::string& steps, const Positions& positions, std::vector<SweepRow>& rows) {
  heading(report);
  for (const auto& [coordinates, pair] : pairs) {
    if (!wanted(pair)) continue;
    SweepPlan plan;
    plan.coordinates = coordinates;
    plan.steps = steps;
    rows.push_back(measure_sweep(pair, positions, plan));
    line(report, rows.back());
  }
}

struct Promised {
  std::string steps, text;
  double least, mean;   ///< of mean frames: on every raw pair, and their geometric mean; 0 where nothing is promised
  double star_500 = 0;  ///< instead of `least`
};

void promise_means(Report& report, const std::vector<SweepRow>& rows, const Promised& promised) {
  std::vector<double> gains;
  const SweepRow* worst = nullptr;
  double least = 0;
  for (const SweepRow& r : rows) {
    if (r.steps != promised.steps || r.coordinates != "raw") continue;
    gains.push_back(spread(r.statics).mean / spread(r.there).mean);
    const bool star = promised.star_500 > 0 && r.name == "star 500 + star 500";
    const double margin = gains.back() / (star ? promised.star_500 : promised.least);
    if (worst == nullptr || margin < least) worst = &r, least = margin;
  }
  if (worst == nullptr) return;
  if (promised.least > 0)
    report.promise(promised.text + ", raw, mean of all frames: " + fixed(promised.least, promised.least < 1 ? 2 : 0) +
                       " times static on every pair" +
                       (promised.star_500 > 0 ? " (star 500: " + fixed(promised.star_500, 0) + ")" : ""),
                   "least " + ratio(spread(worst->statics).mean, spread(worst->there).mean, 2) + ", " + worst->name,
                   least >= 1);
  if (promised.mean > 0)
    report.promise(
        promised.text + ", raw, mean of all frames: " + fixed(promised.mean, 0) + " times static as geometric mean",
        fixed(geometric_mean(gains), 1), geometric_mean(gains) >= promised.mean);
}

}  // namespace

std::vector<SweepRow> scaling_sweeps(Report& report, const std::string& data, Kind kind, const Wanted& wanted) {
  std::vector<SweepRow> rows;
  const auto pairs = named_pairs(report, data, kind);
  for (const NamedScales& list : scale_lists()) {
    report.line("\n### s P (+) Q, `" + list.name + "`\n");
    table(report, pairs, wanted, list.name, list.scales, rows);
  }
  return rows;
}

std::vector<SweepRow> turning_sweeps(Report& report, const std::string& data, Kind kind, const Wanted& wanted) {
  std::vector<SweepRow> rows;
  const auto pairs = named_pairs(report, data, kind);
  for (const int steps : {60, 500}) {
    const std::string name = std::to_string(steps) + " steps a turn";
    report.line("\n### R(theta) P (+) Q, " + name + "\n");
    table(report, pairs, wanted, name, whole_turn(steps), rows);
  }
  return rows;
}

void sweep_promises(Report& report, const std::vector<SweepRow>& scaling, const std::vector<SweepRow>& turning) {
  promise_means(report, scaling, {"1:2:1%", "scaling in steps of 1 %", 4, 8, 2});
  promise_means(report, scaling, {"1:2:0.1%", "scaling in steps of 0.1 %", 0, 15});
  promise_means(report, scaling, {kScattered, "scattered scales", 1 / 1.1, 0});
  promise_means(report, turning, {"500 steps a turn", "turning, 500 steps", 3, 5});
  std::vector<SweepRow> rows = scaling;
  rows.insert(rows.end(), turning.begin(), turning.end());
  const SweepRow *slowest = nullptr, *late = nullptr;
  double back = 0, wait = 0;
  std::size_t compared = 0, different = 0;
  for (const SweepRow& r : rows) {
    compared += r.compared;
    different += r.different;
    const Spread statics = spread(r.statics);
    const double fraction = statics.mean / spread(r.back).mean / (statics.median / spread(r.there).median);
    if (r.steps != kScattered && (slowest == nullptr || fraction < back)) slowest = &r, back = fraction;
    if (r.two_there.size() + r.two_back.size() < 1000) continue;
    const double p99 = spread(two_thread_waits(r)).p99;
    if (late == nullptr || p99 > wait) late = &r, wait = p99;
  }
  if (slowest != nullptr)
    report.promise("the way back: its mean gains at least 0.8 of what a median frame gains",
                   "least " + fixed(back, 2) + ", " + slowest->name + ", " + slowest->steps, back >= 0.8);
  if (late != nullptr)
    report.promise("two threads: 99 of 100 frames wait at most 1.2 static sums (1,000 frames and more)",
                   "most " + fixed(wait, 2) + ", " + late->name + ", " + late->steps, wait <= 1.2);
  if (compared > 0)
    report.promise("frames compared equal the static sum exactly",
                   count(compared) + " compared, " + count(different) + " differ", different == 0);
}

std::string sweep_csv(const std::vector<SweepRow>& rows) {
  std::ostringstream out;
  out.precision(3);
  out << "pair,coordinates,steps,pass,fresh_ms,rounded_ms,frames_ms\n";
  const auto pass = [&](const SweepRow& r, const char* name, const std::vector<double>& times) {
    if (times.empty()) return;
    out << r.name << "," << r.coordinates << ",\"" << r.steps << "\"," << name << "," << r.fresh.mean << ","
        << r.rounded.mean << ",";
    for (std::size_t i = 0; i < times.size(); ++i) out << (i > 0 ? " " : "") << times[i];
    out << "\n";
  };
  for (const SweepRow& r : rows) {
    pass(r, "static", r.statics);
    pass(r, "there", r.there);
    pass(r, "back", r.back);
    pass(r, "two threads, there", r.two_there);
    pass(r, "two threads, back", r.two_back);
  }
  return out.str();
}

}  // namespace dymsum::bench
