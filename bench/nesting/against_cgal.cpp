#include "nesting/against_cgal.h"

#include <cmath>

#include "dymsum/cspace_obstacle.h"
#include "versus/cgal.h"

namespace dymsum::bench {
namespace {

bool same_answer(const PlanarSum& sum, const Rational& area, const RivalAnswer& theirs) {
  return theirs.finished && sum.parts.size() == theirs.outer && sum.hole_count() == theirs.holes &&
         sum.vertex_count() == theirs.vertices &&
         (theirs.area_exact.empty() ? std::abs(area.to_double() - theirs.area) <= 1e-12 * theirs.area
                                    : area.to_string() == theirs.area_exact);
}

}  // namespace

Rivalry against_cgal(const NfpTable& table) {
  Rivalry all;
  for (const TableRow& row : table.rows()) {
    const Region &fixed = table.input().items[row.fixed].shape, &moving = table.input().items[row.moving].shape;
    const Orientation& theta = table.angles()[row.angle].orientation;
    const CgalOperands operands(fixed.data(), moving.data(), theta);
    const RivalAnswer theirs = operands.sum(CgalMethod::reduced_convolution, Repeats{});
    const PlanarSum sum = cspace_slice(moving, fixed, theta).value();
    ++all.rows;
    all.cgal_ms += theirs.median_ms;
    const Rational area = sum.area_exact();
    if (same_answer(sum, area, theirs)) ++all.equal;
    else all.witnessed += same_answer(sum, area, operands.sum_in_child(CgalMethod::vertical_decomposition, {}, 5));
  }
  return all;
}

}  // namespace dymsum::bench
