#include "nesting/answer_record.h"

#include <bit>
#include <cstddef>
#include <cstdint>

#include "io/bytes.h"

namespace dymsum::nesting {
namespace {

using io::append_bytes;

/// Takes numbers and texts from the front; afterwards whether there was enough.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  T take() {
    if (!enough(sizeof(T))) return T{};
    const T value = io::from_bytes<T>(rest_, 0, std::endian::little);
    rest_.remove_prefix(sizeof(T));
    return value;
  }
  std::string text() {
    const auto size = take<std::uint64_t>();
    if (!enough(size)) return "";
    std::string text(rest_.substr(0, size));
    rest_.remove_prefix(size);
    return text;
  }
  /// Everything was there, and nothing is left.
  bool finished() const { return good_ && rest_.empty(); }

 private:
  bool enough(std::uint64_t size) {
    good_ = good_ && size <= rest_.size();
    return good_;
  }
  std::string_view rest_;
  bool good_ = true;
};

void append_text(std::string& out, std::string_view text) {
  append_bytes(out, std::uint64_t{text.size()});
  out += text;
}

constexpr auto kLastStatus = static_cast<std::uint8_t>(TableAnswer::Status::timed_out);
constexpr auto kLastRounding = static_cast<std::uint8_t>(TableAnswer::Rounding::repaired);
constexpr auto kLastCode = static_cast<std::uint8_t>(ErrorCode::out_of_memory);

}  // namespace

void append_answer(std::string& out, const TableAnswer& answer) {
  append_bytes(out, static_cast<std::uint8_t>(answer.status));
  append_bytes(out, static_cast<std::uint8_t>(answer.rounding));
  for (const std::uint64_t count : {answer.vertices, answer.holes, answer.tight_segments, answer.tight_points})
    append_bytes(out, count);
  append_text(out, answer.wkb);
  if (!answer.error) return;
  append_bytes(out, static_cast<std::uint8_t>(answer.error->code));
  append_text(out, answer.error->message);
}

std::optional<TableAnswer> answer_in(std::string_view bytes) {
  Reader reader(bytes);
  TableAnswer answer;
  const auto status = reader.take<std::uint8_t>(), rounding = reader.take<std::uint8_t>();
  if (status > kLastStatus || rounding > kLastRounding) return std::nullopt;
  answer.status = static_cast<TableAnswer::Status>(status);
  answer.rounding = static_cast<TableAnswer::Rounding>(rounding);
  for (std::uint64_t* count : {&answer.vertices, &answer.holes, &answer.tight_segments, &answer.tight_points})
    *count = reader.take<std::uint64_t>();
  answer.wkb = reader.text();
  if (answer.status == TableAnswer::Status::refused) {
    const auto code = reader.take<std::uint8_t>();
    if (code > kLastCode) return std::nullopt;
    answer.error = Error{static_cast<ErrorCode>(code), reader.text(), {}};
  }
  if (!reader.finished()) return std::nullopt;
  return answer;
}

std::uint64_t checksum(std::string_view bytes) {
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15;  // 2^64 divided by the golden ratio
  std::uint64_t h = bytes.size() * kOdd;
  const auto take = [&h](std::uint64_t word) {
    h = (h ^ word) * kOdd;
    h ^= h >> 32;
  };
  for (; bytes.size() >= 8; bytes.remove_prefix(8)) take(io::from_bytes<std::uint64_t>(bytes, 0, std::endian::little));
  std::uint64_t last = 0;
  for (const char c : bytes) last = (last << 8) | static_cast<unsigned char>(c);
  take(last);
  return h;
}

}  // namespace dymsum::nesting
