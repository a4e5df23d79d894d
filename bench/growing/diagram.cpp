#include "growing/diagram.h"

#include <algorithm>
#include <chrono>

#include "dymsum/planar_sum.h"
#include "dymsum/shape_features.h"
#include "dymsum/shapes.h"
#include "shape/complex/complex.h"
#include "spread.h"
#include "versus/segment_delaunay.h"

namespace dymsum::bench {
namespace {

template <class Task>
double median_ms(int runs, const Task& task) {
  std::vector<double> times;
  for (int k = 0; k < runs; ++k) {
    const auto start = std::chrono::steady_clock::now();
    task();
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  return quantile(times, 0.5);
}

std::string percent(double fraction) { return fixed(100 * fraction, 2) + " %"; }

}  // namespace

DiagramRow measure_diagram(const std::string& name, const Region& region, int runs, bool with_cgal) {
  using shape::Side;
  DiagramRow row{.name = name, .vertices = region.vertex_count()};
  double filtered = 0, exact = 0;
  const auto measure = [&](Side side, int threads) {
    shape::Complex c;
    const double ms = median_ms(runs, [&] { c = make_complex(region, side, shape::Engine::fast, threads).value(); });
    row.certified = row.certified && c.work.certified;
    if (threads != 1) return ms;
    row.nodes += c.nodes.size();
    filtered += static_cast<double>(c.work.signs.filtered());
    exact += static_cast<double>(c.work.signs.exact());
    return ms;
  };
  row.outside_ms = measure(Side::outside, 1);
  row.inside_ms = measure(Side::inside, 1);
  row.threads_ms = measure(Side::outside, 0);
  row.exact_fraction = exact / std::max(1.0, filtered + exact);
  if (!with_cgal) return row;
  const SegmentDelaunay rival(region.data());
  std::vector<double> times;
  for (int k = 0; k < runs; ++k) times.push_back(rival.build().ms);
  row.cgal_ms = quantile(times, 0.5);
  return row;
}

void report_diagrams(Report& report, const std::vector<DiagramRow>& rows) {
  report.heading({"region", "vertices", "nodes", "outside ms", "inside ms", "outside, all threads ms", "CGAL ms",
                  "both sides / CGAL", "decided exactly", "certified"});
  for (const DiagramRow& row : rows) {
    report.row({row.name, std::to_string(row.vertices), std::to_string(row.nodes), fixed(row.outside_ms, 2),
                fixed(row.inside_ms, 2), fixed(row.threads_ms, 2), row.cgal_ms == 0 ? "-" : fixed(row.cgal_ms, 2),
                ratio(row.outside_ms + row.inside_ms, row.cgal_ms, 1), percent(row.exact_fraction),
                row.certified ? "yes" : "no"});
    report.csv << row.name << ",outside_ms," << row.outside_ms << '\n'
               << row.name << ",cgal_ms," << row.cgal_ms << '\n';
  }
}

BarcodeRow measure_barcode(const std::string& name, const Region& region, double fraction, int radii, int samples) {
  BarcodeRow row{.name = name, .vertices = region.vertex_count()};
  row.barcode_ms = median_ms(3, [&] { row.bars = ShapeFeatures::create(region).value().bars().size(); });
  const auto box = bounds(region);
  const double top = fraction * std::max(box[2] - box[0], box[3] - box[1]);
  for (int k = 0; k < samples; ++k) {
    const double radius = top * (k + 0.5) / samples;
    const Region round = shapes::disc(32, radius, shapes::demo_snap(radius));
    row.sums_ms += median_ms(1, [&] { static_cast<void>(minkowski_sum(region, round).value()); });
  }
  row.sums_ms *= static_cast<double>(radii) / samples;
  return row;
}

void report_barcodes(Report& report, const std::vector<BarcodeRow>& rows) {
  report.heading({"region", "vertices", "bars", "barcode ms", "400 sums with a 32-gon ms", "sums / barcode"});
  for (const BarcodeRow& row : rows) {
    report.row({row.name, std::to_string(row.vertices), std::to_string(row.bars), fixed(row.barcode_ms, 2),
                fixed(row.sums_ms, 1), ratio(row.sums_ms, row.barcode_ms, 1)});
    report.csv << row.name << ",barcode_ms," << row.barcode_ms << '\n'
               << row.name << ",sums_ms," << row.sums_ms << '\n';
  }
}

}  // namespace dymsum::bench
