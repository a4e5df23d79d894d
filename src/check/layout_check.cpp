#include "dymsum/layout_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "base/double_text.h"
#include "base/poll.h"
#include "check/extent.h"
#include "check/gap.h"
#include "check/inner_discs.h"
#include "depth/planar_depth.h"
#include "dymsum/orientation_sum.h"
#include "dymsum/planar_operand.h"
#include "exact/big.h"
#include "placement/boundary_meetings.h"
#include "planar/position/exact_source.h"

namespace dymsum {
namespace {

using placement::Interval;
using placement::OpenSet;
using placement::PlacedSet;

constexpr std::uint32_t kContainer = LayoutFault::kContainer;

/// A shape in one orientation.
struct TurnedShape {
  PlanarSum sum;
  std::shared_ptr<const OpenSet> interior;
  check::EdgeTree edges;
  check::Extent extent;
  std::uint32_t shape;
  double radians;
  std::optional<check::InnerDiscs> discs;  ///< where they were looked for
};

/// Two parts that overlap.
struct Overlap {
  std::uint32_t part, other;
  Point at;
  double at_most;  ///< of the depth
};

/// An error that ends a check.
struct Refused {
  Error error;
};
template <class T>
T required(Result<T> result) {
  if (!result) throw Refused{result.error()};
  return std::move(result).value();
}

SumOptions regular_sums() {
  SumOptions options;
  options.semantics = Semantics::regular;
  return options;
}

PlanarSum turned(const Region& shape, const Orientation& by) {
  static const Region origin = Region::create({{}, {}, {Point{0, 0}}}).value();
  return required(by == Orientation() ? minkowski_sum(shape, origin, regular_sums())
                                      : rotated_sum(shape, origin, by, regular_sums()));
}

/// A position at which a piece of the boundary of one set lies in the other, or along it with both on one side.
std::optional<Point> position_in(const PlacedSet& set, const placement::Cover& cover) {
  for (const placement::EdgeCover& e : cover.edges) {
    const placement::EdgeOf edge{&set, e.edge};
    for (std::size_t k = 0; k < e.gaps.size(); ++k) {
      const placement::Gap& gap = e.gaps[k];
      if (!gap.covered && !(gap.along && !gap.right_covered)) continue;
      const placement::NearPoint from = k == 0 ? edge.from() : e.cuts[k - 1].near,
                                 to = k == e.cuts.size() ? edge.to() : e.cuts[k].near;
      return Point{from.x.midpoint() / 2 + to.x.midpoint() / 2, from.y.midpoint() / 2 + to.y.midpoint() / 2};
    }
  }
  return std::nullopt;
}

/// Where two open sets have points in common, if they do: some boundary of one lies in the other then, or all of it
/// along the other's, with both on one side.
std::optional<Point> common_position(const PlacedSet& a, const PlacedSet& b) {
  const std::array<placement::Cover, 2> covers = placement::covers(a, b);
  const std::optional<Point> position = position_in(a, covers[0]);
  return position ? position : position_in(b, covers[1]);
}

class LayoutChecker {
 public:
  LayoutChecker(const Layout& layout, const LayoutCheckOptions& options) : layout_(layout), options_(options) {}

  LayoutCheck run() {
    Poll poll(options_.progress);
    poll.stage("parts");
    move_parts();
    if (layout_.container) check_container();
    poll.stage("pairs");
    check_pairs(poll);
    poll.stage("depths");
    measure_overlaps(poll);
    std::sort(check_.faults.begin(), check_.faults.end(), worse);
    if (layout_.container) check_.density = area_of_parts() / area(*layout_.container);
    return std::move(check_);
  }

 private:
  static bool worse(const LayoutFault& a, const LayoutFault& b) {
    if (a.kind != b.kind) return a.kind < b.kind;
    if (a.measured != b.measured) return a.measured;
    if (!a.measured && a.at_most != b.at_most) return a.at_most > b.at_most;
    const bool near = a.kind == LayoutFault::Kind::too_near;
    if (const bool fits = std::isfinite(a.distance); fits != std::isfinite(b.distance)) return !fits;
    if (a.squared != b.squared) return near ? a.squared < b.squared : a.squared > b.squared;
    return std::pair(a.part, a.other) < std::pair(b.part, b.other);
  }

