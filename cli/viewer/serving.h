// Serving a page until Ctrl-C, and telling it when its inputs change.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "viewer/viewer_data.h"
#include "viewer/watched_inputs.h"

namespace dymsum::cli {

struct Serving {
  int port = 0;               ///< of 127.0.0.1; 0: a free one
  bool opens_browser = true;  ///< besides printing the address
  /// Called with the indices of inputs that are others than before, once the page has been told.
  std::function<void(const std::vector<std::size_t>& changed)> changed;
};

/// Prints the address and serves the viewer with this data, and with each change of the inputs, until the program is
/// interrupted or asked to end. Stops with bad input where the port cannot be had, and with wrong usage in builds that
/// have no server.
void serve(const std::string& viewer, ViewerData data, WatchedInputs& inputs, const Serving& serving);

}  // namespace dymsum::cli
