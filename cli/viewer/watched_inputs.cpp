#include "viewer/watched_inputs.h"

#include <chrono>
#include <system_error>
#include <utility>

namespace dymsum::cli {

namespace fs = std::filesystem;

WatchedInputs::WatchedInputs(std::vector<std::string> operands, const InputOptions& options)
    : operands_(std::move(operands)), options_(options) {
  for (const std::string& operand : operands_) {
    stamps_.push_back(stamp_of(operand));
    inputs_.push_back(viewer_input(operand, options_));
  }
}

WatchedInputs::Stamp WatchedInputs::stamp_of(const std::string& operand) const {
  if (operand == "-" || is_footprint(operand)) return {};
  const std::string file = file_of_shape(operand);
  std::error_code unknown;
  Stamp stamp;
  // What is no file, as the end of a pipe, is read once: there it may take for ever.
  if (!fs::is_regular_file(file, unknown)) return {};
  stamp.time = fs::last_write_time(file, unknown);
  stamp.size = fs::file_size(file, unknown);
  if (unknown) return {};
  stamp.is_file = true;
  stamp.settled = fs::file_time_type::clock::now() - stamp.time > std::chrono::seconds(1);
  return stamp;
}

std::vector<std::size_t> WatchedInputs::take_changes() {
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < operands_.size(); ++i) {
    const Stamp now = stamp_of(operands_[i]);  // before the file is read: what is written later has a later one
    if (!now.is_file || (stamps_[i].settled && now.time == stamps_[i].time && now.size == stamps_[i].size)) continue;
    try {
      ViewerInput input = viewer_input(operands_[i], options_);
      stamps_[i] = now;
      if (input.bytes == inputs_[i].bytes) continue;
      inputs_[i] = std::move(input);
      changed.push_back(i);
    } catch (const Stop&) {  // gone, or half-written where a map is read: later it can be read again
    }
  }
  return changed;
}

}  // namespace dymsum::cli
