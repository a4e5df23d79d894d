// How the other files of this room make an UncertainSolid of its sets.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "dymsum/uncertain_solid.h"

namespace dymsum {

struct UncertainSolidInternals {
  static UncertainSolid pair(SpatialSum inner, SpatialSum outer, double error = 0) {
    return list(std::move(inner), std::move(outer), {}, error);
  }
  static UncertainSolid list(SpatialSum inner, SpatialSum outer, std::vector<Mesh> variants, double error = 0) {
    UncertainSolid made;
    made.inner_ = std::make_shared<const SpatialSum>(std::move(inner));
    made.outer_ = std::make_shared<const SpatialSum>(std::move(outer));
    made.variants_ = std::make_shared<const std::vector<Mesh>>(std::move(variants));
    made.error_ = error;
    return made;
  }
  /// One set, which both are.
  static UncertainSolid one(SpatialSum set, std::vector<Mesh> variants = {}, double error = 0) {
    UncertainSolid made = list({}, {}, std::move(variants), error);
    made.inner_ = made.outer_ = std::make_shared<const SpatialSum>(std::move(set));
    return made;
  }
  /// Both sets are one object: nothing has to be computed twice.
  static bool is_one(const UncertainSolid& u) { return u.inner_ == u.outer_; }
};

namespace uncertain {

inline SpatialOperand inner_solid(const UncertainSolid& u) {
  return u.variants().size() == 1 ? SpatialOperand(u.variants()[0]) : SpatialOperand(u.inner());
}
inline SpatialOperand outer_solid(const UncertainSolid& u) {
  return u.variants().size() == 1 ? SpatialOperand(u.variants()[0]) : SpatialOperand(u.outer());
}
inline bool is_empty(const SpatialSum& set) {
  return set.faces.empty() && set.tight_faces.empty() && set.tight_segments.empty() && set.tight_points.empty();
}
inline bool is_empty(const SpatialOperand& operand) {
  if (const auto* mesh = std::get_if<const Mesh*>(&operand.set())) return (*mesh)->empty();
  return is_empty(*std::get<const SpatialSum*>(operand.set()));
}

}  // namespace uncertain
}  // namespace dymsum
