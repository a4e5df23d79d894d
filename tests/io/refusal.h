// What readers of regions and of meshes say of text that they refuse.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "dymsum/result.h"

namespace dymsum::io_test {

inline constexpr const char* kRefusedFile = "dir/test.file";

/// Not read, with this code, in kRefusedFile, at this line (0: none), and with a sentence that contains `words`.
/// Returns the evidence.
template <class Read>
Evidence expect_refusal(const Result<Read>& read, std::string_view text, ErrorCode code, std::int64_t line,
                        std::string_view words) {
  if (read) {
    ADD_FAILURE() << "accepted:\n" << text.substr(0, 400);
    return {};
  }
  const Error& error = read.error();
  EXPECT_EQ(name(error.code), name(code)) << error.to_string() << "\n" << text.substr(0, 400);
  EXPECT_EQ(error.evidence.file, kRefusedFile);
  EXPECT_EQ(error.evidence.line.value_or(0), line) << error.to_string() << "\n" << text.substr(0, 400);
  EXPECT_NE(error.message.find(words), std::string::npos) << error.to_string();
  return error.evidence;
}

}  // namespace dymsum::io_test
