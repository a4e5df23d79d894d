// Connections of a server that would take too long, or are too many, are cut.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>
#include <vector>

namespace dymsum::cli {

/// Looks at the connections that others hold to a port of this program, again and again on a thread of its own. Those
/// that are kept may stay, and are few. Of the others each has a limited time for its request and the answer, and there
/// are at most kMost at a time: the oldest go first, so that whoever comes last is answered. A connection that is cut
/// fails in every thread that reads or writes it, or waits for that.
class ConnectionWatch {
 public:
  static constexpr std::size_t kMost = 128;
  static constexpr std::chrono::seconds kLongest{10};

  explicit ConnectionWatch(int port) : port_(port) {}
  ~ConnectionWatch();
  ConnectionWatch(const ConnectionWatch&) = delete;
  ConnectionWatch& operator=(const ConnectionWatch&) = delete;

  void start();
  /// The connection whose other end has this port.
  void keep(int peer);
  void release(int peer);
  /// Cuts all connections from now on, kept ones after a moment in which they may end by themselves.
  void cut_all();

 private:
  using Clock = std::chrono::steady_clock;
  /// A socket, and the port at its other end: a later connection on the same socket has another one.
  using Connection = std::pair<int, int>;

  void run();
  /// Forgets what is gone, and says since when the others are there.
  void look();
  /// Those that are to go now.
  std::vector<Connection> overdue() const;

  const int port_;
  std::thread thread_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::set<int> kept_;
  std::map<Connection, Clock::time_point> since_;
  std::optional<Clock::time_point> ending_;
  bool done_ = false;
};

}  // namespace dymsum::cli
