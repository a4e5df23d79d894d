// The inputs of a command, read again when their files change.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "inputs.h"
#include "viewer/viewer_data.h"

namespace dymsum::cli {

/// Standard input, footprints and what is no regular file never change.
class WatchedInputs {
 public:
  /// Reads all of them; stops with bad input as viewer_input does.
  WatchedInputs(std::vector<std::string> operands, const InputOptions& options);

  const std::vector<ViewerInput>& inputs() const { return inputs_; }

  /// Looks at every file, and reads it where its time or size is another one, or was too young to tell. Returns the
  /// indices of inputs whose bytes are others than before; a file that cannot be read now counts as unchanged.
  std::vector<std::size_t> take_changes();

 private:
  /// What tells without reading that a file is as it was. Two changes may have one time of modification: a file is
  /// `settled` when its time was at least a second past as it was read.
  struct Stamp {
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;
    bool settled = false;
    bool is_file = false;
  };
  Stamp stamp_of(const std::string& operand) const;

  std::vector<std::string> operands_;
  InputOptions options_;
  std::vector<Stamp> stamps_;
  std::vector<ViewerInput> inputs_;
};

}  // namespace dymsum::cli
