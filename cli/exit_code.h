// How a run of the command line ends.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "dymsum/result.h"

namespace dymsum::cli {

enum ExitCode {
  kDone = 0,
  kUsage = 1,         ///< the command line itself is wrong
  kBadInput = 2,      ///< an input or output file is, with the evidence
  kDefect = 3,        ///< our defect
  kNo = 4,            ///< the answer is "no"
  kUndecided = 5,     ///< neither yes nor no within the limits of the search
  kInterrupted = 130  ///< by Ctrl-C
};

/// What the verb chosen on the command line does.
using Action = std::function<ExitCode()>;

/// Ends the command with this code and message; thrown by anything below a subcommand, caught in main.
class Stop : public std::runtime_error {
 public:
  Stop(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  /// A stop with the library's error that ends the command.
  Stop(ExitCode code, Error error) : std::runtime_error(error.to_string()), code_(code), error_(std::move(error)) {}
  Stop(ExitCode code, const std::string& message, Error error)
      : std::runtime_error(message), code_(code), error_(std::move(error)) {}
  ExitCode code() const { return code_; }
  const std::optional<Error>& error() const { return error_; }

 private:
  ExitCode code_;
  std::optional<Error> error_;
};

}  // namespace dymsum::cli
