// Many copies of one solid, each at its own scale, from one convolution.
#include <map>

#include "base/poll.h"
#include "dymsum/solid_scale_events.h"
#include "dymsum/solid_scale_range.h"
#include "exact/big.h"

namespace dymsum {

Result<std::vector<SolidCopySum>> scaled_solid_copies(const Mesh& master, const Mesh& q,
                                                      const std::vector<ScaledSolidCopy>& copies,
                                                      const Progress& progress) {
  SolidScaleOptions options;
  options.moving = MovingOperand::p;
  const Result<SolidScaleEvents> sums = SolidScaleEvents::create(master, q, options);
  if (!sums) return sums.error();
  std::map<exact::BigRational, std::size_t> first;
  std::vector<SolidCopySum> result;
  result.reserve(copies.size());
  for (const ScaledSolidCopy& copy : copies) {
    if (progress && !progress("copies", static_cast<double>(result.size()) / static_cast<double>(copies.size())))
      return cancelled();
    const auto [at, fresh] = first.try_emplace(exact::exact_value(copy.scale.exact()), result.size());
    if (!fresh) {
      result.push_back({result[at->second].sum, copy.at});
      continue;
    }
    Result<SpatialSum> sum = sums->at(copy.scale, progress);
    if (!sum) return sum.error();
    result.push_back({*std::move(sum), copy.at});
  }
  return result;
}

}  // namespace dymsum
