// The complex of given walks, from a guess which may be wrong.
#pragma once

#include <optional>

#include "base/poll.h"
#include "shape/complex/candidates.h"

namespace dymsum::shape {

/// The same complex whatever the guess: it is completed, certified, and where that fails replaced by all pairs, as
/// where there is none. Throws Cancelled.
Complex complex_from(Walks walks, std::optional<Candidates> guess, int threads, const Poll& poll);
/// The same from rough candidates, if these are good, or else from better ones.
Complex complex_from_rough(Walks walks, int threads, const Poll& poll);

}  // namespace dymsum::shape
