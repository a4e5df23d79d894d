// Regions and results wherever either is taken.
#pragma once

#include <memory>
#include <variant>

#include "bind.h"
#include "dymsum/planar_operand.h"
#include "options.h"

namespace dymsum::web {

/// A region or a planar sum of JavaScript's as an operand: it is there for as long as this is.
class TakenOperand {
 public:
  /// Requires a Region or a PlanarSum, which the package has looked at (objects.js).
  explicit TakenOperand(const val& set);
  operator PlanarOperand() const;  // NOLINT(google-explicit-constructor)

 private:
  std::variant<std::shared_ptr<Region>, std::shared_ptr<PlanarSum>> set_;
};

/// A bound function of two operands.
using OfSets = Result<PlanarSum> (*)(const PlanarOperand&, const PlanarOperand&, const SumOptions&);
template <OfSets operation>
std::shared_ptr<PlanarSum> of_sets(const val& a, const val& b, const val& options) {
  return shared(got(operation(TakenOperand(a), TakenOperand(b), sum_options(options))));
}

}  // namespace dymsum::web
