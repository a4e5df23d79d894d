#include "planar/motion/rotation_catalog.h"

#include <algorithm>

namespace dymsum::planar {

RotationCatalog::RotationCatalog(const TurningForms& forms) : forms_(forms) {
  for (std::uint32_t op = 0; op < 2; ++op) {
    const Operand& o = forms.operand(op);
    angle_[op].resize(o.size());
    turn_[op].resize(o.size());
    of_hole_[op].resize(o.size());
    for (const Loop& loop : o.loops)
      for (std::uint32_t i = loop.first; i < loop.last; ++i) {
        if (forms.is_point(op, i)) continue;  // it has no edge
        angle_[op][i] = positive_angle(std::atan2(o.ey[i], o.ex[i]));
        of_hole_[op][i] = loop.kind == LoopKind::hole;
        edges_[op].push_back({angle_[op][i], i});
        if (loop.kind != LoopKind::hole) outer_edges_[op].push_back({angle_[op][i], i});
      }
    for (auto* list : {&edges_[op], &outer_edges_[op]})
      std::sort(list->begin(), list->end(),
                [](const Edge& a, const Edge& b) { return a.angle != b.angle ? a.angle < b.angle : a.edge < b.edge; });
    start_[op].index(edges_[op]);
    outer_start_[op].index(outer_edges_[op]);
    const auto ranks = [&](const std::vector<Edge>& list, std::vector<std::uint32_t>& rank) {
      rank.assign(o.size(), ~std::uint32_t{0});
      for (std::uint32_t k = 0; k < list.size(); ++k) rank[list[k].edge] = k;
    };
    ranks(edges_[op], rank_[op]);
    ranks(outer_edges_[op], outer_rank_[op]);
    for (std::uint32_t i = 0; i < o.size(); ++i) {
      if (!o.convex[i]) continue;
      const double in = angle_[op][o.prev[i]];
      turn_[op][i] = forms.is_point(op, i) ? kTurn : positive_angle(angle_[op][i] - in);
      corners_[op].push_back({in, turn_[op][i], i, of_hole_[op][i] != 0});
    }
  }
}

void RotationCatalog::Starts::index(const std::vector<Edge>& edges) {
  first.assign(edges.size(), 0);
  std::uint32_t at = 0;
  for (std::size_t k = 0; k < first.size(); ++k) {
    while (at < edges.size() && interval(edges[at].angle) < k) ++at;
    first[k] = at;
  }
}

bool RotationCatalog::may_exist(const WalkSegment& s) const {
  return convex(1 - s.side, s.vertex) && !forms_.is_point(s.side, s.edge) &&
         !(of_hole_[s.side][s.edge] && of_hole_[1 - s.side][s.vertex]);
}

RotationCatalog::Existence RotationCatalog::exists(const WalkSegment& s, double theta) const {
  if (!may_exist(s)) return Existence::no;
  const std::uint32_t op = 1 - s.side;
  if (forms_.is_point(op, s.vertex)) return Existence::yes;
  const double in = angle_[op][forms_.operand(op).prev[s.vertex]];
  const double relative = s.side == 0 ? angle_[0][s.edge] - theta - in : angle_[1][s.edge] + theta - in;
  const double a = positive_angle(relative);
  if (a < kAngleSlack || a > kTurn - kAngleSlack || std::abs(a - turn_[op][s.vertex]) < kAngleSlack)
    return Existence::unsure;
  return a < turn_[op][s.vertex] ? Existence::yes : Existence::no;
}

RotationCatalog::Joint RotationCatalog::joint(Pair v, double theta) const {
  Joint joint;
  const std::array<std::uint32_t, 2> at{v.p, v.q};
  for (std::uint32_t side = 0; side < 2; ++side) {
    const WalkSegment in{side, forms_.operand(side).prev[at[side]], at[1 - side]}, out{side, at[side], at[1 - side]};
    if (const Existence e = exists(in, theta); e != Existence::no) {
      joint.unsure |= e == Existence::unsure || joint.has_in;
      joint.has_in = true;
      joint.in = in;
    }
    if (const Existence e = exists(out, theta); e != Existence::no) {
      joint.unsure |= e == Existence::unsure || joint.has_out;
      joint.has_out = true;
      joint.out = out;
    }
  }
  return joint;
}

}  // namespace dymsum::planar
