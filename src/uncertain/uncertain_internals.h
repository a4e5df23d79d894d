// How the other files of this room make an Uncertain of its sets.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "dymsum/uncertain.h"

namespace dymsum {

struct UncertainInternals {
  static Uncertain pair(PlanarSum inner, PlanarSum outer, double error = 0) {
    Uncertain made;
    made.inner_ = std::make_shared<const PlanarSum>(std::move(inner));
    made.outer_ = std::make_shared<const PlanarSum>(std::move(outer));
    made.variants_ = std::make_shared<const std::vector<Region>>();
    made.error_ = error;
    return made;
  }
  /// One set, which both are.
  static Uncertain one(PlanarSum set, std::vector<Region> variants = {}, double error = 0) {
    Uncertain made;
    made.inner_ = made.outer_ = std::make_shared<const PlanarSum>(std::move(set));
    made.variants_ = std::make_shared<const std::vector<Region>>(std::move(variants));
    made.error_ = error;
    return made;
  }
  static Uncertain list(PlanarSum inner, PlanarSum outer, std::vector<Region> variants) {
    Uncertain made = pair(std::move(inner), std::move(outer));
    made.variants_ = std::make_shared<const std::vector<Region>>(std::move(variants));
    return made;
  }
  /// Both sets are one object: nothing has to be computed twice.
  static bool is_one(const Uncertain& u) { return u.inner_ == u.outer_; }
};

namespace uncertain {

/// The set as an operand: the region itself where it is the only variant, so that provenance has its indices.
inline PlanarOperand inner_operand(const Uncertain& u) {
  return u.variants().size() == 1 ? PlanarOperand(u.variants()[0]) : PlanarOperand(u.inner());
}
inline PlanarOperand outer_operand(const Uncertain& u) {
  return u.variants().size() == 1 ? PlanarOperand(u.variants()[0]) : PlanarOperand(u.outer());
}

inline bool is_empty(const PlanarSum& set) { return set.parts.empty() && set.segments.empty() && set.points.empty(); }
inline bool has_thin_parts(const Region& r) { return !r.polylines().empty() || !r.points().empty(); }
/// The closed set alone: a Boolean result is otherwise taken for the operations that made it, and what lies between two
/// closed sets that it unites is in none of their interiors.
Result<PlanarSum> closed_set(const PlanarOperand& set, const SumOptions& options = {});
/// What a part with area can lie in: pieces without area are left out.
Result<PlanarSum> regular_set(const PlanarOperand& set);
/// The parts alone.
Region parts_of(const Region& region);

}  // namespace uncertain
}  // namespace dymsum
