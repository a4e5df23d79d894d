// Polylines joined where their ends are near each other.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "dymsum/region_io.h"
#include "io/region/ring_order.h"

namespace dymsum {
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
