#include "io/region/ring_order.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "dymsum/region_io.h"
#include "exact/orient.h"

namespace dymsum::io {
namespace {

bool lexicographically_less(Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

void orient(Ring& ring, int wanted) {
  if (ring_sign(ring) == -wanted) std::reverse(ring.begin() + 1, ring.end());
}

/// The rounded midpoint of two doubles, without overflow.
double midpoint(double a, double b) { return a / 2 + b / 2; }

class RingNester {
 public:
  explicit RingNester(std::vector<Ring> rings) : rings_(std::move(rings)), positions_(rings_.size()) {
    for (std::size_t i = 0; i < rings_.size(); ++i) measure(i);
  }

  bool nest() {
    // A ring around another starts no later in x and, where both start together, ends no earlier.
    std::vector<std::size_t> order(rings_.size()), active;
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) { return before(a, b); });
    for (const std::size_t i : order) {
      std::erase_if(active, [&](std::size_t j) { return positions_[j].high.x < positions_[i].low.x; });
      steps_ += active.size();
      for (const std::size_t j : active) {
        if (box_contains(positions_[j], positions_[i]) && contains(j, i)) {
          settle(i, j);
        } else if (box_contains(positions_[i], positions_[j]) && contains(i, j)) {  // boxes are equal
          settle(j, i);
        }
        if (steps_ > kMostSteps) return false;
      }
      active.push_back(i);
    }
    for (Position& position : positions_) {
      const auto shallower = [this](std::uint32_t a, std::uint32_t b) { return depth(a) < depth(b); };
      if (!position.around.empty())
        position.innermost = *std::max_element(position.around.begin(), position.around.end(), shallower);
    }
    return true;
  }

  /// Whether nonzero leaves out rings, or makes others parts and holes.
  bool winds_otherwise() {
    find_winding();
    for (std::size_t i = 0; i < rings_.size(); ++i)
      if (winding_[i].bounds != Bounds::nothing ? (winding_[i].bounds == Bounds::hole) != is_hole(i) : true)
        return true;
    return false;
  }

  std::vector<Part> parts(FillRule rule) const {
    std::vector<Part> parts;
    std::vector<std::size_t> part_of(rings_.size());
    for (std::size_t i = 0; i < rings_.size(); ++i) {
      if (bounds(i, rule) != Bounds::part) continue;
      part_of[i] = parts.size();
      parts.push_back({rings_[i], {}});
    }
    for (std::size_t i = 0; i < rings_.size(); ++i) {
      if (bounds(i, rule) == Bounds::hole) parts[part_of[part_around(i, rule)]].holes.push_back(rings_[i]);
    }
    for (Part& part : parts) orient_rings(part);
    return parts;
  }

 private:
  static constexpr std::uint64_t kMostSteps = 1'000'000'000;

  struct Position {
    Point low, high;
    std::vector<std::uint32_t> around;  ///< the rings around this one
    std::uint32_t innermost = 0;        ///< of them, where there are any
  };

  enum class Bounds { part, hole, nothing };
  struct Winding {
    int sign = 0;
    Bounds bounds = Bounds::part;
  };

  /// What rings bound where places are filled around which they wind. A ring without a sign bounds as even-odd has it.
  void find_winding() {
    winding_.resize(rings_.size());
    for (std::size_t i = 0; i < rings_.size(); ++i) winding_[i].sign = ring_sign(rings_[i]);
    for (std::size_t i = 0; i < rings_.size(); ++i) {
      int outside = 0;
      for (const std::uint32_t j : positions_[i].around) outside += winding_[j].sign;
      const bool filled_outside = outside != 0, filled_inside = outside + winding_[i].sign != 0;
      winding_[i].bounds = winding_[i].sign == 0             ? even_odd(i)
                           : filled_outside == filled_inside ? Bounds::nothing
                           : filled_inside                   ? Bounds::part
                                                             : Bounds::hole;
    }
  }

  Bounds even_odd(std::size_t i) const { return is_hole(i) ? Bounds::hole : Bounds::part; }
  Bounds bounds(std::size_t i, FillRule rule) const {
    return rule == FillRule::even_odd ? even_odd(i) : winding_[i].bounds;
  }
  /// The innermost part around a hole. There is one, unless rings cross.
  std::size_t part_around(std::size_t i, FillRule rule) const {
    std::size_t best = positions_[i].innermost;
    if (rule == FillRule::even_odd) return best;
    bool any = false;
    for (const std::uint32_t j : positions_[i].around) {
      if (bounds(j, rule) != Bounds::part || (any && depth(j) < depth(best))) continue;
      best = j;
      any = true;
    }
    return best;
  }

  void measure(std::size_t i) {
    Position& position = positions_[i];
    position.low = position.high = rings_[i].front();
    for (const Point p : rings_[i]) {
      position.low = {std::min(position.low.x, p.x), std::min(position.low.y, p.y)};
      position.high = {std::max(position.high.x, p.x), std::max(position.high.y, p.y)};
    }
  }

