// Answers as bytes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "dymsum/nfp_table.h"

namespace dymsum::nesting {

/// The format of records, which is to be raised whenever answers of the same key, or their bytes, change.
inline constexpr std::uint32_t kRecordFormat = 1;

void append_answer(std::string& out, const TableAnswer& answer);
/// Nothing where the bytes are no answer.
std::optional<TableAnswer> answer_in(std::string_view bytes);

/// 64 bits that change with every change of one word of eight bytes: the words are chained by bijections.
std::uint64_t checksum(std::string_view bytes);

}  // namespace dymsum::nesting
