#include "uncertain/variant_sets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "dymsum/planar_boolean.h"
#include "dymsum/shapes.h"
#include "uncertain/uncertain_internals.h"

namespace dymsum::uncertain {
namespace {

/// The ends of an edge, in its direction; of a point twice the same. Rings and polylines are apart.
using EdgeKey = std::array<double, 5>;

std::vector<EdgeKey> sorted_edges(const Region& region) {
  std::vector<EdgeKey> edges;
  const auto add = [&](const std::vector<Point>& chain, std::size_t k, std::size_t next, double kind) {
    edges.push_back({chain[k].x, chain[k].y, chain[next].x, chain[next].y, kind});
  };
  const auto ring = [&](const Ring& r) {
    for (std::size_t k = 0; k < r.size(); ++k) add(r, k, (k + 1) % r.size(), 0);
  };
  for (const Part& part : region.parts()) {
    ring(part.outer);
    for (const Ring& hole : part.holes) ring(hole);
  }
  for (const Polyline& line : region.polylines())
    for (std::size_t k = 0; k + 1 < line.size(); ++k) add(line, k, k + 1, 1);
  for (std::size_t k = 0; k < region.points().size(); ++k) add(region.points(), k, k, 2);
  std::sort(edges.begin(), edges.end());
  return edges;
}

std::array<double, 4> box_of(const PlanarOperand& operand) {
  if (const auto* region = std::get_if<const Region*>(&operand.set())) return bounds(**region);
  const PlanarSum& set = *std::get<const PlanarSum*>(operand.set());
  std::array<double, 4> box{INFINITY, INFINITY, -INFINITY, -INFINITY};
  const auto see = [&](const SumVertex& v) {
    box = {std::min(box[0], v.at.x), std::min(box[1], v.at.y), std::max(box[2], v.at.x), std::max(box[3], v.at.y)};
  };
  for (const SumPart& part : set.parts)
    for (const SumVertex& v : part.outer.vertices) see(v);
  for (const SumSegment& s : set.segments) see(s.from), see(s.to);
  for (const SumVertex& v : set.points) see(v);
  return box;
}

/// Cutting pays where the window is at most so much of the first set's box.
constexpr double kLargestWindow = 0.6;

bool is_small(const PlanarBox& window, const PlanarOperand& of) {
  const std::array<double, 4> box = box_of(of);
  const double x = std::min(window.high.x, box[2]) - std::max(window.low.x, box[0]),
               y = std::min(window.high.y, box[3]) - std::max(window.low.y, box[1]);
  return std::max(x, 0.0) * std::max(y, 0.0) <= kLargestWindow * (box[2] - box[0]) * (box[3] - box[1]);
}

/// Somewhat larger, with corners of few digits.
Region rectangle_around(const PlanarBox& window) {
  const double size = std::max({window.high.x - window.low.x, window.high.y - window.low.y, 0x1p-900});
  const double unit = std::max(std::ldexp(1.0, std::ilogb(size) - 8),
                               0x1p-40 * std::max({std::abs(window.low.x), std::abs(window.low.y),
                                                   std::abs(window.high.x), std::abs(window.high.y)}));
  const double grid = std::ldexp(1.0, std::ilogb(unit));
  return shapes::rectangle(grid * (std::floor(window.low.x / grid) - 1), grid * (std::floor(window.low.y / grid) - 1),
                           grid * (std::ceil(window.high.x / grid) + 1), grid * (std::ceil(window.high.y / grid) + 1));
}

Result<CommonAndAny> of_all(std::span<const PlanarOperand> sets, const SumOptions& options) {
  Result<PlanarSum> common = intersection(sets, options);
  if (!common) return common.error();
  Result<PlanarSum> any = united(sets, options);
  if (!any) return any.error();
  return CommonAndAny{*std::move(common), *std::move(any)};
}

}  // namespace

std::optional<PlanarBox> differing_box(std::span<const Region> variants) {
  std::vector<EdgeKey> different;
  const std::vector<EdgeKey> first = sorted_edges(variants[0]);
  for (const Region& variant : variants.subspan(1)) {
    const std::vector<EdgeKey> edges = sorted_edges(variant);
    std::set_symmetric_difference(first.begin(), first.end(), edges.begin(), edges.end(),
                                  std::back_inserter(different));
  }
  if (different.empty()) return std::nullopt;
  PlanarBox box{{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};
  for (const auto& [ax, ay, bx, by, kind] : different) {
    box.low = {std::min({box.low.x, ax, bx}), std::min({box.low.y, ay, by})};
    box.high = {std::max({box.high.x, ax, bx}), std::max({box.high.y, ay, by})};
  }
  return box;
}

Result<CommonAndAny> common_and_any(std::span<const PlanarOperand> sets, const std::optional<PlanarBox>& window,
                                    const SumOptions& options) {
  if (!window || !is_small(*window, sets[0])) return of_all(sets, options);
  const Region around = rectangle_around(*window);
  std::vector<PlanarSum> cuts;
  for (const PlanarOperand& set : sets) {
    Result<PlanarSum> cut = intersection(set, around, options);
    if (cut) cut = closed_set(*cut, options);  // else it would be taken for the whole set and the window
    if (!cut) return cut.error();
    cuts.push_back(*std::move(cut));
  }
  const Result<PlanarSum> rest = difference(sets[0], around, options);
  if (!rest) return rest.error();
  const Result<CommonAndAny> inside = of_all(std::vector<PlanarOperand>(cuts.begin(), cuts.end()), options);
  if (!inside) return inside;
  const auto joined = [&](const PlanarSum& part) -> Result<PlanarSum> {
    const Result<PlanarSum> both = united(*rest, part, options);
    return both ? closed_set(*both, options) : both;  // the sides of the window are no tight features
  };
  Result<PlanarSum> common = joined(inside->common);
  if (!common) return common.error();
  Result<PlanarSum> any = joined(inside->any);
  if (!any) return any.error();
  return CommonAndAny{*std::move(common), *std::move(any)};
}

}  // namespace dymsum::uncertain