  double area_of_parts() const {
    double sum = 0;
    for (const LayoutPart& part : layout_.parts) sum += area(layout_.shapes[part.shape]);
    return sum;
  }

  std::uint32_t turned_index(const LayoutPart& part) {
    const Orientation& o = part.orientation;
    const auto [it, added] =
        known_.try_emplace({part.shape, o.is_half_turn() ? std::string("inf") : o.tan_half().to_string()},
                           static_cast<std::uint32_t>(turned_.size()));
    if (!added) return it->second;
    PlanarSum sum = turned(layout_.shapes[part.shape], o);
    std::shared_ptr<const OpenSet> interior = OpenSet::inside(sum);
    check::EdgeTree edges(check::edges_of(sum));
    check::Extent extent(edges);
    turned_.push_back(
        {std::move(sum), std::move(interior), std::move(edges), extent, part.shape, o.radians(), std::nullopt});
    return it->second;
  }

  void move_parts() {
    for (std::uint32_t k = 0; k < layout_.parts.size(); ++k) {
      const LayoutPart& part = layout_.parts[k];
      if (part.shape >= layout_.shapes.size())
        throw Refused{{ErrorCode::bad_index, "part " + std::to_string(k) + " has a shape that is not there", {}}};
      turned_of_.push_back(turned_index(part));
      moves_.push_back(planar::homogeneous({exact::exact_value(part.at.x), exact::exact_value(part.at.y)}));
      sets_.emplace_back(turned_[turned_of_.back()].interior, moves_.back(), k + 1);
    }
  }

  LayoutFault fault(LayoutFault::Kind kind, std::uint32_t part, std::uint32_t other, Point at) const {
    LayoutFault made;
    made.kind = kind;
    made.part = part;
    made.other = other;
    made.at = at;
    return made;
  }

  void add_fault(LayoutFault fault, const depth::PlaneNearest& nearest) {
    if (nearest.moves.empty()) {
      fault.distance = std::numeric_limits<double>::infinity();
    } else {
      fault.squared = exact::to_rational(nearest.squared);
      fault.distance = exact::root_to_double(nearest.squared);
      fault.move = {exact::to_rational(nearest.moves[0][0]), exact::to_rational(nearest.moves[0][1])};
    }
    fault.at_most = fault.distance;
    check_.faults.push_back(std::move(fault));
  }

  /// Where the boundary of a part, its own index, and that of what is around it are nearer than a distance.
  void add_gap(std::uint32_t part, std::uint32_t other, const check::EdgeTree& edges,
               const exact::HomogeneousPoint& move, double least) {
    const std::optional<check::Gap> gap = check::gap_between(edges, turned_[turned_of_[part]].edges, move, least);
    const exact::BigRational d = exact::exact_value(least);
    if (!gap || exact::BigRational(gap->squared.num, gap->squared.den) >= d * d) return;
    LayoutFault near = fault(LayoutFault::Kind::too_near, part, other, corner_of(part));
    const exact::BigRational squared(gap->squared.num, gap->squared.den);
    near.squared = exact::to_rational(squared);
    near.distance = near.at_most = exact::root_to_double(squared);
    const auto of = [](const exact::BigInteger& p, const exact::BigInteger& w) {
      return exact::to_rational(exact::BigRational(p, w));
    };
    const exact::HomogeneousPoint &a = gap->of_a->exact, &b = gap->of_b->exact;
    near.move = {of(a.x, a.w) - of(b.x, b.w), of(a.y, a.w) - of(b.y, b.w)};
    check_.faults.push_back(std::move(near));
  }

