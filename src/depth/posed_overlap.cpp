#include "depth/posed_overlap.h"

namespace dymsum::depth {
namespace {

spatial::PosePair with_q_turned(const Rotation& q_turned) {
  spatial::PosePair poses;
  poses.q.rotation = q_turned;
  return poses;
}

}  // namespace

PosedOverlap::PosedOverlap(const spatial::SolidPair& pair, const Rotation& q_turned)
    : posed_(spatial::posed_space(pair, with_q_turned(q_turned))), collision_(*posed_.space, pair.p, pair.q) {}

bool PosedOverlap::holds(const std::array<exact::BigRational, 3>& at) {
  const exact::BigInteger& scale = posed_.scale;
  const std::optional<spatial::PointSource> position =
      posed_.space->add_position({at[0] * scale, at[1] * scale, at[2] * scale});
  return position && collision_.overlaps({*position, 0, 0, 0, 0, 0});
}

}  // namespace dymsum::depth
