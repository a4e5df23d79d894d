// All pairs of edges by the angle at which they point in the same direction, and that angle exactly.
#include <algorithm>

#include "cspace/events/event_angles.h"

namespace dymsum::planar {

const exact::AlgebraicRoot& exact_root(RotationEvent& event, const TurningForms& forms, const RotationRange& range) {
  if (!event.root) {
    // Edges are parallel twice a turn, once in each chart.
    std::vector<exact::AlgebraicRoot> roots =
        roots_in(forms.exact_alignment(event.e, event.f, range.chart), range.t_low, range.t_high);
    event.root = std::move(roots.at(0));
    set_angles(event, range);
  }
  return *event.root;
}

std::vector<Alignment> alignments(const TurningForms& forms, const RotationCatalog& catalog) {
  std::vector<Alignment> all;
  const Operand &fixed = forms.operand(0), &turning = forms.operand(1);
  for (std::uint32_t e = 0; e < turning.size(); ++e)
    for (std::uint32_t f = 0; f < fixed.size() && !forms.is_point(1, e); ++f) {
      if (forms.is_point(0, f)) continue;
      const bool any = catalog.may_exist({1, e, f}) || catalog.may_exist({1, e, fixed.next[f]}) ||
                       catalog.may_exist({0, f, e}) || catalog.may_exist({0, f, turning.next[e]});
      if (!any) continue;
      const double theta = positive_angle(catalog.edge_angle(0, f) - catalog.edge_angle(1, e));
      // The first window begins at -pi / 2 and does not hold it; what doubles leave open there is tried in both.
      const double end = 1.5 * std::numbers::pi;
      if (theta <= end + 2 * kAngleSlack) all.push_back({theta, e, f});
      if (theta >= end - 2 * kAngleSlack) all.push_back({theta - kTurn, e, f});
    }
  std::stable_sort(all.begin(), all.end(), [](const Alignment& a, const Alignment& b) { return a.theta < b.theta; });
  return all;
}

}  // namespace dymsum::planar
