#include "scaling/measure.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dymsum/region_io.h"
#include "dymsum/shapes.h"
#include "planar/crossing_grates.h"
#include "scaling/coherence.h"
#include "versus/cgal.h"
#include "versus/rival.h"

namespace dymsum::bench {
namespace {

/// Coordinates on integers of at most 22 bits; repaired where that makes vertices collinear or equal.
Region snapped(const Region& region) {
  const auto box = bounds(region);
  double size = 0;
  for (const double v : box) size = std::max(size, std::abs(v));
  const double f = std::ldexp(1.0, 21 - std::ilogb(size));
  RegionData data = region.data();
  const auto all = [&](Ring& ring) {
    for (Point& p : ring) p = {std::round(p.x * f), std::round(p.y * f)};
  };
  for (Part& part : data.parts) {
    all(part.outer);
    for (Ring& hole : part.holes) all(hole);
  }
  Result<Repaired> repaired = repair(std::move(data));
  if (!repaired.ok()) throw std::runtime_error(repaired.error().to_string());
  return std::move(repaired).value().region;
}

/// Both on one grid: the sizes keep their proportion.
std::pair<Region, Region> snapped_pair(const Region& p, const Region& q) {
  const auto size = [](const Region& r) {
    double m = 0;
    for (const double v : bounds(r)) m = std::max(m, std::abs(v));
    return std::ilogb(m);
  };
  const int difference = size(q) - size(p);
  const double f = std::ldexp(1.0, difference);
  Region a = snapped(p), b = snapped(q);
  b = scaled(b, f, f).value();
  return {std::move(a), std::move(b)};
}

Region read(const std::string& data, const std::string& name) {
  return std::move(repair(read_region_data(data + "/planar/" + name + ".poly").value()).value().region);
}

Region exactly_scaled(const Region& region, double s) {
  const Region r = scaled(region, s, s).value();
  return r;
}

}  // namespace

std::vector<ScalingPair> frame_pairs(const std::string& data) {
  std::vector<ScalingPair> pairs;
  const auto add = [&](const char* name, const Region& p, const Region& q, bool q_scales = false) {
    auto [a, b] = snapped_pair(p, q);
    pairs.push_back({name, std::move(a), std::move(b), q_scales});
  };
  if (!data.empty()) {
    const Region neuron = read(data, "neuron"), monkey = read(data, "monkey"), bird = read(data, "bird"),
                 dog = read(data, "dog");
    add("neuron + disc 32", neuron, shapes::disc(32, 1), true);
    add("monkey + bird", monkey, bird);
    add("dog + dog", dog, dog);
  }
  add("star 100 + star 100", shapes::noisy_star(100, 0.5, 1), shapes::noisy_star(100, 0.5, 2));
  add("star 200 + star 200", shapes::noisy_star(200, 0.5, 1), shapes::noisy_star(200, 0.5, 2));
  add("star 500 + star 500", shapes::noisy_star(500, 0.1, 1), shapes::noisy_star(500, 0.1, 2));
  const auto [p, q] = crossing_grates(5);
  pairs.push_back({"crossing grates 5 + 5", p, q, false});
  return pairs;
}

std::vector<ScalingPair> table_pairs() {
  std::vector<ScalingPair> pairs;
  const auto set = shapes::thesis_like_set();
  const char* const names[] = {"dog", "G1", "G2", "G3", "G4"};
  const auto find = [&](std::string_view name) -> const Region& {
    for (const shapes::Named& n : set)
      if (n.name == name) return n.region;
    throw std::runtime_error("no such shape");
  };
  for (const char* a : names)
    for (const char* b : names) {
      auto [p, q] = snapped_pair(find(a), find(b));
      pairs.push_back({std::string(a) + " + " + b, std::move(p), std::move(q), false});
    }
  return pairs;
}

std::vector<double> steady_steps(double step, std::size_t frames) {
  std::vector<double> scales;
  double s = 1;
  for (std::size_t i = 0; i < frames; ++i) {
    s = std::round(s * (1 + step) * 0x1p14) * 0x1p-14;
    scales.push_back(s);
  }
  return scales;
}

std::vector<double> random_scales(std::size_t frames) {
  std::vector<double> scales;
  std::uint64_t state = 20130607;
  for (std::size_t i = 0; i < frames; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    const auto tenths = static_cast<double>(1 + (state >> 33) % 100);
    scales.push_back(std::round(tenths / 10 * 0x1p12) * 0x1p-12);
  }
  return scales;
}

constexpr int kSweeps = 3;

FramesRow measure_frames(const ScalingPair& pair, const FramesPlan& plan) {
  FramesRow row;
  row.name = pair.name;
  row.steps = plan.steps;
  row.p_vertices = pair.p.vertex_count();
  row.q_vertices = pair.q.vertex_count();
  row.segments = convolution_sizes(pair.p, pair.q).reduced;
  MovingOptions options;
  options.moving = pair.q_scales ? MovingOperand::q : MovingOperand::p;
  options.mode = plan.mode;
  // Each system sweeps on its own, as it would in use, one after the other kSweeps times; then both sweep together and
  // are compared.
  std::vector<Times> frame_times(plan.scales.size()), fresh_times(plan.scales.size());
  // Small frames take little longer than reading the clock.
  const double clock = clock_ms();
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    ScalingSum alone = ScalingSum::create(pair.p, pair.q, options).value();
    for (std::size_t i = 0; i < plan.scales.size(); ++i) {
      const double start = cpu_ms();
      if (!alone.set(plan.scales[i]).ok()) throw std::runtime_error("a frame failed");
      frame_times[i].ms.push_back(std::max(cpu_ms() - start - clock, 0.0));
    }
    for (std::size_t i = 0; i < plan.scales.size(); ++i) {
      const double s = plan.scales[i];
      const Region p = pair.q_scales ? pair.p : exactly_scaled(pair.p, s),
                   q = pair.q_scales ? exactly_scaled(pair.q, s) : pair.q;
      const double start = cpu_ms();
      const PlanarSum answer = minkowski_sum(p, q).value();
      fresh_times[i].ms.push_back(std::max(cpu_ms() - start - clock, 0.0));
    }
  }
  ScalingSum sum = ScalingSum::create(pair.p, pair.q, options).value();
  PlanarSum before;
  Times kept;  // shares
  Times frame, fresh, update, window, all_pairs, cgal;
  const std::size_t n = plan.scales.size(),
                    every = plan.rival_frames == 0 ? 0 : std::max<std::size_t>(1, n / plan.rival_frames);
  for (std::size_t i = 0; i < n; ++i) {
    const double s = plan.scales[i];
    const Region p = pair.q_scales ? pair.p : exactly_scaled(pair.p, s),
                 q = pair.q_scales ? exactly_scaled(pair.q, s) : pair.q;
    const PlanarSum answer = minkowski_sum(p, q).value();
    fresh.ms.push_back(fresh_times[i].median());
    if (!sum.set(s).ok()) throw std::runtime_error("a frame failed");
    frame.ms.push_back(frame_times[i].median());
    const FrameWork& work = sum.work();
    if (!work.rebuilt) (work.new_window ? window : update).ms.push_back(work.ms);
    row.windows += work.new_window;
    row.rebuilt += work.rebuilt;
    row.degenerate += work.degenerate;
    row.pieces = std::max(row.pieces, work.pieces);
    row.candidates = std::max(row.candidates, work.candidates);
    row.bytes = std::max(row.bytes, work.peak_bytes);
    ++row.compared;
    row.different += !(answer == sum.sum());
    row.samples.push_back({s, frame.ms.back(), fresh.ms.back(), work.crossings_changed, answer.stats.crossings,
                           work.rebuilt, work.new_window});
    row.vertices = std::max<std::uint64_t>(row.vertices, answer.vertex_count());
    row.holes = std::max<std::uint64_t>(row.holes, answer.hole_count());
    if (i > 0) kept.ms.push_back(corners_kept(before, answer));
    before = answer;
    if (every == 0 || i % every != every / 2) continue;
    SumOptions brute;
    brute.engine = Engine::brute;
    const double start = cpu_ms();
    const PlanarSum slow = minkowski_sum(p, q, brute).value();
    all_pairs.ms.push_back(cpu_ms() - start);
    if (!plan.cgal) continue;
    const RivalAnswer rival = CgalOperands(p.data(), q.data()).sum(CgalMethod::reduced_convolution, Repeats{});
    cgal.ms.push_back(rival.median_ms);
    row.cgal_different += rival.holes != sum.sum().hole_count() || rival.vertices != sum.sum().vertex_count() ||
                          (!rival.area_exact.empty() && rival.area_exact != sum.sum().area_exact().to_string());
  }
  row.frames = n;
  const auto mean = [](const Times& t) {
    double total = 0;
    for (const double v : t.ms) total += v;
    return t.ms.empty() ? 0 : total / static_cast<double>(t.ms.size());
  };
  row.frame_ms = frame.median();
  row.frame_mean_ms = mean(frame);
  row.static_ms = fresh.median();
  row.static_mean_ms = mean(fresh);
  row.kept = kept.median();
  row.update_ms = update.median();
  row.window_ms = window.median();
  row.all_pairs_ms = all_pairs.median();
  row.cgal_ms = cgal.median();
  return row;
}

}  // namespace dymsum::bench
