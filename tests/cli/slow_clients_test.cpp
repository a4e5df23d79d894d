// dymsum view among clients of the same machine that send slowly or never read: others are answered, and Ctrl-C ends
// it.
#include "slow_clients.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include "cli_fixture.h"
#include "served.h"

namespace dymsum::cli_test {
namespace {

using Clock = std::chrono::steady_clock;

/// The page is larger than what sockets hold of it, on both sides.
class SlowClients : public CliTest {
 protected:
  SlowClients() {
    work.write("viewer.html", kViewer + std::string(12 << 20, 'x'));
    work.write("slot.wkt", kSlot);
  }
  static std::vector<RawClient> who_never_read(const Served& served, std::size_t count, const std::string& path) {
    std::vector<RawClient> clients;
    while (clients.size() < count) {
      clients.emplace_back(served.port());
      clients.back().send(request_for(path, served.port()));
    }
    return clients;
  }
  /// A newcomer has its answer within two seconds, again and again.
  static void expect_answers(const Served& served) {
    for (int i = 0; i < 4; ++i) {
      const auto start = Clock::now();
      const RawClient newcomer(served.port());
      newcomer.send(request_for("/data.json", served.port()));
      const std::string answer = newcomer.rest();
      EXPECT_LT(Clock::now() - start, std::chrono::seconds(2)) << i;
      EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 ")) << i << answer.substr(0, 200);
      EXPECT_NE(answer.find("slot.wkt"), std::string::npos) << i;
    }
  }
  static void expect_end(Served& served) {
    const auto start = Clock::now();
    EXPECT_EQ(served.end(SIGINT), 0) << served.told();
    EXPECT_LT(Clock::now() - start, std::chrono::seconds(1));
  }
};

TEST_F(SlowClients, WhoNeverReadsKeepsNobodyWaiting) {
  Served served(work, {"slot.wkt"});
  const std::vector<RawClient> pages = who_never_read(served, 100, "/");
  expect_answers(served);
  expect_end(served);
}

TEST_F(SlowClients, WhoSendsSlowlyKeepsNobodyWaiting) {
  Served served(work, {"slot.wkt"});
  const SlowSenders senders(served.port(), 100);
  expect_answers(served);
  expect_end(served);
}

TEST_F(SlowClients, HundredsOfThemNeither) {
  Served served(work, {"slot.wkt"});
  std::vector<RawClient> silent;
  while (silent.size() < 300) silent.emplace_back(served.port());
  const SlowSenders senders(served.port(), 200);
  const std::vector<RawClient> pages = who_never_read(served, 100, "/");
  expect_answers(served);
  expect_end(served);
}

TEST_F(SlowClients, StreamsThatAreNotReadEndWithTheServer) {
  Served served(work, {"slot.wkt"});
  const std::vector<RawClient> streams = who_never_read(served, 40, "/events"), pages = who_never_read(served, 60, "/");
  expect_answers(served);
  expect_end(served);
}

// However it goes on: a byte ten times a second would keep a thread for ever.
TEST_F(SlowClients, ARequestHasItsTime) {
  Served served(work, {"slot.wkt"});
  const RawClient slow(served.port());
  const auto start = Clock::now();
  slow.send("GET / HTTP/1.1\r\nHost: ");
  while (slow.send("x") && Clock::now() - start < std::chrono::seconds(30))
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_GT(Clock::now() - start, std::chrono::seconds(8)) << "nobody else wanted its place";
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(13));
}

// A page that is read slowly, but read, arrives as a whole.
TEST_F(SlowClients, AWholePageArrivesMeanwhile) {
  Served served(work, {"slot.wkt"});
  const std::vector<RawClient> pages = who_never_read(served, 100, "/");
  const RawClient reader(served.port());
  reader.send(request_for("/", served.port()));
  const std::string answer = reader.rest();
  EXPECT_GT(answer.size(), std::size_t{12} << 20);
  EXPECT_TRUE(answer.ends_with("xxx"));
  expect_end(served);
}

}  // namespace
}  // namespace dymsum::cli_test