  void check_container() {
    const PlanarSum container = turned(*layout_.container, Orientation());
    const PlacedSet outside(OpenSet::outside(container), {0, 0, 1}, 0);
    const check::EdgeTree edges(check::edges_of(container));
    std::map<std::uint32_t, PlanarSum> fits;
    for (std::uint32_t k = 0; k < sets_.size(); ++k) {
      if (sets_[k].set().edges().empty()) continue;
      if (const std::optional<Point> position = common_position(sets_[k], outside)) {
        PlanarSum& fit = fits[turned_of_[k]];
        if (exact_source(fit) == nullptr) fit = required(erode(*layout_.container, turned_[turned_of_[k]].sum));
        add_fault(fault(LayoutFault::Kind::outside, k, kContainer, *position),
                  depth::nearest_on_boundary(fit, layout_.parts[k].at));
      } else if (options_.margin > 0) {
        add_gap(k, kContainer, edges, moves_[k], options_.margin);
      }
    }
  }

  Point corner_of(std::uint32_t part) const { return {sets_[part].box()[0], sets_[part].box()[1]}; }

  // Parts by their left ends; those whose boxes end to the left of the next one are dropped.
  void check_pairs(const Poll& poll) {
    std::vector<std::uint32_t> order, active;
    for (std::uint32_t k = 0; k < sets_.size(); ++k)
      if (!sets_[k].set().edges().empty()) order.push_back(k);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(sets_[a].box()[0], a) < std::pair(sets_[b].box()[0], b);
    });
    const auto reach = [&](double end) { return (Interval(end) + Interval(options_.spacing)).high(); };
    for (std::size_t i = 0; i < order.size(); ++i) {
      const std::uint32_t k = order[i];
      const std::array<double, 4>& box = sets_[k].box();
      std::erase_if(active, [&](std::uint32_t a) { return reach(sets_[a].box()[2]) < box[0]; });
      for (const std::uint32_t a : active) {
        const std::array<double, 4>& other = sets_[a].box();
        if (reach(other[3]) >= box[1] && reach(box[3]) >= other[1]) check_pair(std::max(a, k), std::min(a, k));
      }
      active.push_back(k);
      poll.at_test(i, order.size());
    }
  }

  void check_pair(std::uint32_t part, std::uint32_t other) {
    ++check_.pairs;
    TurnedShape &own = turned_[turned_of_[part]], &its = turned_[turned_of_[other]];
    const Interval dx = sets_[part].move().x - sets_[other].move().x, dy = sets_[part].move().y - sets_[other].move().y;
    const double bound = check::depth_bound(its.extent, own.extent, dx, dy);
    std::optional<Point> position =
        bound > width_of(part, other) / 8 ? position_in_discs(its, own, dx, dy) : std::nullopt;
    if (position)
      position = Point{position->x + sets_[other].move().x.midpoint(), position->y + sets_[other].move().y.midpoint()};
    else position = common_position(sets_[part], sets_[other]);
    if (position) {
      overlaps_.push_back({part, other, *position, bound});
    } else if (options_.spacing > 0) {
      const exact::HomogeneousPoint &a = moves_[part], &b = moves_[other];
      add_gap(part, other, its.edges, {a.x * b.w - b.x * a.w, a.y * b.w - b.y * a.w, a.w * b.w}, options_.spacing);
    }
  }

  /// The least side of the boxes of two parts.
  double width_of(std::uint32_t part, std::uint32_t other) const {
    const std::array<double, 4>&a = sets_[part].box(), &b = sets_[other].box();
    return std::min({a[2] - a[0], a[3] - a[1], b[2] - b[0], b[3] - b[1]});
  }

  /// Relative to the first.
  std::optional<Point> position_in_discs(TurnedShape& a, TurnedShape& b, const Interval& dx, const Interval& dy) {
    for (TurnedShape* shape : {&a, &b})
      if (!shape->discs) shape->discs = discs_of(shape->shape).turned(shape->radians);
    return check::common_position(*a.discs, *b.discs, dx, dy);
  }
  const check::InnerDiscs& discs_of(std::uint32_t shape) {
    const auto found = discs_.find(shape);
    if (found != discs_.end()) return found->second;
    const PlanarSum sum = turned(layout_.shapes[shape], Orientation());
    return discs_.emplace(shape, check::InnerDiscs(sum, check::EdgeTree(check::edges_of(sum)))).first->second;
  }

