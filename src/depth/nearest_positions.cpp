#include "depth/nearest_positions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

#include "base/stopwatch.h"

namespace dymsum::depth {

using spatial::length;
using spatial::Vec3;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Positions that are off by more are asked about in integers only.
constexpr double kVague = 0x1p-16;

/// A node of the tree, or a facet.
struct SearchItem {
  double lower = 0;
  std::uint32_t id = 0;
  bool is_facet = false;
  bool operator>(const SearchItem& other) const {
    return std::tie(lower, is_facet, id) > std::tie(other.lower, other.is_facet, other.id);
  }
};

class PositionSearch {
 public:
  PositionSearch(const FacetView& view, const ExactFrame& frame, DepthProbe& probe, bool inside)
      : view_(view), frame_(frame), probe_(probe), inside_(inside) {}

  NearestPositions run(double time_limit);

 private:
  void open(std::uint32_t node);
  void look_at(std::uint32_t facet);
  void look_for_free(std::uint32_t facet);
  void offer(const ExactPosition& x);
  double lower_bound(double distance) const { return distance > view_.slack ? distance - view_.slack : 0; }

  const FacetView& view_;
  const ExactFrame& frame_;
  DepthProbe& probe_;
  const bool inside_;
  std::priority_queue<SearchItem, std::vector<SearchItem>, std::greater<>> queue_;
  double bound_ = kInfinity;  // not less than the distance of result_.all
  NearestPositions result_;
};

NearestPositions PositionSearch::run(double time_limit) {
  Stopwatch watch;
  if (!view_.o.tree.empty()) queue_.push({0, 0, false});
  while (!queue_.empty() && !(queue_.top().lower > bound_)) {
    const SearchItem item = queue_.top();
    queue_.pop();
    if (!item.is_facet) {
      open(item.id);
      continue;
    }
    if (time_limit > 0 && watch.ms() > time_limit * 1000) {
      result_.at_most = bound_, result_.at_least = std::max(0.0, item.lower - view_.slack);
      result_.all.clear();
      return std::move(result_);
    }
    look_at(item.id);
  }
  return std::move(result_);
}

void PositionSearch::open(std::uint32_t id) {
  const FacetTree& tree = view_.o.tree;
  const FacetTree::Node& node = tree.node(id);
  const auto push = [&](const SearchItem& item) {
    if (!(item.lower > bound_)) queue_.push(item);
  };
  if (!node.leaf()) {
    for (const std::uint32_t child : {node.left, node.right})
      push({lower_bound(distance(tree.node(child).box, view_.from)), child, false});
    return;
  }
  for (std::uint32_t k = node.first; k < node.last; ++k) {
    const std::uint32_t f = tree.item(k);
    push({lower_bound(length(view_.nearest(f))), f, true});
  }
}

void PositionSearch::look_at(std::uint32_t f) {
  ++result_.work.facets;
  const Vec3 at = view_.nearest(f);
  ++result_.work.candidates;
  if (!inside_ || !probe_.surely_overlaps(view_.from + at, view_.slack)) offer(frame_.nearest(view_.o.facets[f]));
  if (inside_ && !(lower_bound(length(at)) > bound_)) look_for_free(f);
}

void PositionSearch::look_for_free(std::uint32_t f) {
  const FacetCandidates candidates(view_, frame_, f, bound_ + view_.slack);
  for (const FacetCandidate& c : candidates.all()) {
    if (c.lower > bound_) return;
    ++result_.work.candidates;
    if (c.off < kVague && probe_.surely_overlaps(view_.from + c.at, c.off)) continue;
    if (const std::optional<ExactPosition> x = candidates.exact(c)) offer(*x);
  }
}

/// Takes a position that is as near as any, and free or of the sum.
void PositionSearch::offer(const ExactPosition& x) {
  ++result_.work.exact_tests;
  std::vector<ExactPosition>& all = result_.all;
  const int order = all.empty() ? -1 : compare_lengths(x, all.front());
  if (order > 0) return;
  if (order == 0 && std::any_of(all.begin(), all.end(), [&](const auto& y) { return same_position(x, y); })) return;
  if (inside_ && probe_.overlaps(frame_.absolute(x))) return;
  if (order < 0) all.clear();
  all.push_back(x);
  if (order == 0) return;
  const double reached = length(view_.o.scaled(frame_.absolute(x)) - view_.from);
  bound_ = reached + view_.slack;
}

}  // namespace

NearestPositions nearest_positions(const FacetView& view, const ExactFrame& frame, DepthProbe& probe, bool inside,
                                   double time_limit) {
  return PositionSearch(view, frame, probe, inside).run(time_limit);
}

}  // namespace dymsum::depth
