#include "scaling/measure.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scaling/coherence.h"
#include "versus/cgal.h"
#include "versus/rival.h"

namespace dymsum::bench {
namespace {

Region exactly_scaled(const Region& region, double s) {
  const Region r = scaled(region, s, s).value();
  return r;
}

}  // namespace

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
  row.frame_ms = spread(frame.ms);
  row.static_ms = spread(fresh.ms);
  row.kept = kept.median();
  row.update_ms = update.median();
  row.window_ms = window.median();
  row.all_pairs_ms = all_pairs.median();
  row.cgal_ms = cgal.median();
  return row;
}

}  // namespace dymsum::bench