  /// The deepest overlaps: the others are bounded by less than what is found.
  void measure_overlaps(const Poll& poll) {
    std::sort(overlaps_.begin(), overlaps_.end(), [](const Overlap& a, const Overlap& b) {
      return a.at_most != b.at_most ? a.at_most > b.at_most : std::pair(a.part, a.other) < std::pair(b.part, b.other);
    });
    const std::size_t first = check_.faults.size();
    std::multiset<double> deepest;  // as many as are to be measured
    for (std::size_t k = 0; k < overlaps_.size(); ++k) {
      const Overlap& overlap = overlaps_[k];
      LayoutFault made = fault(LayoutFault::Kind::overlap, overlap.part, overlap.other, overlap.at);
      // Bounds are some ulps too large: of overlaps that are as deep as each other few are measured.
      constexpr double kNearly = 1 + 0x1p-30;
      if (deepest.size() == options_.measured && (deepest.empty() || overlap.at_most <= *deepest.begin() * kNearly)) {
        made.measured = false;
        made.at_most = overlap.at_most;
        check_.faults.push_back(std::move(made));
        continue;
      }
      poll.at_test(k, overlaps_.size());
      add_fault(std::move(made), depth_of(overlap.part, overlap.other));
      deepest.insert(check_.faults.back().distance);
      if (deepest.size() > options_.measured) deepest.erase(deepest.begin());
    }
    // What was measured beside the deepest ones is told as the others are.
    const auto begin = check_.faults.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(begin, check_.faults.end(), worse);
    for (auto it = begin; it != check_.faults.end(); ++it) {
      if (!it->measured || it - begin < static_cast<std::ptrdiff_t>(options_.measured)) continue;
      it->measured = false;
      it->squared = {};
      it->distance = 0;
      it->move = {};
    }
  }

  depth::PlaneNearest depth_of(std::uint32_t part, std::uint32_t other) {
    constexpr std::size_t kMostKept = 4096;
    if (no_fits_.size() > kMostKept) no_fits_.clear();
    PlanarSum& sum = no_fits_[{turned_of_[other], turned_of_[part]}];
    if (exact_source(sum) == nullptr)
      sum = required(nfp(turned_[turned_of_[other]].sum, turned_[turned_of_[part]].sum));
    const RationalPoint &a = layout_.parts[part].at, &b = layout_.parts[other].at;
    return depth::nearest_on_boundary(sum, {a.x - b.x, a.y - b.y});
  }

  const Layout& layout_;
  const LayoutCheckOptions& options_;
  std::map<std::pair<std::uint32_t, std::string>, std::uint32_t> known_;
  std::vector<TurnedShape> turned_;
  std::map<std::uint32_t, check::InnerDiscs> discs_;  // by shapes
  std::vector<std::uint32_t> turned_of_;              // part -> turned shape
  std::vector<PlacedSet> sets_;                       // by parts
  std::vector<exact::HomogeneousPoint> moves_;
  std::vector<Overlap> overlaps_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, PlanarSum> no_fits_;
  LayoutCheck check_;
};

std::optional<Error> distance_error(double distance, const char* what) {
  if (distance >= 0 && distance <= 0x1p400) return std::nullopt;
  return Error{ErrorCode::out_of_range,
               std::string("the ") + what + " must be from 0 to 2^400, not " + base::general_text(distance, 6),
               {}};
}

}  // namespace

Result<LayoutCheck> check_layout(const Layout& layout, const LayoutCheckOptions& options) {
  if (std::optional<Error> error = distance_error(options.spacing, "spacing")) return *std::move(error);
  if (std::optional<Error> error = distance_error(options.margin, "margin")) return *std::move(error);
  try {
    return LayoutChecker(layout, options).run();
  } catch (Refused& refused) {
    return std::move(refused.error);
  } catch (const Cancelled&) {
    return cancelled();
  }
}

}  // namespace dymsum
