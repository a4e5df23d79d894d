#include "growing/frames.h"

#include <algorithm>
#include <chrono>

#include "dymsum/growing_disc.h"
#include "dymsum/planar_sum.h"
#include "dymsum/shapes.h"
#include "spread.h"

namespace dymsum::bench {
namespace {

template <class Work>
double timed_ms(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

Rational radius_at(double top, std::size_t i, std::size_t frames) {
  return Rational::of(top * static_cast<double>(i) / static_cast<double>(frames)).value();
}

}  // namespace

FrameRow measure_frames(const std::string& name, const Region& region, double fraction, std::size_t frames,
                        std::size_t samples) {
  const auto box = bounds(region);
  const double top = fraction * std::max(box[2] - box[0], box[3] - box[1]);
  FrameRow row{name, region.vertex_count(), 0, frames};
  const GrowingDisc disc(region);
  row.complex_ms = timed_ms([&] { row.events = disc.events(DiscSide::outside).value().size(); });
  std::vector<double> kept, anew, polygon;
  for (std::size_t i = 1; i <= frames; ++i) {
    const Rational r = radius_at(top, i, frames);
    kept.push_back(timed_ms([&] { row.pieces += disc.sum_at(r).value().piece_count(); }));
  }
  for (std::size_t k = 1; k <= samples; ++k) {
    const Rational r = radius_at(top, k, samples);
    anew.push_back(timed_ms([&] { static_cast<void>(GrowingDisc(region).sum_at(r).value()); }));
    const Region round = shapes::disc(32, r.to_double(), shapes::demo_snap(r.to_double()));
    polygon.push_back(timed_ms([&] { static_cast<void>(minkowski_sum(region, round).value()); }));
  }
  row.frame_ms = quantile(kept, 0.5);
  row.anew_ms = quantile(anew, 0.5);
  row.polygon_ms = quantile(polygon, 0.5);
  return row;
}

void report_frames(Report& report, const std::vector<FrameRow>& rows) {
  report.heading({"region", "vertices", "events", "complex ms", "frame ms", "complex anew and a level ms", "times",
                  "sum with a 32-gon ms", "times"});
  for (const FrameRow& row : rows)
    report.row({row.name, std::to_string(row.vertices), std::to_string(row.events), fixed(row.complex_ms, 2),
                fixed(row.frame_ms, 4), fixed(row.anew_ms, 3), ratio(row.anew_ms, row.frame_ms, 1),
                fixed(row.polygon_ms, 3), ratio(row.polygon_ms, row.frame_ms, 1)});
}

}  // namespace dymsum::bench
