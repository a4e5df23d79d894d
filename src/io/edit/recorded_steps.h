// What recordings of edits have in common, whatever is edited: steps with a hash each, as JSON, and made again.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/poll.h"
#include "dymsum/edit_script.h"
#include "dymsum/names.h"
#include "io/checked_json.h"

namespace dymsum::io {

/// 16 hexadecimal digits: other programs read numbers of 64 bits as doubles.
std::string hash_text(std::uint64_t hash);
std::uint64_t hash_in(const nlohmann::json& j);
/// A number of steps.
std::size_t count_in(const nlohmann::json& j);

template <names::Enumeration E>
E enumerator_in(const nlohmann::json& j) {
  const std::optional<E> value = parse<E>(text(j));
  demand(value.has_value(), "an option has a value that it does not have");
  return *value;
}

/// {"hash": before the first step, "steps": [[text, hash], ...]}.
template <class Recording, class Text>
nlohmann::json steps_json(const Recording& recording, Text text_of) {
  if (recording.hashes.size() != recording.steps.size() + 1)
    throw std::invalid_argument("format_recording: a hash before the first step, and one after each");
  nlohmann::json steps = nlohmann::json::array();
  for (std::size_t k = 0; k < recording.steps.size(); ++k)
    steps.push_back(
        nlohmann::json::array({text_of(std::span(&recording.steps[k], 1)), hash_text(recording.hashes[k + 1])}));
  return {{"hash", hash_text(recording.hashes[0])}, {"steps", std::move(steps)}};
}

/// Throws Refused for what is none.
template <class Recording, class Parse>
void read_steps(const nlohmann::json& content, Recording& recording, Parse parse_text) {
  recording.hashes.push_back(hash_in(content.at("hash")));
  for (const nlohmann::json& j : list(content.at("steps"))) {
    array(j, 2);
    auto step = parse_text(text(j[0]));
    if (!step) throw Refused{step.error().message};
    demand(step->size() == 1, "a step is not one");
    recording.steps.push_back(step->front());
    recording.steps.back().line = 0;
    recording.hashes.push_back(hash_in(j[1]));
  }
}

template <class Recording, class Use>
Result<Recording> checked_recording(const CheckedFormat& format, std::string_view text,
                                    std::string_view name_for_errors, Use recording_of) {
  std::optional<Recording> read;
  const auto use = [&](const nlohmann::json& content) -> Result<void> {
    Result<Recording> made = recording_of(content);
    if (!made) return made.error();
    read.emplace(*std::move(made));
    return {};
  };
  const Result<void> done = read_checked(format, text, name_for_errors, use);
  if (!done) return done.error();
  return *std::move(read);
}

/// The steps made again on a fresh sum.
template <class Recording, class Sum>
Result<EditReplay> replayed(const Recording& recording, Result<Sum> fresh, const Progress& progress) {
  if (!fresh) return fresh.error();
  Sum sum = *std::move(fresh);
  EditReplay made;
  if (sum.hash() != recording.hashes.at(0)) made.differs = 0;
  for (std::size_t k = 0; k < recording.steps.size() && !made.differs; ++k) {
    if (progress && !progress("steps", static_cast<double>(k) / static_cast<double>(recording.steps.size())))
      return cancelled();
    const auto changes = make_step(sum, recording.steps[k]);
    if (!changes && changes.error().code == ErrorCode::cancelled) return changes.error();
    if (!changes) made.refused = changes.error();
    else ++made.steps;
    if (!changes || sum.hash() != recording.hashes.at(k + 1)) made.differs = k + 1;
  }
  return made;
}

}  // namespace dymsum::io
