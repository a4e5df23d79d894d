// Files of JSON whose content has a checksum, and whose entries are checked one by one before anything uses them.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "dymsum/region.h"

namespace dymsum::io {

struct CheckedFormat {
  const char* name;  ///< as files say it
  int version;
  const char* of;  ///< for errors: "the file of an obstacle"
};

/// FNV-1a of 64 bits in hexadecimal digits, of the content's text without blanks and with sorted keys: every change of
/// one byte changes it.
std::string checksum(const nlohmann::json& content);
std::string format_checked(const CheckedFormat& format, const nlohmann::json& content);

/// use(content), which throws Refused where it is not what was written. Errors: truncated or malformed where the text
/// is not complete, not of this format and version, or does not have its checksum; those of `use`. All name the file.
Result<void> read_checked(const CheckedFormat& format, std::string_view text, std::string_view name_for_errors,
                          const std::function<Result<void>(const nlohmann::json& content)>& use);

struct Refused {
  std::string why;
};
void demand(bool holds, const char* why);

// Entries of a content; each throws Refused for what is none.
std::uint64_t whole(const nlohmann::json& j, std::uint64_t below);
std::uint32_t index(const nlohmann::json& j, std::size_t count);
double number(const nlohmann::json& j);
bool flag(const nlohmann::json& j);
const std::string& text(const nlohmann::json& j);
const nlohmann::json& list(const nlohmann::json& j);
const nlohmann::json& array(const nlohmann::json& j, std::size_t size);

/// Rings of all parts as flat lists of coordinates. A polyline is the ring there and back, of two vertices for a
/// segment, and a point a ring of one.
nlohmann::json region_json(const Region& region);
/// Errors: those of Region::create.
Result<Region> region_of(const nlohmann::json& parts);

}  // namespace dymsum::io
