// A server of one page on the loopback (docs/design/viewer.md).
#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace dymsum::cli {

/// Listens on 127.0.0.1 from its making to its end, and answers for /, /data.json and /events alone, to requests that
/// name the loopback as their host. No request names a file: what is served are texts. Clients that send slowly or do
/// not read keep no other one waiting, and the end takes less than a second whatever they do.
class LoopbackServer {
 public:
  /// Port 0: a free one. Stops with bad input where it cannot listen on the port.
  explicit LoopbackServer(int port);
  ~LoopbackServer();
  LoopbackServer(const LoopbackServer&) = delete;
  LoopbackServer& operator=(const LoopbackServer&) = delete;

  int port() const;
  std::string address() const;  ///< "http://127.0.0.1:PORT/"

  /// What is served from now on. Those who listen to /events and know another revision are told.
  void show(std::string page, std::string data, std::size_t revision);

  /// Answers requests, on threads of its own, with what is shown; until then they wait. Requires: show() was called.
  void start();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace dymsum::cli
