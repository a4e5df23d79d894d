// Files as the command line writes them, byte by byte: its own writers.
#pragma once

#include <string>

#include "bind.h"
#include "exit_code.h"

namespace dymsum::web {

/// What `write` gives. Where it would end a command, the error that this has: of the library, or the sentence.
template <class Write>
auto as_written(Write write) {
  try {
    return write();
  } catch (const cli::Stop& stop) {
    throw Thrown{stop.error().value_or(Error{ErrorCode::unsupported_format, stop.what(), {}})};
  }
}

}  // namespace dymsum::web
