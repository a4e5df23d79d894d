// What a growing disc sees of a region: its bridges and pockets, and how long they last. See
// docs/guide/shape-features.md. alpha is the diameter of the disc.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/result.h"

namespace dymsum {

/// How deep a vertex lies in the pocket of a bridge.
enum class Concavity : std::uint8_t {
  straight_line,  ///< its distance to the line of the bridge
  shortest_path,  ///< the length of the shortest path to the bridge inside the pocket
  hybrid1,        ///< shortest_path where an edge of the pocket runs backwards along the bridge, else straight_line
  hybrid2,        ///< straight_line where that is larger than hybrid_tolerance anywhere, else shortest_path
};

struct FeatureOptions {
  Concavity concavity = Concavity::straight_line;
  double hybrid_tolerance = 0;  ///< of hybrid2
  int threads = 0;              ///< 0: as many as there are
  Progress progress = {};       ///< asked in the stages "complex" and "bars" (see progress.h)
};

/// The life of a corner of the sum with a growing disc. Events are numbered by their diameters: equal numbers are
/// exactly equal diameters.
struct FeatureBar {
  enum class Birth : std::uint8_t {
    corner,  ///< at diameter 0, at a reflex vertex of the region
    neck,    ///< one of two, between places opposite each other
  };
  enum class Death : std::uint8_t {
    merged,  ///< into another bar, `parent`
    filled,  ///< the pocket or hole is full
    never,   ///< it goes on to an edge of the convex hull
  };
  Birth born = Birth::corner;
  Death died = Death::never;
  std::uint32_t birth = 0;                  ///< event
  std::optional<std::uint32_t> death;       ///< event; none: never
  double birth_alpha = 0, death_alpha = 0;  ///< diameters, the nearest doubles; infinity for never
  std::optional<std::uint32_t> parent;      ///< of a bar that merged
  std::optional<std::uint32_t> vertex;      ///< of the region: where a corner is born
  std::optional<std::uint32_t> minimum;     ///< vertex of the region: the pocket minimum; none of gaps
  double concavity = 0;    ///< of the minimum where the bar dies; by the straight line the double nearest to it
  double counts_from = 0;  ///< the diameter from which significant() counts its life, rounded
  /// How much the bar counts: see ShapeFeatures::significant. The nearest double; infinity for gaps that never end.
  double significance = 0;
  bool in_hole = false;    ///< its disc touches the ring of a hole
  std::uint32_t loop = 0;  ///< boundary ring of its minimum: outer ring, then holes, part by part
  friend bool operator==(const FeatureBar&, const FeatureBar&) = default;
};

/// A point at which a disc touches the region.
struct BridgeContact {
  bool at_vertex = false;
  std::uint32_t index = 0;  ///< vertex or edge of the region
  Point at;                 ///< rounded
};

/// The segment between the two contacts of a disc.
struct AlphaBridge {
  BridgeContact from, to;  ///< the pocket lies to the left
  Point centre;            ///< of the disc, rounded
  bool gap = false;        ///< between two boundary rings: there is no pocket
  double length = 0;
  std::uint32_t bar = 0;
  std::optional<std::uint32_t> minimum;  ///< vertex of the region
  double concavity = 0;
  std::uint32_t pocket_size = 0;  ///< vertices of the pocket between the contacts
};

/// All events and bars of a region, made at once. A value: copies share what they hold.
class ShapeFeatures {
 public:
  /// Discs outside of the region. Births, deaths and their order are exact. Errors: unsupported_operand where polylines
  /// cross or run along each other, or the region is empty; out_of_range for coordinates beyond 2^1000 and a tolerance
  /// that is negative or no number; cancelled where the options' progress stops it. O(n log n) in practice.
  static Result<ShapeFeatures> create(const Region& region, const FeatureOptions& options = {});

  const Region& region() const;
  /// Those of create() without the progress.
  const FeatureOptions& options() const;
  /// The bars in the order of their births; of equal ones in an order that rigid motions and reflections keep. Where
  /// bars meet, the one goes on whose pocket holds the minimum; ties are decided by the region's geometry, too.
  const std::vector<FeatureBar>& bars() const;
  std::uint32_t event_count() const;
  /// The diameter, the nearest double. Requires: event < event_count() (else std::invalid_argument).
  double event_alpha(std::uint32_t event) const;
  /// The diameter as a formula of integers, + - * / and sqrt().
  std::string event_text(std::uint32_t event) const;

  /// The bridges of diameter alpha: at an event those that end there, or go on, and those that are born there. Those of
  /// diameter 0 are the reflex vertices; above all events, the edges of the convex hull that are not in the boundary.
  /// Errors: out_of_range for negative alpha.
  Result<std::vector<AlphaBridge>> bridges(const Rational& alpha) const;

  /// Bars that last at least `life` between the diameters `from` and `to` (none: infinity), the longest first, of
  /// equally long ones the deeper first, then the earlier bar. Decided exactly.
  std::vector<std::uint32_t> lasting(const Rational& life, const Rational& from = {},
                                     const std::optional<Rational>& to = std::nullopt) const;

  /// The bars of lasting(), but by significance, in length and in order: a pocket is as significant as the lesser of
  /// how deep it is where the bar dies and of how long it lasts there, counted from `counts_from`; so a shallow notch
  /// is not kept however wide it is, and a dent takes nothing from a deep pocket that it meets. A life counts from the
  /// oldest that the bar has met, but at every meeting a pocket of depth c is at most 4 c old. Of two pockets that meet
  /// one goes on; the other counts as much as the less significant of both. A neck that opens again counts as much as
  /// it is narrower than what is full behind it. Gaps count with their lives. Decided exactly for depths as doubles.
  /// Noise moves significances as little as itself, to a factor that docs/design/shape-features.md states.
  std::vector<std::uint32_t> significant(const Rational& significance, const Rational& from = {},
                                         const std::optional<Rational>& to = std::nullopt) const;

  struct State;

 private:
  friend struct ShapeFeaturesAccess;  // the library's own look at what is held
  explicit ShapeFeatures(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

}  // namespace dymsum
