#include "planar_operand.h"

namespace dymsum::web {

TakenOperand::TakenOperand(const val& set) {
  if (set.instanceof (val::module_property("PlanarSum"))) set_ = set.as<std::shared_ptr<PlanarSum>>();
  else set_ = set.as<std::shared_ptr<Region>>();
}

TakenOperand::operator PlanarOperand() const {
  return std::visit([](const auto& set) { return PlanarOperand(*set); }, set_);
}

}  // namespace dymsum::web
