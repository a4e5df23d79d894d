#include "viewer/connection_watch.h"

#include <sys/socket.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace dymsum::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kLook(100), kLookAtTheEnd(10), kGrace(250);

using NameOf = int (*)(int, sockaddr*, socklen_t*);

/// The port at this or the other end of a connection over IPv4; 0 for what is none.
int port_of(int socket, NameOf name) {
  sockaddr address{};
  socklen_t size = sizeof address;
  if (name(socket, &address, &size) != 0 || address.sa_family != AF_INET) return 0;
  // Of AF_INET the port comes first, its high byte before the low one.
  const auto byte = [&](int i) { return static_cast<unsigned char>(address.sa_data[i]); };
  return byte(0) << 8 | byte(1);
}

/// The files that the program has open, sockets among them.
std::vector<int> open_files() {
  std::vector<int> files;
  std::error_code unknown;
  for (fs::directory_iterator at("/proc/self/fd", unknown), end; at != end; at.increment(unknown))
    files.push_back(std::stoi(at->path().filename().string()));
  return files;
}

}  // namespace

ConnectionWatch::~ConnectionWatch() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void ConnectionWatch::start() {
  thread_ = std::thread([this] { run(); });
}

void ConnectionWatch::keep(int peer) {
  const std::lock_guard lock(mutex_);
  kept_.insert(peer);
}

void ConnectionWatch::release(int peer) {
  const std::lock_guard lock(mutex_);
  kept_.erase(peer);
}

void ConnectionWatch::cut_all() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = Clock::now();
  }
  changed_.notify_all();
}

void ConnectionWatch::run() {
  std::unique_lock lock(mutex_);
  while (!done_) {
    look();
    for (const Connection& connection : overdue()) ::shutdown(connection.first, SHUT_RDWR);
    changed_.wait_for(lock, ending_ ? kLookAtTheEnd : kLook);
  }
}

void ConnectionWatch::look() {
  std::map<Connection, Clock::time_point> now;
  for (const int file : open_files()) {
    const int peer = port_of(file, ::getpeername);
    if (peer == 0 || port_of(file, ::getsockname) != port_) continue;
    const auto before = since_.find({file, peer});
    now[{file, peer}] = before == since_.end() ? Clock::now() : before->second;
  }
  since_ = std::move(now);
}

std::vector<ConnectionWatch::Connection> ConnectionWatch::overdue() const {
  const Clock::time_point now = Clock::now();
  std::vector<std::pair<Clock::time_point, Connection>> others;  // of one age, a higher socket is a later one
  std::vector<Connection> late;
  for (const auto& [connection, since] : since_) {
    if (!kept_.contains(connection.second)) others.emplace_back(since, connection);
    else if (ending_ && now - *ending_ > kGrace) late.push_back(connection);
  }
  std::sort(others.begin(), others.end());
  const std::size_t most = ending_ ? 0 : kMost, extra = others.size() - std::min(others.size(), most);
  for (std::size_t i = 0; i < others.size(); ++i)
    if (i < extra || now - others[i].first > kLongest) late.push_back(others[i].second);
  return late;
}

}  // namespace dymsum::cli
