// A rival's run in a forked child, so that its crash or hang costs one row of the table and not the table.
#pragma once

#include <functional>

#include "versus/rival.h"

namespace dymsum::bench {

/// Runs `work` in a forked copy of this process and returns its answer; a child that crashes or runs longer than
/// `limit_s` seconds is reported in `why_not`.
RivalAnswer in_child(const std::function<RivalAnswer()>& work, double limit_s);

}  // namespace dymsum::bench
