#include "viewer/serving.h"

#include <csignal>
#include <cstdlib>
#include <ctime>
#include <iostream>

#include "viewer/loopback_server.h"
#include "viewer/viewer_file.h"

namespace dymsum::cli {
namespace {

constexpr long kLookNanoseconds = 250'000'000;

/// The next of these signals, or 0 where none comes for a quarter of a second.
int next_signal(const sigset_t& signals) {
  const timespec patience{0, kLookNanoseconds};
  const int signal = sigtimedwait(&signals, nullptr, &patience);
  return signal < 0 ? 0 : signal;
}

void open_browser(const std::string& address) {
  if (std::system("command -v xdg-open >/dev/null 2>&1") != 0) {
    std::cerr << "dymsum: there is no xdg-open here: open the address in a browser\n";
    return;
  }
  const int started = std::system(("xdg-open " + address + " >/dev/null 2>&1 </dev/null &").c_str());
  if (started != 0) std::cerr << "dymsum: xdg-open cannot be started: open the address in a browser\n";
}

/// Signals that end the program, blocked in this thread and in those it starts, so that they can be waited for.
sigset_t blocked_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  return signals;
}

}  // namespace

void serve(const std::string& viewer, ViewerData data, WatchedInputs& inputs, const Serving& serving) {
  LoopbackServer server(serving.port);
  const auto show = [&] {
    const std::string text = viewer_json(data);
    server.show(viewer_with(viewer, text), text, data.revision);
  };
  show();
  std::cout << server.address() << std::endl;
  std::cerr << "dymsum: at this address until Ctrl-C\n";
  if (serving.opens_browser) open_browser(server.address());
  const sigset_t signals = blocked_signals();  // behind the browser, which is to take them
  server.start();
  while (next_signal(signals) == 0) {
    const std::vector<std::size_t> changed = inputs.take_changes();
    if (changed.empty()) continue;
    data.inputs = inputs.inputs();
    ++data.revision;
    show();
    serving.changed(changed);
  }
}

}  // namespace dymsum::cli
