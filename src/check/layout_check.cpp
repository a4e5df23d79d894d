#include "dymsum/layout_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "base/double_text.h"
#include "base/poll.h"
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
    std::sort(check_.faults.begin(), check_.faults.end(), worse);
    if (layout_.container) check_.density = area_of_parts() / area(*layout_.container);
    return std::move(check_);
  }

 private:
  static bool worse(const LayoutFault& a, const LayoutFault& b) {
    if (a.kind != b.kind) return a.kind < b.kind;
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
    turned_.push_back({std::move(sum), std::move(interior)});
    return it->second;
  }

  void move_parts() {
    for (std::uint32_t k = 0; k < layout_.parts.size(); ++k) {
      const LayoutPart& part = layout_.parts[k];
      if (part.shape >= layout_.shapes.size())
        throw Refused{{ErrorCode::bad_index, "part " + std::to_string(k) + " has a shape that is not there", {}}};
      turned_of_.push_back(turned_index(part));
      sets_.emplace_back(turned_[turned_of_.back()].interior,
                         planar::homogeneous({exact::exact_value(part.at.x), exact::exact_value(part.at.y)}), k + 1);
    }
  }

  void add_fault(LayoutFault::Kind kind, std::uint32_t part, std::uint32_t other, const depth::PlaneNearest& nearest,
                 Point at) {
    LayoutFault fault;
    fault.kind = kind;
    fault.part = part;
    fault.other = other;
    fault.at = at;
    if (nearest.moves.empty()) {
      fault.distance = std::numeric_limits<double>::infinity();
    } else {
      fault.squared = exact::to_rational(nearest.squared);
      fault.distance = exact::root_to_double(nearest.squared);
      fault.move = {exact::to_rational(nearest.moves[0][0]), exact::to_rational(nearest.moves[0][1])};
    }
    check_.faults.push_back(std::move(fault));
  }

  bool is_less(const depth::PlaneNearest& nearest, double distance) const {
    const exact::BigRational d = exact::exact_value(distance);
    return nearest.squared < exact::BigRational(d * d);
  }

  void check_container() {
    const PlacedSet outside(OpenSet::outside(turned(*layout_.container, Orientation())), {0, 0, 1}, 0);
    std::map<std::uint32_t, PlanarSum> fits;
    for (std::uint32_t k = 0; k < sets_.size(); ++k) {
      if (sets_[k].set().edges().empty()) continue;
      const std::optional<Point> position = common_position(sets_[k], outside);
      if (!position && !(options_.margin > 0)) continue;
      PlanarSum& fit = fits[turned_of_[k]];
      if (exact_source(fit) == nullptr) fit = required(erode(*layout_.container, turned_[turned_of_[k]].sum));
      const depth::PlaneNearest nearest = depth::nearest_on_boundary(fit, layout_.parts[k].at);
      if (position) add_fault(LayoutFault::Kind::outside, k, kContainer, nearest, *position);
      else if (is_less(nearest, options_.margin))
        add_fault(LayoutFault::Kind::too_near, k, kContainer, nearest, corner_of(k));
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
    const std::optional<Point> position = common_position(sets_[part], sets_[other]);
    if (!position && !(options_.spacing > 0)) return;
    PlanarSum& sum = no_fits_[{turned_of_[other], turned_of_[part]}];
    if (exact_source(sum) == nullptr)
      sum = required(nfp(turned_[turned_of_[other]].sum, turned_[turned_of_[part]].sum));
    const RationalPoint &a = layout_.parts[part].at, &b = layout_.parts[other].at;
    const depth::PlaneNearest nearest = depth::nearest_on_boundary(sum, {a.x - b.x, a.y - b.y});
    if (position) add_fault(LayoutFault::Kind::overlap, part, other, nearest, *position);
    else if (is_less(nearest, options_.spacing))
      add_fault(LayoutFault::Kind::too_near, part, other, nearest, corner_of(part));
  }

  const Layout& layout_;
  const LayoutCheckOptions& options_;
  std::map<std::pair<std::uint32_t, std::string>, std::uint32_t> known_;
  std::vector<TurnedShape> turned_;
  std::vector<std::uint32_t> turned_of_;  // part -> turned shape
  std::vector<PlacedSet> sets_;           // by parts
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