  bool before(std::size_t a, std::size_t b) const {
    const Position &p = positions_[a], &q = positions_[b];
    if (p.low.x != q.low.x) return p.low.x < q.low.x;
    if (p.high.x != q.high.x) return p.high.x > q.high.x;
    return a < b;
  }

  static bool box_contains(const Position& outer, const Position& inner) {
    return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && outer.high.x >= inner.high.x &&
           outer.high.y >= inner.high.y;
  }

  /// 1 inside, 0 on the boundary, -1 outside; exact.
  int side(std::size_t ring, Point p) {
    const Ring& r = rings_[ring];
    steps_ += r.size();
    bool inside = false;
    for (std::size_t k = 0, last = r.size() - 1; k < r.size(); last = k++) {
      const Point a = r[last], b = r[k];
      if (std::min(a.y, b.y) > p.y || std::max(a.y, b.y) < p.y || std::max(a.x, b.x) < p.x) continue;
      if (a.y == b.y) {
        if (std::min(a.x, b.x) <= p.x) return 0;
        continue;
      }
      const exact::SignAnswer answer = exact::cross_answer(a, b, a, p);
      if (answer.rung != exact::Rung::doubles) steps_ += answer.rung == exact::Rung::big ? 10'000 : 100;
      const int turn = answer.sign;
      if (turn == 0) return 0;
      // the edge crosses the ray to the right of p: half-open in y, p on the edge's left when it rises
      if ((a.y > p.y) != (b.y > p.y) && (turn > 0) == (b.y > a.y)) inside = !inside;
    }
    return inside ? 1 : -1;
  }

  /// Ring i against ring j: the first vertex, then the first edge midpoint, of i that is not on j decides.
  bool contains(std::size_t j, std::size_t i) {
    for (const Point p : rings_[i]) {
      if (const int answer = side(j, p); answer != 0) return answer > 0;
      if (steps_ > kMostSteps) return false;
    }
    for (std::size_t k = 0, last = rings_[i].size() - 1; k < rings_[i].size(); last = k++) {
      const Point a = rings_[i][last], b = rings_[i][k];
      if (const int answer = side(j, {midpoint(a.x, b.x), midpoint(a.y, b.y)}); answer != 0) return answer > 0;
      if (steps_ > kMostSteps) return false;
    }
    return false;
  }

  void settle(std::size_t inner, std::size_t outer) {
    positions_[inner].around.push_back(static_cast<std::uint32_t>(outer));
    steps_ += 50;  // bounds the memory of these lists
  }

  std::size_t depth(std::size_t i) const { return positions_[i].around.size(); }

  /// The second condition fails only for rings that cross others.
  bool is_hole(std::size_t i) const { return depth(i) % 2 == 1 && depth(positions_[i].innermost) % 2 == 0; }

  std::vector<Ring> rings_;
  std::vector<Position> positions_;
  std::vector<Winding> winding_;
  std::uint64_t steps_ = 0;
};

}  // namespace

int ring_sign(const Ring& ring) {
  if (ring.size() < 3) return 0;
  const Point corner = *std::min_element(ring.begin(), ring.end(), lexicographically_less);
  Point lowest = corner;  // the far end of the lowest ray so far; `corner` itself before the first
  int sign = 0;
  const auto consider = [&](Point end, int sign_of_ray) {
    if (end == corner) return;
    const int turn = lowest == corner ? -1 : exact::orient_sign(corner, lowest, end);
    if (turn < 0) {
      lowest = end;
      sign = sign_of_ray;
    } else if (turn == 0 && sign_of_ray != sign) {
      sign = 0;
    }
  };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (ring[i] != corner) continue;
    consider(ring[i + 1 < ring.size() ? i + 1 : 0], 1);
    consider(ring[i > 0 ? i - 1 : ring.size() - 1], -1);
  }
  return sign;
}

void orient_rings(Part& part) {
  orient(part.outer, 1);
  for (Ring& hole : part.holes) orient(hole, -1);
}

bool nest_rings(std::vector<Ring> rings, std::vector<Part>& parts, FillRule rule) {
  std::erase_if(rings, [](const Ring& ring) { return ring.empty(); });
  RingNester nester(std::move(rings));
  if (!nester.nest()) return false;
  std::vector<Part> nested = nester.parts(FillRule::even_odd);
  // No ring is left out where some cross, so that validation finds them.
  if (rule == FillRule::nonzero && nester.winds_otherwise() && Region::create({nested, {}, {}}))
    nested = nester.parts(FillRule::nonzero);
  parts.insert(parts.end(), std::make_move_iterator(nested.begin()), std::make_move_iterator(nested.end()));
  return true;
}

}  // namespace dymsum::io

