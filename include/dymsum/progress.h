// Progress and cancellation of long computations.
#pragma once

#include <functional>
#include <string_view>

namespace dymsum {

/// Called now and then from the computing thread with the stage's name and its finished fraction in [0, 1]. Return
/// false to stop: the computation then returns an Error with ErrorCode::cancelled and changes nothing. An empty
/// function never stops.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

}  // namespace dymsum
