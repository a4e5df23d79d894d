#include "planar/edit_script.h"

#include <charconv>
#include <sstream>

#include "dymsum/names.h"
#include "exact_number.h"
#include "line_file.h"
#include "numbers.h"

namespace dymsum::cli {
namespace {

// The words of one edit, and the line that is refused where one of them is wrong.
class EditWords {
 public:
  EditWords(const std::string& text, const std::string& file, std::int64_t line)
      : words_(text), text_(text), file_(file), line_(line) {}

  Edit edit() {
    Edit edit;
    edit.operand = named_word<MovingOperand>("an edit begins with p or q");
    edit.kind = named_word<EditKind>("the second word of an edit is one of " + kinds());
    switch (edit.kind) {
      case EditKind::move:
      case EditKind::insert:
        edit.vertex = index("a vertex");
        edit.at = position();
        break;
      case EditKind::extrude:
        edit.vertex = index("a vertex");
        edit.last = index("a second vertex");
        edit.at = position();
        break;
      case EditKind::remove:
      case EditKind::invert:
        edit.vertex = index("a vertex");
        break;
      case EditKind::add_hole:
        edit.part = index("a part");
        edit.added.outer = ring();
        break;
      case EditKind::remove_hole:
        edit.part = index("a part");
        edit.hole = index("a hole");
        break;
      case EditKind::add_part:
        edit.added.outer = ring();
        break;
      case EditKind::remove_part:
        edit.part = index("a part");
        break;
    }
    if (std::string more; words_ >> more) refuse("'" + more + "' is one word too many");
    return edit;
  }

 private:
  static std::string kinds() {
    std::string all;
    for (const std::string_view kind : names_of<EditKind>()) all += (all.empty() ? "" : ", ") + std::string(kind);
    return all;
  }
  [[noreturn]] void refuse(const std::string& why) const {
    refuse_line({ErrorCode::malformed, why + ": '" + text_ + "'", {}}, file_, line_);
  }
  std::string word(const std::string& what) {
    std::string text;
    if (!(words_ >> text)) refuse("the edit lacks " + what);
    return text;
  }
  template <names::Enumeration E>
  E named_word(const std::string& why) {
    const std::optional<E> value = parse<E>(word("a word"));
    if (!value) refuse(why);
    return *value;
  }
  std::uint32_t index(const std::string& what) {
    const std::string text = word(what);
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      refuse(what + " is named by its index, not '" + text + "'");
    return value;
  }
  Point point(const std::string& text) const {
    const std::vector<std::string> pieces = split(text, ',');
    const std::optional<double> x = pieces.size() == 2 ? double_number(pieces[0]) : std::nullopt,
                                y = pieces.size() == 2 ? double_number(pieces[1]) : std::nullopt;
    if (!x || !y) refuse("a position is X,Y, not '" + text + "'" + no_double_in(text));
    return {*x, *y};
  }
  Point position() { return point(word("a position X,Y")); }
  Ring ring() {
    Ring ring{position()};
    for (std::string text; words_ >> text;) ring.push_back(point(text));
    return ring;
  }

  std::istringstream words_;
  const std::string& text_;
  const std::string& file_;
  std::int64_t line_;
};

// Takes "hash HEX" off the end of a line.
std::optional<std::uint64_t> take_hash(std::string& text, const std::string& file, std::int64_t line) {
  const std::size_t at = text.rfind("hash ");
  if (at == std::string::npos) return std::nullopt;
  const std::string digits = text.substr(at + 5, text.find_last_not_of(" \t\r") - at - 4);
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (error != std::errc() || end != digits.data() + digits.size())
    refuse_line({ErrorCode::malformed, "a hash is a hexadecimal number, not '" + digits + "'", {}}, file, line);
  text.erase(at);
  return value;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

std::vector<ScriptStep> read_script(const std::string& file) {
  std::vector<ScriptStep> steps;
  const std::string all = file_text(file);
  for_each_line(all, [&](const std::string& whole, std::int64_t line) {
    ScriptStep step;
    std::string text = whole;
    step.hash = take_hash(text, file, line);
    step.text = trimmed(text);
    step.line = line;
    if (step.text == "undo") step.kind = ScriptStep::Kind::undo;
    else if (step.text == "redo") step.kind = ScriptStep::Kind::redo;
    else
      for (const std::string& one : split(step.text, ';')) step.edits.push_back(EditWords(one, file, line).edit());
    steps.push_back(std::move(step));
  });
  if (steps.empty()) refuse_line({ErrorCode::malformed, "the file lists no edits", {}}, file, std::nullopt);
  return steps;
}

std::string hash_text(std::uint64_t hash) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t k = 16; k-- > 0; hash >>= 4) text[k] = kDigits[hash & 15];
  return text;
}

}  // namespace dymsum::cli
