// The positions of a turned part in a strip.
#pragma once

#include "nesting/table_plan.h"

namespace dymsum::nesting {

/// The answer of a strip fit. O(n) operations with integers as long as the part's coordinates and the angle's together.
TableAnswer strip_answer(const NfpTable::State& table, const TableRow& row);

}  // namespace dymsum::nesting
