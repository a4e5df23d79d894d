// Scripts of edits line by line, whatever is edited: words, indices and coordinates of a line, steps of several edits,
// and the same written.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/edit_script.h"
#include "dymsum/names.h"

namespace dymsum::io {

/// A line of a script, word by word. Everything fails by a ReadFailure that has the line.
class ScriptLine {
 public:
  ScriptLine(std::string_view text, std::string_view file, std::int64_t line);

  std::int64_t number() const { return line_; }
  bool at_end() const { return next_ == words_.size(); }
  /// The next word, without taking it. Requires: not at_end().
  std::string_view peek() const { return words_[next_]; }
  std::string_view take(const std::string& what);
  /// p or q.
  MovingOperand operand();
  std::uint32_t index(const std::string& what);
  /// The nearest double of a decimal number; a fraction that a double is.
  double coordinate();
  /// What is done, of the names of an enumeration with hyphens.
  template <names::Enumeration E>
  E kind() {
    const std::string_view word = take("what is done");
    for (std::size_t k = 0; k < names_of<E>().size(); ++k)
      if (hyphened(names_of<E>()[k]) == word) return static_cast<E>(k);
    fail_with_kinds(word, names_of<E>());
  }
  [[noreturn]] void fail(const std::string& message) const;
  /// Fails where words are left.
  void end() const;

  static std::string hyphened(std::string_view name);

 private:
  [[noreturn]] void fail_with_kinds(std::string_view word, std::span<const std::string_view> kinds) const;

  std::vector<std::string_view> words_;
  std::size_t next_ = 0;
  std::string_view file_;
  std::int64_t line_;
};

/// The lines that hold something, comments left out.
std::vector<ScriptLine> script_lines(std::string_view text, std::string_view file);

/// What a line is that is no edit.
enum class ScriptWord : std::uint8_t { none, begin, end, undo, redo };
ScriptWord script_word(const ScriptLine& line);

/// Calls `use`, which may throw a ReadFailure; its error then.
std::optional<Error> read_failure(const std::function<void()>& use);

template <class Step, class EditIn>
Result<std::vector<Step>> script_steps(std::string_view text, std::string_view file, EditIn edit_in) {
  std::vector<Step> steps;
  bool open = false;
  const auto take = [&](ScriptLine& line) {
    const ScriptWord word = script_word(line);
    if (open && word != ScriptWord::none && word != ScriptWord::end)
      line.fail("a step between { and } holds edits alone");
    if (!open && word == ScriptWord::end) line.fail("} ends no step");
    if (word == ScriptWord::end && steps.back().edits.empty())
      line.fail("a step between { and } holds an edit at least");
    if (word == ScriptWord::none) {
      if (!open) steps.push_back({ScriptAction::edit, {}, line.number()});
      steps.back().edits.push_back(edit_in(line));
    } else {
      line.take("");
      open = word == ScriptWord::begin;
      if (open) steps.push_back({ScriptAction::edit, {}, line.number()});
      else if (word != ScriptWord::end)
        steps.push_back({word == ScriptWord::undo ? ScriptAction::undo : ScriptAction::redo, {}, line.number()});
    }
    line.end();
  };
  const std::optional<Error> error = read_failure([&] {
    std::vector<ScriptLine> lines = script_lines(text, file);
    for (ScriptLine& line : lines) take(line);
    if (open) lines.back().fail("the step that { begins has no }");
  });
  if (error) return *error;
  return steps;
}

/// "p add-hole".
std::string script_words(MovingOperand operand, std::string_view kind);
void write_index(std::string& out, std::uint32_t index);
void write_numbers(std::string& out, std::initializer_list<double> numbers);

template <class Step, class Written>
std::string script_text(std::span<const Step> steps, Written written) {
  std::string out;
  for (const Step& step : steps) {
    if (step.action != ScriptAction::edit) out += std::string(name(step.action)) + "\n";
    const bool several = step.edits.size() > 1;
    if (several) out += "{\n";
    for (const auto& edit : step.edits) out += (several ? "  " : "") + written(edit) + "\n";
    if (several) out += "}\n";
  }
  return out;
}

}  // namespace dymsum::io
