// The answer of one row, and of the one that mirrors it.
#pragma once

#include <array>

#include "nesting/table_plan.h"

namespace dymsum::nesting {

/// The answers of a task: of its row and, where it has one, of its mirror (else an empty one). Errors of the library
/// make them refused; where `progress` requests a stop, they are timed out.
std::array<TableAnswer, 2> answers_of(const NfpTable::State& table, const Task& task, const Progress& progress);

}  // namespace dymsum::nesting
