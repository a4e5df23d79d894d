// Numbers in SVG attributes: separated by blanks, a comma, or nothing where a sign or second decimal point starts the
// next.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "io/region/svg_path.h"
#include "io/source.h"

namespace dymsum::io {

class SvgNumbers {
 public:
  SvgNumbers(const Source& source, const SvgText& text) : source_(source), text_(text) {}

  void skip();  ///< blanks and commas
  bool at_end() const { return at_ >= text_.value.size(); }
  char peek() const { return text_.value[at_]; }
  void advance() { ++at_; }
  bool at_number();  ///< after blanks and commas
  double read();     ///< failures: malformed, not_finite
  bool read_flag();  ///< 0 or 1, which needs no separator
  std::string_view rest() const { return text_.value.substr(at_ < text_.value.size() ? at_ : text_.value.size()); }

  [[noreturn]] void fail(const std::string& message) const;         ///< malformed, showing what stands here
  [[noreturn]] void fail_before(const std::string& message) const;  ///< malformed, message only
  [[noreturn]] void fail_not_finite(const std::string& message) const;

 private:
  std::int64_t line() const;

  const Source& source_;
  SvgText text_;
  std::size_t at_ = 0;
};

}  // namespace dymsum::io
