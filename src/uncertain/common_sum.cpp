#include "uncertain/common_sum.h"

#include <utility>
#include <vector>

#include "dymsum/planar_boolean.h"
#include "uncertain/uncertain_internals.h"

namespace dymsum::uncertain {

Result<PlanarSum> common_sum(const Uncertain& list, const std::function<Result<PlanarSum>(const PlanarOperand&)>& sum,
                             const SumOptions& options) {
  Result<PlanarSum> of_common = sum(list.inner());
  if (!of_common) return of_common;
  SumOptions regular = options;
  regular.semantics = Semantics::regular;
  std::vector<PlanarSum> sums;
  for (const Region& variant : list.variants()) {
    const Result<PlanarSum> rest = difference(variant, list.inner(), regular);
    if (!rest) return rest;
    if (rest->parts.empty()) return of_common;  // the variant is what all have in common
    Result<PlanarSum> moved = sum(*rest);
    if (!moved) return moved;
    sums.push_back(*std::move(moved));
  }
  const Result<PlanarSum> common = intersection(std::vector<PlanarOperand>(sums.begin(), sums.end()), options);
  if (!common) return common;
  return united(*of_common, *common, options);
}

}  // namespace dymsum::uncertain
