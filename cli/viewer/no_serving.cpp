// This file is in place of serving.cpp and loopback_server.cpp where a program cannot listen, as in a browser.
#include "exit_code.h"
#include "viewer/serving.h"

namespace dymsum::cli {

void serve(const std::string&, ViewerData, WatchedInputs&, const Serving&) {
  throw Stop(kUsage, "this build of dymsum has no server, and cannot view");
}

}  // namespace dymsum::cli
