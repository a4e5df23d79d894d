// The points in which moving planes meet: exact points of (x, s), and their doubles.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "spatial/events/moving_facets.h"
#include "spatial/events/proved_overlap.h"

namespace dymsum::spatial {

/// The position x / w at the scale s / w; w > 0.
struct ExactMeeting {
  BigVector x;
  exact::BigInteger s, w;

  exact::BigRational scale() const { return exact::ratio(exact::Big(s), exact::Big(w)); }
};

using FourPlanes = std::array<const MovingPlane*, 4>;
/// The one point that four hyperplanes have in common; nothing where it is not one.
std::optional<ExactMeeting> meeting_of(const FourPlanes& planes);
/// The point at which a corner's line passes a hyperplane; nothing where it stays on one side or in it.
std::optional<ExactMeeting> meeting_of(const ScalingPair& all, SumPoint corner, const MovingPlane& plane);
/// Whether a corner stays in a hyperplane at all scales.
bool stays_in(const ScalingPair& all, SumPoint corner, const MovingPlane& plane);

/// Doubles near a point: every coordinate of x within `radius`, s within `s_radius`.
struct NearMeeting {
  Vec3 x;
  double s = 0;
  double radius = 0, s_radius = 0;
};
enum class Meets : std::uint8_t { no, near, unsure };
/// The same in doubles; `unsure` where these do not determine whether there is one point.
Meets meeting_near(const std::array<const PlaneRow*, 4>& rows, double span, NearMeeting& at);
Meets meeting_near(const ScalingPair& all, SumPoint corner, const PlaneRow& row, double span, NearMeeting& at);
NearMeeting near(const ExactMeeting& at);

/// The part of a facet in which a point of its plane lies.
struct PositionInFacet {
  bool holds = false;
  std::uint8_t on = 0;  ///< bit k: on the facet edge from corner k to k + 1
};
/// 1 where the facet provably holds a point of its plane, -1 where it provably does not, else 0.
int provably_holds(const MovingFacets& all, std::uint32_t facet, const NearMeeting& at);
/// Exact.
PositionInFacet position_in(const MovingFacets& all, std::uint32_t facet, const ExactMeeting& at,
                            const NearMeeting& near);

/// Facet edges and facets that are to meet in a point.
struct MeetingFeatures {
  std::initializer_list<std::uint32_t> facet_edges, facets;
};
/// Whether all of them hold a point of their planes: by doubles, no only where that is proved; and exactly.
bool may_hold(const MovingFacets& all, const MeetingFeatures& features, const NearMeeting& at);
bool hold(const MovingFacets& all, const MeetingFeatures& features, const ExactMeeting& at, const NearMeeting& near);

/// Two facet edges that cross at all scales, in one plane: where their crossing is at both ends of a window, in
/// doubles. Its position is a linear function of the scale: what holds at both ends of a window of the sides of a
/// hyperplane holds between them.
struct LastingCrossing {
  bool misses = false;  ///< provably beyond an end of a facet edge at all scales of the window
  bool known = false;   ///< the positions are
  std::array<Vec3, 2> at;
  std::array<double, 2> scale{};
  double blur = 0;  ///< of every coordinate

  /// Whether the crossing provably stays on one side of a hyperplane.
  bool stays_beside(const PlaneRow& row) const;
};

/// The crossing of facet edges in one plane that are not parallel, at scales from `low` to `high`.
LastingCrossing lasting_crossing_of(const MovingFacets& all, const SumEdge& one, const SumEdge& other, double low,
                                    double high);

// The points at which features meet in a window of scales, each once, and what is known to be covered.

struct MeetingEvent {
  ExactMeeting at;
  NearMeeting near;
};

class MeetingList {
 public:
  /// A list of meetings at scales from `low` to `high`, of a sum of that span. Keeps the reference.
  MeetingList(const ScaledOverlap& overlap, double low, double high, double span)
      : overlap_(overlap), low_(low), high_(high), span_(span) {}

  bool is_beside_window(const NearMeeting& at) const { return at.s < low_ - at.s_radius || at.s > high_ + at.s_radius; }
  /// Whether the doubles of an exact point are in the window.
  bool is_in_window(const NearMeeting& at) const {
    return at.s >= low_ * (1 - 0x1p-50) && at.s <= high_ * (1 + 0x1p-50);
  }
  /// Whether all of the cell of (x, s) around a point provably lies in the open sum. Many tuples meet in one point, and
  /// query it.
  bool is_covered(const NearMeeting& at);
  /// Lists a point unless it is not in the window, provably covered or listed already.
  void add(ExactMeeting at);
  std::vector<MeetingEvent> take() { return std::move(found_); }

 private:
  using GridCell = std::array<std::int64_t, 4>;
  struct GridCellHash {
    std::size_t operator()(const GridCell& cell) const {
      std::uint64_t h = 0;
      for (const std::int64_t c : cell) {
        h ^= static_cast<std::uint64_t>(c) + 0x9e3779b97f4a7c15ULL + (h << 6) + (h >> 2);
        h ^= h >> 31, h *= 0x7fb5d329728ea185ULL, h ^= h >> 29;
      }
      return h;
    }
  };

  const ScaledOverlap& overlap_;
  double low_, high_, span_;
  std::vector<MeetingEvent> found_;
  std::unordered_multimap<GridCell, std::size_t, GridCellHash> found_at_;  // by their doubles
  std::unordered_map<GridCell, bool, GridCellHash> covered_;  // small cells of (x, s), provably or perhaps not
  std::unordered_set<GridCell, GridCellHash> covered_at_;     // doubles of points that provably are
};

}  // namespace dymsum::spatial
