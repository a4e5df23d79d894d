#include "planar/scaling/always_on.h"

namespace dymsum::planar {

bool AlwaysOn::operator()(std::uint32_t segment, Pair v) {
  const OperandPair& base = window_.base();
  const Segment s = window_.exact(segment);
  if (base.lattice->side(s, v) != 0) return false;
  if (doubled_ == nullptr) {
    const ScaleValue two = scale_value(exact::BigRational(2));
    doubled_ = base.lattice_at(base.lattice_scale(two));
  }
  return doubled_->side(s, v) == 0;
}

}  // namespace dymsum::planar
