#include "cspace/queries/nearest_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

namespace dymsum::cspace {
namespace {

constexpr std::uint32_t kLeaf = 4;
constexpr double kLongest = 0.1;  // radians: boxes of longer intervals are mostly empty
constexpr double kFullTurn = 2 * std::numbers::pi;

using Box = std::array<Range, 3>;  // x, y, theta

Box join(const Box& a, const Box& b) { return {join(a[0], b[0]), join(a[1], b[1]), join(a[2], b[2])}; }

// The error of half a width, relatively: the difference from the midpoint, which is a double itself. No input shows it:
// boxes are wider by far more (kIntervalBox), and searches add what positions err by.
constexpr double kHalf = exact::rounding_bound(1, 2);

double midpoint(Range r) { return r.low / 2 + r.high / 2; }
double half(Range r) { return std::max(r.high - midpoint(r), midpoint(r) - r.low) * (1 + kHalf); }

// Splits intervals, by their indices, until few are left.
class Builder {
 public:
  Builder(const std::vector<Box>& boxes, double weight, std::vector<PatchTree::Node>& nodes)
      : boxes_(boxes), weight_(weight), nodes_(nodes), order(boxes.size()) {
    std::iota(order.begin(), order.end(), 0u);
    nodes_.emplace_back();
    fill(0, 0, static_cast<std::uint32_t>(order.size()));
  }

 private:
  struct Group {
    std::uint32_t first = 0, last = 0;
  };

  Box around(Group g) const {
    Box box = boxes_[order[g.first]];
    for (std::uint32_t k = g.first; k < g.last; ++k) box = join(box, boxes_[order[k]]);
    return box;
  }