namespace dymsum {

// Polylines joined where their ends are near each other.

namespace {

double apart(Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// End 2 i of line i is its first vertex, 2 i + 1 its last one.
class ChainJoiner {
 public:
  ChainJoiner(std::vector<Polyline> lines, double tolerance)
      : lines_(std::move(lines)), tolerance_(tolerance), mate_(2 * lines_.size(), kNone), used_(lines_.size()) {}

  /// Ends that are equal first, then those within the tolerance. The error where one has several others there.
  std::optional<Error> join() {
    for (const double most : {0.0, tolerance_})
      if (std::optional<Error> error = join_within(most)) return error;
    return std::nullopt;
  }

  /// Closed chains go to `rings`, others to `open`.
  void follow_all(std::vector<Ring>& rings, std::vector<Polyline>& open, JoinReport& report) {
    for (std::size_t end = 0; end < mate_.size(); ++end)
      if (mate_[end] == kNone && !used_[end / 2]) open.push_back(follow(end, report));
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (used_[i]) continue;
      Ring ring = follow(2 * i, report);
      add_joint(ring.back(), ring.front(), report);
      if (ring.front() == ring.back()) ring.pop_back();
      rings.push_back(std::move(ring));
    }
  }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};

  Point at(std::size_t end) const {
    const Polyline& line = lines_[end / 2];
    return end % 2 == 0 ? line.front() : line.back();
  }

  std::vector<std::size_t> free_ends() const {
    std::vector<std::size_t> ends;
    for (std::size_t end = 0; end < mate_.size(); ++end)
      if (mate_[end] == kNone) ends.push_back(end);
    std::sort(ends.begin(), ends.end(), [this](std::size_t a, std::size_t b) {
      return std::tuple(at(a).x, at(a).y, a) < std::tuple(at(b).x, at(b).y, b);
    });
    return ends;
  }

  std::optional<Error> join_within(double most) {
    const std::vector<std::size_t> ends = free_ends();
    for (std::size_t i = 0; i < ends.size(); ++i) {
      for (std::size_t j = i + 1; j < ends.size() && at(ends[j]).x - at(ends[i]).x <= most; ++j) {
        const std::size_t a = ends[i], b = ends[j];
        if (!(apart(at(a), at(b)) <= most) || is_too_short(a, b, most)) continue;
        if (mate_[a] != kNone || mate_[b] != kNone) return several(at(mate_[a] != kNone ? a : b));
        mate_[a] = b;
        mate_[b] = a;
      }
    }
    return std::nullopt;
  }

  /// The two ends of one segment that is no longer than the tolerance itself.
  bool is_too_short(std::size_t a, std::size_t b, double most) const {
    return most > 0 && a / 2 == b / 2 && lines_[a / 2].size() < 3;
  }

  static Error several(Point where) {
    Error error{ErrorCode::malformed, "more than two lines end within the tolerance of each other", {}};
    error.evidence.x = where.x;
    error.evidence.y = where.y;
    return error;
  }

  static void add_joint(Point from, Point to, JoinReport& report) {
    if (from == to) return;
    ++report.joints;
    report.largest_gap = std::max(report.largest_gap, apart(from, to));
  }

  /// The chain that begins with this end.
  Polyline follow(std::size_t end, JoinReport& report) {
    Polyline chain;
    while (end != kNone && !used_[end / 2]) {
      used_[end / 2] = true;
      Polyline line = std::move(lines_[end / 2]);
      if (end % 2 != 0) std::reverse(line.begin(), line.end());
      if (!chain.empty()) add_joint(chain.back(), line.front(), report);
      const bool meets = !chain.empty() && chain.back() == line.front();
      chain.insert(chain.end(), line.begin() + (meets ? 1 : 0), line.end());
      end = mate_[end ^ 1];
    }
    return chain;
  }

  std::vector<Polyline> lines_;
  double tolerance_;
  std::vector<std::size_t> mate_;
  std::vector<bool> used_;
};

}  // namespace

std::string JoinReport::to_string() const {
  std::string text = std::to_string(joints) + (joints == 1 ? " gap" : " gaps") + " between lines closed";
  if (joints > 0) {
    char width[32];
    std::snprintf(width, sizeof width, "%.3g", largest_gap);
    text += std::string(", the widest ") + width;
  }
  return text + "; " + std::to_string(rings) + (rings == 1 ? " ring" : " rings") + " made";
}

Result<JoinedChains> joined_chains(RegionData data, double tolerance) {
  if (!std::isfinite(tolerance) || tolerance < 0)
    return Error{ErrorCode::out_of_range, "the tolerance of joints has to be at least 0", {}};
  std::erase_if(data.polylines, [](const Polyline& line) { return line.empty(); });
  for (const Polyline& line : data.polylines)
    for (const Point p : line)
      if (!std::isfinite(p.x) || !std::isfinite(p.y))
        return Error{ErrorCode::not_finite, "a coordinate is not a finite number", {}};
  ChainJoiner joiner(std::exchange(data.polylines, {}), tolerance);
  if (std::optional<Error> error = joiner.join()) return *std::move(error);
  JoinReport report;
  std::vector<Ring> rings;
  joiner.follow_all(rings, data.polylines, report);
  report.rings = rings.size();
  std::vector<Part> parts;
  if (!io::nest_rings(std::move(rings), parts))
    return Error{ErrorCode::malformed, "too many rings around one another", {}};
  std::move(parts.begin(), parts.end(), std::back_inserter(data.parts));
  return JoinedChains{std::move(data), report};
}

}  // namespace dymsum
