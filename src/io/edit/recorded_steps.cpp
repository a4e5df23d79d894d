#include "io/edit/recorded_steps.h"

#include <limits>

namespace dymsum::io {
namespace {

constexpr std::size_t kHashDigits = 16;
constexpr const char* kHexadecimal = "0123456789abcdef";

}  // namespace

std::string hash_text(std::uint64_t hash) {
  std::string text(kHashDigits, '0');
  for (std::size_t k = 0; k < kHashDigits; ++k) text[kHashDigits - 1 - k] = kHexadecimal[hash >> (4 * k) & 15];
  return text;
}

std::uint64_t hash_in(const nlohmann::json& j) {
  const std::string& digits = text(j);
  demand(digits.size() == kHashDigits && digits.find_first_not_of(kHexadecimal) == std::string::npos,
         "a hash is 16 hexadecimal digits");
  std::uint64_t hash = 0;
  for (const char c : digits) hash = hash << 4 | static_cast<std::uint64_t>(c <= '9' ? c - '0' : c - 'a' + 10);
  return hash;
}

std::size_t count_in(const nlohmann::json& j) { return whole(j, std::numeric_limits<std::uint64_t>::max()); }

}  // namespace dymsum::io