  std::uint32_t split(Group g) {
    const Box box = around(g);
    const std::array<double, 3> extent{box[0].high - box[0].low, box[1].high - box[1].low,
                                       weight_ * (box[2].high - box[2].low)};
    const std::size_t axis = static_cast<std::size_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
    const std::uint32_t center = (g.first + g.last) / 2;
    const auto key = [&](std::uint32_t k) { return boxes_[k][axis].low + boxes_[k][axis].high; };
    std::nth_element(order.begin() + g.first, order.begin() + center, order.begin() + g.last,
                     [&](std::uint32_t a, std::uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
    return center;
  }

  void fill(std::uint32_t node, std::uint32_t first, std::uint32_t last) {
    std::vector<Group> groups{{first, last}};
    while (groups.size() < PatchTree::kWide) {
      const auto most = std::max_element(groups.begin(), groups.end(), [](const Group& a, const Group& b) {
        return a.last - a.first < b.last - b.first;
      });
      if (most->last - most->first <= kLeaf) break;
      const Group whole = *most;
      const std::uint32_t center = split(whole);
      *most = {whole.first, center};
      groups.push_back({center, whole.last});
    }
    for (std::size_t k = 0; k < PatchTree::kWide; ++k) set(node, k, k < groups.size() ? groups[k] : Group{});
  }

  void set(std::uint32_t node, std::size_t k, Group g) {
    if (g.first == g.last) {
      nodes_[node].x_half[k] = -std::numeric_limits<double>::infinity();
      return;
    }
    const Box box = around(g);
    PatchTree::Node& n = nodes_[node];
    n.x[k] = midpoint(box[0]), n.x_half[k] = half(box[0]);
    n.y[k] = midpoint(box[1]), n.y_half[k] = half(box[1]);
    n.theta[k] = midpoint(box[2]), n.theta_half[k] = half(box[2]);
    n.first[k] = g.first;
    n.count[k] = g.last - g.first;
    if (n.count[k] <= kLeaf) {
      // How nth_element leaves them differs from library to library.
      std::sort(order.begin() + g.first, order.begin() + g.last);
      return;
    }
    n.count[k] = 0;
    const std::uint32_t child = n.first[k] = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    fill(child, g.first, g.last);
  }

  const std::vector<Box>& boxes_;
  double weight_;
  std::vector<PatchTree::Node>& nodes_;

 public:
  std::vector<std::uint32_t> order;
};

double outside(double midpoint, double half, double v) { return std::max(0.0, std::abs(v - midpoint) - half); }
// Midpoints are at most a little more than half a turn from 0, and so is v.
double angle_outside(double midpoint, double half, double v) {
  const double off = std::abs(v - midpoint);
  return std::max(0.0, std::min(off, std::abs(kFullTurn - off)) - half);
}
double squared(double v) { return v * v; }

}  // namespace

PatchTree::PatchTree(const CspaceObstacle& obstacle, const PatchForms& forms, double weight) {
  const std::vector<PatchInterval> found = make_intervals(obstacle, forms, kLongest);
  std::vector<Box> boxes;
  std::vector<Slab> slabs;
  for (const PatchInterval& s : found) {
    const IntervalBox box = box_of(forms, s);
    boxes.push_back({box.at.x, box.at.y, box.theta});
    slabs.push_back(
        {box.along, midpoint(box.u), half(box.u), midpoint(box.v), half(box.v), midpoint(box.theta), half(box.theta)});
  }
  const Builder builder(boxes, weight, nodes_);
  for (const std::uint32_t k : builder.order) {
    intervals_.push_back(found[k]);
    slabs_.push_back(slabs[k]);
  }
}

std::size_t PatchTree::bytes() const {
  return nodes_.size() * sizeof(Node) + intervals_.size() * (sizeof(PatchInterval) + sizeof(Slab));
}

std::array<double, PatchTree::kWide> square_distances(const PatchTree::Node& node, Point at, double theta,
                                                      double weight) {
  std::array<double, PatchTree::kWide> all;
  for (std::size_t k = 0; k < PatchTree::kWide; ++k) {
    const double x = outside(node.x[k], node.x_half[k], at.x), y = outside(node.y[k], node.y_half[k], at.y);
    all[k] = x * x + y * y + squared(weight * angle_outside(node.theta[k], node.theta_half[k], theta));
  }
  return all;
}

double square_distance(const PatchTree::Slab& slab, Point at, double theta, double weight) {
  const double u = outside(slab.u, slab.u_half, dot(slab.along, at));
  const double v = outside(slab.v, slab.v_half, cross(slab.along, at));
  return u * u + v * v + squared(weight * angle_outside(slab.theta, slab.theta_half, theta));
}

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
// The error of a position or an angle is this times the sizes of both: hinges, lines, positions on them and the
// distance, 16 to 64 each (patch_forms.cpp, end_curve.cpp, interval_distance.cpp).
constexpr double kPosition = exact::rounding_bound(4 * 64, 1024);
// The error of the angle of a question from an interval's reference: both doubles (8 each), their difference and that
// from the midpoint (4 each, as they are below 8), a turn (3) and the sum with the midpoint (1).
constexpr double kAngle = exact::rounding_bound(2 * 8 + 2 * 4 + 3 + 1, 32);
// Parts that are shorter, relatively or absolutely, are not halved any more; what they leave open is part of the error.
constexpr double kShortPart = 0x1p-46, kShortest = 0x1p-80;
constexpr double kGoodFraction = 1 - 0x1p-30;  // any fraction is right
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::uint64_t kMostBounds = 20000;  // what is left open then is part of the error

struct Task {
  enum class Kind : std::uint32_t { node, interval, part };
  double square = 0;  // lower bound
  Kind kind = Kind::node;
  std::uint32_t index = 0;  // of a node, an interval or a part
  /// Least first on a heap; of equals always the same one, so that of positions equally near the same one is found
  /// everywhere.
  friend bool operator<(const Task& a, const Task& b) {
    return a.square != b.square ? a.square > b.square : std::pair(a.kind, a.index) > std::pair(b.kind, b.index);
  }
};

// x of an interval between low and high, best looked at on both sides of `split`.
struct BoxedPart {
  std::uint32_t interval = 0;
  double low = 0, high = 0, split = 0, off = 0;
};

// Positions and angles err by less than this, in the worst direction.
double position_error(const PatchForms& forms, const DistanceQuestion& q) {
  return kPosition * (forms.size() + std::abs(q.from.x) + std::abs(q.from.y) + q.weight);
}

// The point at x of an interval, `along` its edge.
void set_witness(const PatchForms& forms, const PatchInterval& s, double x, double along, NearestPatch& found) {
  const ContactLine& l = forms[s.patch].own;
  const SmallRotation t(x);
  const double c = s.c * t.c - s.s * t.s, sine = s.s * t.c + s.c * t.s;
  const auto turned = [&](Point v) { return Point{c * v.x - sine * v.y, sine * v.x + c * v.y}; };
  const Point foot = l.start.a + turned(l.start.b), e = l.turns ? turned(l.unit) : l.unit;
  found.patch = s.patch;
  found.at = {foot.x + along * e.x, foot.y + along * e.y};
  found.theta = std::remainder(s.reference + x, kTurn);
}

class Search {
 public:
  Search(const PatchForms& forms, const PatchTree& tree, const DistanceQuestion& question)
      : forms_(forms), tree_(tree), question_(question), slack_(position_error(forms, question)) {
    heap_.reserve(256);
  }

