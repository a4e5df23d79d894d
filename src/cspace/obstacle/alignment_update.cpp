// Where an edge of the robot passes the direction of one of the obstacle, the boundary along their common line changes
// hands: before, edge e from vertex q_j and then edge f from p_(i+1); behind, f from p_i and then e from q_(j+1).
#include <algorithm>
#include <map>

#include "cspace/obstacle/obstacle_sweep.h"

namespace dymsum::planar {

bool ObstacleSweep::alignment_update(TurnEvent& event, const TurnRange& range) {
  const std::uint32_t e = event.e, f = event.f, e1 = forms_.operand(1).next[e], f1 = forms_.operand(0).next[f];
  const WalkSegment a{1, e, f}, b{0, f, e1}, b2{0, f, e}, a2{1, e, f1};
  if (first_[id(a)] == kNobody && first_[id(b)] == kNobody) return true;
  exact_root(event, forms_, range);
  const Heading h = Heading::of(event.theta());
  const Point de = forms_.edge(1, e), df = forms_.edge(0, f);
  const double le = std::hypot(de.x, de.y), lf = std::hypot(df.x, df.y);
  std::vector<AlignedRun> runs;
  for (const bool second : {false, true})
    for (std::uint32_t n = first_[id(second ? b : a)]; n != kNobody; n = nodes_[n].same) {
      const Node& node = nodes_[n];
      AlignedRun run;
      run.first = run.last = n;
      const double length = second ? lf : le, base = second ? le : 0;
      const Located from = place_on(forms_, node.segment, nodes_[node.prev].segment, true, h),
                    to = place_on(forms_, node.segment, nodes_[node.next].segment, false, h);
      run.from = base + length * from.t;
      run.to = base + length * to.t;
      run.error = length * (from.error + to.error);
      if (!(run.from <= run.to + run.error)) return false;
      runs.push_back(run);
    }
  // A run over the vertex between the two is one.
  for (std::size_t k = 0; k < runs.size(); ++k)
    for (std::size_t l = 0; l < runs.size(); ++l)
      if (k != l && nodes_[runs[k].last].next == runs[l].first && nodes_[runs[k].last].id != nodes_[runs[l].first].id) {
        runs[k].last = runs[l].last;
        runs[k].to = runs[l].to;
        runs[k].error += runs[l].error;
        runs.erase(runs.begin() + static_cast<std::ptrdiff_t>(l));
        k = l = runs.size();
      }
  const double unsure = 1e-9 * (le + lf);
  const Pair middle{f1, e};
  for (AlignedRun& run : runs) {
    // A chain that ends or starts at the vertex between the two behind the event: where that vertex is reflex, the
    // boundary turns there.
    const bool from_middle = forms_.end(nodes_[nodes_[run.first].prev].segment) == middle;
    const bool to_middle = TurningForms::start(nodes_[nodes_[run.last].next].segment) == middle;
    const double near = unsure + run.error;
    if ((!from_middle && !(std::abs(run.from - lf) > near)) || (!to_middle && !(std::abs(run.to - lf) > near)))
      return false;
    run.on_first = !from_middle && run.from < lf;
    run.on_second = !to_middle && run.to > lf;
    if (!run.on_first && !run.on_second) return false;
    if ((run.on_first && !catalog_.may_exist(b2)) || (run.on_second && !catalog_.may_exist(a2))) return false;
  }
  return trying_ || carry(event, range, runs, {a, b, b2, a2});
}

bool ObstacleSweep::carry(TurnEvent& event, const TurnRange& range, const std::vector<AlignedRun>& runs,
                          const std::array<WalkSegment, 4>& s) {
  now_ = angle(range, event);
  const Heading h = Heading::of(event.theta());
  note(h, ObstacleEvent::Kind::alignment, place_of(event, forms_, h).at);
  ++work.local_updates;
  std::map<std::uint32_t, std::uint32_t> starts, ends;
  std::vector<std::uint32_t> touched, old;
  for (const AlignedRun& run : runs) {
    std::vector<std::uint32_t> fresh;
    if (run.on_first) fresh.push_back(add_node(s[2], nodes_[run.first].cell));
    if (run.on_second) fresh.push_back(add_node(s[3], nodes_[run.first].cell));
    if (fresh.size() == 2) link(fresh[0], fresh[1]);
    starts[run.first] = fresh.front();
    ends[run.last] = fresh.back();
    join(shell_, run.first, fresh.front());
    old.push_back(run.first);
    if (run.last != run.first) old.push_back(run.last);
    touched.insert(touched.end(), fresh.begin(), fresh.end());
  }
  relink(starts, ends, touched);
  for (const std::uint32_t n : old) end_node(n);
  refresh(touched);
  return true;
}

}  // namespace dymsum::planar
