#include "depth/nearest_positions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

#include "base/poll.h"
#include "depth/same_cell.h"

namespace dymsum::depth {

using spatial::length;
using spatial::Vec3;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Positions that are off by more are queried in integers only.
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
  enum class Known : std::uint8_t { nothing, free };
  void offer(const ExactPosition& x, std::uint32_t facet = DepthProbe::kNoFacet, Known known = Known::nothing);
  bool is_free(const ExactPosition& x, std::uint32_t facet);
  void offer_known();
  void remember();
  bool is_covered(Vec3 x, double off);
  double lower_bound(double distance) const { return distance > view_.slack ? distance - view_.slack : 0; }

  const FacetView& view_;
  const ExactFrame& frame_;
  DepthProbe& probe_;
  const bool inside_;
  std::priority_queue<SearchItem, std::vector<SearchItem>, std::greater<>> queue_;
  double bound_ = kInfinity;           // not less than the distance of result_.all
  std::vector<Vec3> found_;            // these, in doubles
  std::vector<std::uint32_t> facets_;  // on which they lie
  NearestPositions result_;
};

NearestPositions PositionSearch::run(double time_limit) {
  Stopwatch watch;
  if (inside_) offer_known();
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
  if (inside_) remember();
  return std::move(result_);
}

/// Positions that were the nearest free ones to another position are free.
void PositionSearch::offer_known() {
  const std::array<BigRational, 3> from = frame_.origin();
  for (const auto& [x, facet] : probe_.free())
    offer(frame_.position({x[0] - from[0], x[1] - from[1], x[2] - from[2]}), facet, Known::free);
}

void PositionSearch::remember() {
  std::vector<DepthProbe::Free> free;
  for (std::size_t k = 0; k < result_.all.size(); ++k) free.push_back({frame_.absolute(result_.all[k]), facets_[k]});
  if (!free.empty()) probe_.remember({view_.from, bound_ - 4 * view_.slack}, std::move(free));
}

/// Determined by doubles: a "no" says nothing. What may be one of the positions found, as their facets list them too,
/// is not queried in vain.
bool PositionSearch::is_covered(Vec3 x, double off) {
  if (view_.cover(x, x, off, length(x) + off)) return true;
  const auto may_be = [&](Vec3 found) { return length(x - found) <= 2 * (off + view_.slack); };
  return !std::any_of(found_.begin(), found_.end(), may_be) && probe_.provably_overlaps(view_.from + x, off);
}

void PositionSearch::open(std::uint32_t id) {
  const spatial::BoxTree& tree = view_.o.tree;
  const spatial::BoxTree::Node& node = tree.node(id);
  const auto push = [&](const SearchItem& item) {
    if (!(item.lower > bound_)) queue_.push(item);
  };
  if (!node.leaf()) {
    for (const std::uint32_t child : {node.left, node.right})
      if (!inside_ || !view_.cover(tree.node(child).box, bound_))
        push({lower_bound(distance(tree.node(child).box, view_.from)), child, false});
    return;
  }
  for (std::uint32_t k = node.first; k < node.last; ++k) {
    const std::uint32_t f = tree.item(k);
    if (!inside_ || !view_.cover(tree.box(f), bound_)) push({lower_bound(length(view_.nearest(f))), f, true});
  }
}

void PositionSearch::look_at(std::uint32_t f) {
  if (inside_ && view_.cover(view_.o.tree.box(f), bound_)) return;  // the bound is better than when it was listed
  ++result_.work.facets;
  const Vec3 at = view_.nearest(f);
  ++result_.work.candidates;
  if (!inside_ || !is_covered(at, view_.slack)) {
    const ExactPosition x = frame_.nearest(view_.o.facets[f]);
    offer(x, f);
    // Nothing else of the facet is as near as that.
    if (!result_.all.empty() && compare_lengths(x, result_.all.front()) >= 0) return;
  }
  if (inside_) look_for_free(f);
}

void PositionSearch::look_for_free(std::uint32_t f) {
  const FacetCandidates candidates(view_, frame_, f, bound_ + view_.slack);
  for (const FacetCandidate& c : candidates.all()) {
    if (c.lower > bound_) return;
    ++result_.work.candidates;
    if (c.off < kVague && is_covered(c.at, c.off)) continue;
    if (const std::optional<ExactPosition> x = candidates.exact(c)) offer(*x);
  }
}

/// Whether a position is free. Where it is in the same cell as one that was free, no collision test is needed.
bool PositionSearch::is_free(const ExactPosition& x, std::uint32_t facet) {
  const std::array<BigRational, 3> at = frame_.absolute(x);
  if (facet != DepthProbe::kNoFacet) {
    const Vec3 seen = view_.o.scaled(at) - view_.from;
    for (const auto& [other, of] : probe_.free())
      if (of != DepthProbe::kNoFacet && in_one_plane(view_, frame_, facet, of) &&
          same_cell(view_, frame_, facet, view_.o.scaled(other) - view_.from, seen))
        return true;
  }
  ++result_.work.collision_tests;
  return !probe_.overlaps(at);
}

/// Takes a position that is as near as any, and free or of the sum.
void PositionSearch::offer(const ExactPosition& x, std::uint32_t facet, Known known) {
  ++result_.work.exact_tests;
  std::vector<ExactPosition>& all = result_.all;
  const int order = all.empty() ? -1 : compare_lengths(x, all.front());
  if (order > 0) return;
  if (order == 0 && std::any_of(all.begin(), all.end(), [&](const auto& y) { return same_position(x, y); })) return;
  if (inside_ && known == Known::nothing && !is_free(x, facet)) return;
  if (order < 0) all.clear(), found_.clear(), facets_.clear();
  all.push_back(x), facets_.push_back(facet);
  found_.push_back(view_.o.scaled(frame_.absolute(x)) - view_.from);
  bound_ = length(found_.front()) + view_.slack;
}

}  // namespace

NearestPositions nearest_positions(const FacetView& view, const ExactFrame& frame, DepthProbe& probe, bool inside,
                                   double time_limit) {
  return PositionSearch(view, frame, probe, inside).run(time_limit);
}

}  // namespace dymsum::depth
