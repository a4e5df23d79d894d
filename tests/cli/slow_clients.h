// Clients of a server on the loopback, as good and as bad as a test wants them.
#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <thread>
#include <vector>

namespace dymsum::cli_test {

/// A connection to a port of this machine that reads nothing by itself, and has little room for what it does not read.
class RawClient {
 public:
  explicit RawClient(int port);
  ~RawClient();
  RawClient(RawClient&& other) noexcept;
  RawClient(const RawClient&) = delete;
  RawClient& operator=(const RawClient&) = delete;

  /// Whether all of it was taken.
  bool send(const std::string& text) const;
  /// All that comes until the other end closes, or nothing comes for ten seconds.
  std::string rest() const;

 private:
  int socket_ = -1;
};

/// The request of a page, as browsers begin it.
std::string request_for(const std::string& path, int port);

/// Sends one byte of an endless request on each of these connections ten times a second.
class SlowSenders {
 public:
  SlowSenders(int port, std::size_t count);
  ~SlowSenders();

 private:
  std::vector<RawClient> clients_;
  std::atomic<bool> done_ = false;
  std::thread thread_;
};

}  // namespace dymsum::cli_test