  NearestPatch run() {
    add_interval(first_guess());
    parts_.clear();
    heap_.clear();
    least_ = kInfinity;
    open(0);
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end());
      const Task task = heap_.back();
      heap_.pop_back();
      const double least = std::sqrt(task.square);
      if (least >= good_enough() || found_.bounds > kMostBounds) {
        least_ = std::min(least_, least);
        break;
      }
      if (task.kind == Task::Kind::node) open(task.index);
      else if (task.kind == Task::Kind::interval) add_interval(task.index);
      else halve(parts_[task.index]);
    }
    // Nothing is nearer than the least bound that is left; the nearest point errs by what its end does.
    const double below = found_.distance - std::min(least_, upper_);
    found_.error = std::max(below, upper_ - found_.distance) + slack_;
    if (found_.patch != Patch::kNone) set_witness(forms_, tree_.interval(interval_), x_, along_, found_);
    return found_;
  }

 private:
  // It is no use to be more exact than positions are known; what is left open is part of the error.
  double good_enough() const { return upper_ * kGoodFraction - 8 * slack_; }

  // An interval that is near, so that most others are never kept: down the tree by the nearest boxes.
  std::uint32_t first_guess() const {
    std::uint32_t node = 0;
    for (;;) {
      const PatchTree::Node& n = tree_.node(node);
      const auto squares = square_distances(n, question_.from, question_.theta, question_.weight);
      const auto least = std::min_element(squares.begin(), squares.end());
      const std::size_t k = static_cast<std::size_t>(least - squares.begin());
      if (n.count[k] == 0) {
        node = n.first[k];
        continue;
      }
      std::uint32_t best = n.first[k];
      for (std::uint32_t i = best + 1; i < n.first[k] + n.count[k]; ++i)
        if (to_slab(i) < to_slab(best)) best = i;
      return best;
    }
  }
  double to_slab(std::uint32_t interval) const {
    return square_distance(tree_.slab(interval), question_.from, question_.theta, question_.weight);
  }

  void push(double square, Task::Kind kind, std::uint32_t index) {
    if (!(square < upper2_)) return;
    heap_.push_back({square, kind, index});
    std::push_heap(heap_.begin(), heap_.end());
  }

  void open(std::uint32_t index) {
    const PatchTree::Node& node = tree_.node(index);
    const auto squares = square_distances(node, question_.from, question_.theta, question_.weight);
    for (std::size_t k = 0; k < PatchTree::kWide; ++k) {
      if (!(squares[k] < upper2_)) continue;
      if (node.count[k] == 0) {
        push(squares[k], Task::Kind::node, node.first[k]);
        continue;
      }
      for (std::uint32_t i = node.first[k]; i < node.first[k] + node.count[k]; ++i)
        push(to_slab(i), Task::Kind::interval, i);
    }
  }

  // An angle half a turn away counts either way round.
  void add_interval(std::uint32_t index) {
    const PatchInterval& s = tree_.interval(index);
    const double midpoint = (s.low + s.high) / 2;
    const double off = std::remainder(s.reference + midpoint - question_.theta, kTurn) - midpoint;
    add({index, s.low, s.high, 0, off});
    if (off + s.high > kTurn / 2 - kAngleMargin) add({index, s.low, s.high, 0, off - kTurn});
    if (off + s.low < -kTurn / 2 + kAngleMargin) add({index, s.low, s.high, 0, off + kTurn});
  }

  void halve(const BoxedPart part) {
    add({part.interval, part.low, part.split, 0, part.off});
    add({part.interval, part.split, part.high, 0, part.off});
  }

  void add(BoxedPart part) {
    ++found_.bounds;
    const PatchInterval& s = tree_.interval(part.interval);
    const IntervalDistance distance(forms_[s.patch], s, question_, part.off);
    const IntervalDistance::Bound bound = distance.lower(part.low, part.high, upper_);
    if (bound.distance >= upper_) return;
    take(part.interval, s, distance, bound.x);
    if (bound.distance >= good_enough()) {
      least_ = std::min(least_, bound.distance);
      return;
    }
    part.split = split_of(part, s, bound);
    if (too_short(part, s)) {
      least_ = std::min(least_, bound.distance);
    } else if (bound.splits) {
      halve(part);
    } else {
      parts_.push_back(part);
      push(bound.distance * bound.distance, Task::Kind::part, static_cast<std::uint32_t>(parts_.size() - 1));
    }
  }

