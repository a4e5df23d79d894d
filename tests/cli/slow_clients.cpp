#include "slow_clients.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <utility>

namespace dymsum::cli_test {

RawClient::RawClient(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
  const int room = 4096;
  const timeval patience{10, 0};
  ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &room, sizeof room);
  ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error("cannot connect to port " + std::to_string(port));
}

RawClient::~RawClient() {
  if (socket_ >= 0) ::close(socket_);
}

RawClient::RawClient(RawClient&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}

bool RawClient::send(const std::string& text) const {
  return ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size());
}

std::string RawClient::rest() const {
  std::string all, piece(1 << 16, '\0');
  for (ssize_t size = 0; (size = ::recv(socket_, piece.data(), piece.size(), 0)) > 0;)
    all.append(piece, 0, static_cast<std::size_t>(size));
  return all;
}

std::string request_for(const std::string& path, int port) {
  return "GET " + path + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) + "\r\n\r\n";
}

SlowSenders::SlowSenders(int port, std::size_t count) {
  while (clients_.size() < count) clients_.emplace_back(port);
  thread_ = std::thread([this] {
    for (bool first = true; !done_; first = false) {
      for (const RawClient& client : clients_) client.send(first ? "GET / HTTP/1.1\r\nHost: " : "x");
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  });
}

SlowSenders::~SlowSenders() {
  done_ = true;
  thread_.join();
}

}  // namespace dymsum::cli_test