  // Where doubles do not determine when the patch begins, a part of its own is left open.
  static double split_of(const BoxedPart& part, const PatchInterval& s, const IntervalDistance::Bound& bound) {
    const auto within = [&](double x) { return part.low < x && x < part.high; };
    if (bound.splits && within(bound.split)) return bound.split;
    if (bound.x < s.proved_low && within(s.proved_low)) return s.proved_low;
    if (bound.x > s.proved_high && within(s.proved_high)) return s.proved_high;
    return part.low + (part.high - part.low) / 2;
  }
  bool too_short(const BoxedPart& part, const PatchInterval& s) const {
    const double width = part.high - part.low;
    if (!(width > kShortPart * (std::abs(part.low) + std::abs(part.high)) && width > kShortest)) return true;
    return !question_.whole_edges && (part.high <= s.proved_low || part.low >= s.proved_high);
  }

  // Seen from outside, every point of an edge is one of the obstacle; else only what provably belongs to the patch
  // counts.
  void take(std::uint32_t index, const PatchInterval& s, const IntervalDistance& distance, double x) {
    if (!question_.whole_edges) {
      if (!(s.proved_low <= s.proved_high)) return;
      x = std::clamp(x, s.proved_low, s.proved_high);
    }
    const IntervalDistance::Nearest nearest = distance.nearest(x);
    if (!(nearest.distance + nearest.error < upper_)) return;
    upper_ = nearest.distance + nearest.error;
    upper2_ = upper_ * upper_;
    found_.distance = nearest.distance;
    interval_ = index;
    x_ = x;
    along_ = nearest.along;
    found_.patch = s.patch;
  }

  const PatchForms& forms_;
  const PatchTree& tree_;
  const DistanceQuestion& question_;
  double slack_;
  std::vector<Task> heap_;
  std::vector<BoxedPart> parts_;
  NearestPatch found_;
  double upper_ = kInfinity, upper2_ = kInfinity;  // the least distance known, with its error
  double least_ = kInfinity;                       // the least bound among what is not looked at any more
  std::uint32_t interval_ = 0;
  double x_ = 0, along_ = 0;
};

}  // namespace

NearestPatch nearest_patch(const PatchForms& forms, const PatchTree& tree, const DistanceQuestion& question) {
  return Search(forms, tree, question).run();
}

// Nearest boxes first; those of other angles are infinitely far.
NearestPatch nearest_patch_at(const PatchForms& forms, const PatchTree& tree, const DistanceQuestion& question) {
  NearestPatch best;
  double upper = kInfinity, upper2 = kInfinity, least = kInfinity;
  std::vector<Task> heap{{0, Task::Kind::node, 0}};
  heap.reserve(128);
  const auto push = [&](const Task& task, double theta, double half) {
    if (!(task.square < upper2) || std::abs(std::remainder(question.theta - theta, kTurn)) > half + kAngleMargin)
      return;
    heap.push_back(task);
    std::push_heap(heap.begin(), heap.end());
  };
  while (!heap.empty() && heap.front().square < upper2) {
    std::pop_heap(heap.begin(), heap.end());
    const Task task = heap.back();
    heap.pop_back();
    if (task.kind == Task::Kind::interval) {
      const PatchInterval& s = tree.interval(task.index);
      const double midpoint = (s.low + s.high) / 2;
      const double x = midpoint + std::remainder(question.theta - s.reference - midpoint, kTurn);
      ++best.bounds;
      const IntervalDistance distance(forms[s.patch], s, question, 0);
      IntervalDistance::Nearest n = distance.nearest(x);
      n.error += distance.drift(x, kAngle);
      least = std::min(least, n.distance - n.error);
      if (!(n.distance + n.error < upper)) continue;
      upper = n.distance + n.error;
      upper2 = upper * upper;
      best.distance = n.distance;
      set_witness(forms, s, x, n.along, best);
      continue;
    }
    const PatchTree::Node& node = tree.node(task.index);
    const auto squares = square_distances(node, question.from, question.theta, 0);
    for (std::size_t k = 0; k < PatchTree::kWide; ++k) {
      if (node.count[k] == 0) push({squares[k], Task::Kind::node, node.first[k]}, node.theta[k], node.theta_half[k]);
      for (std::uint32_t i = node.first[k]; squares[k] < upper2 && i < node.first[k] + node.count[k]; ++i) {
        const PatchTree::Slab& slab = tree.slab(i);
        push({square_distance(slab, question.from, question.theta, 0), Task::Kind::interval, i}, slab.theta,
             slab.theta_half);
      }
    }
  }
  best.error =
      std::max(best.distance - std::min(least, upper), upper - best.distance) + position_error(forms, question);
  return best;
}

}  // namespace dymsum::cspace
