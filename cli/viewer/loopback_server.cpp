#include "viewer/loopback_server.h"

#include <httplib.h>
#include <sys/socket.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "exit_code.h"
#include "numbers.h"
#include "viewer/connection_watch.h"

namespace dymsum::cli {
namespace {

constexpr const char* kHost = "127.0.0.1";
constexpr int kMostStreams = 24;
/// Every connection that waits, for a request or to be read, keeps a thread; some are left to whoever comes next.
constexpr std::size_t kThreads = ConnectionWatch::kMost + kMostStreams + 8;
/// How long a stream waits before it looks whether its reader is still there.
constexpr std::chrono::milliseconds kPatience(500);

/// Nothing from elsewhere is loaded or asked, and nobody else may read or show the page, which is isolated, so that it
/// may use threads.
const httplib::Headers kHeaders = {
    {"Content-Security-Policy",
     "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob: data:; style-src "
     "'unsafe-inline'; img-src data: blob:; font-src data:; worker-src blob: data:; connect-src 'self' data: blob:; "
     "base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
    {"Cross-Origin-Opener-Policy", "same-origin"},
    {"Cross-Origin-Embedder-Policy", "require-corp"},
    {"Cross-Origin-Resource-Policy", "same-origin"},
    {"Referrer-Policy", "no-referrer"},
    {"X-Content-Type-Options", "nosniff"},
    {"Cache-Control", "no-store"}};

void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(why + "\n", "text/plain; charset=utf-8");
}

/// Answers with a text and its length: httplib would compress other texts at every request, which takes longer than to
/// send them here.
void answer(httplib::Response& response, std::shared_ptr<const std::string> text, const char* type) {
  const std::size_t size = text->size();
  response.set_content_provider(size, type, [text](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
    return sink.write(text->data() + offset, length);
  });
}

/// A revision that a page has; nothing where the request names none.
std::optional<std::size_t> revision_in(const std::string& text) {
  const std::optional<double> number = finite_number(text);
  return number && *number >= 0 && *number < 1e15 ? std::optional(static_cast<std::size_t>(*number)) : std::nullopt;
}

}  // namespace

class LoopbackServer::State {
 public:
  explicit State(int port) {
    server_.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    // A port that another program listens on is taken: httplib's own choice would share it.
    server_.set_socket_options([this](socket_t socket) {
      const int yes = 1;
      listener_ = socket;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    server_.set_tcp_nodelay(true).set_keep_alive_timeout(1).set_read_timeout(2).set_write_timeout(2);
    server_.set_payload_max_length(0).set_keep_alive_max_count(1);  // a connection is one request: it has its time
    server_.set_default_headers(kHeaders);
    server_.set_pre_routing_handler([this](const auto& request, auto& response) { return judge(request, response); });
    server_.Get("/", [this](const auto&, auto& response) {
      answer(response, shown(&State::page_), "text/html; charset=utf-8");
    });
    server_.Get("/data\\.json",
                [this](const auto&, auto& response) { answer(response, shown(&State::data_), "application/json"); });
    server_.Get("/events", [this](const auto& request, auto& response) { stream(request, response); });
    server_.set_error_handler([](const httplib::Request&, httplib::Response& response) {
      if (response.body.empty()) refuse(response, response.status, "There is nothing here.");
    });
    errno = 0;
    port_ = port == 0 ? server_.bind_to_any_port(kHost) : server_.bind_to_port(kHost, port) ? port : -1;
    if (port_ < 0) cannot_listen(port);
    ::listen(listener_,
             SOMAXCONN);  // httplib lets five wait to be taken: a newcomer behind them would wait for a second
    watch_.emplace(port_);
  }

  ~State() {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    changed_.notify_all();
    watch_->cut_all();
    server_.stop();
    if (thread_.joinable()) thread_.join();
  }

  int port() const { return port_; }

  void show(std::string page, std::string data, std::size_t revision) {
    {
      const std::lock_guard lock(mutex_);
      page_ = std::make_shared<const std::string>(std::move(page));
      data_ = std::make_shared<const std::string>(std::move(data));
      revision_ = revision;
    }
    changed_.notify_all();
  }

  void start() {
    thread_ = std::thread([this] { server_.listen_after_bind(); });
    watch_->start();
    while (!server_.is_running()) std::this_thread::yield();  // before that, stop() would stop nothing
  }

 private:
  using Text = std::shared_ptr<const std::string>;
  using Judgement = httplib::Server::HandlerResponse;

  [[noreturn]] static void cannot_listen(int port) {
    const std::string position = std::string(kHost) + ":" + std::to_string(port);
    if (errno == EADDRINUSE)
      throw Stop(kBadInput, "dymsum: port " + std::to_string(port) + " of " + kHost +
                                " is taken by another program; without --port a free one is found");
    throw Stop(kBadInput, "dymsum: cannot listen on " + position + ": " + std::strerror(errno));
  }

  /// Accepts only requests that were meant for this server: a page of another site can reach the loopback, by a name of
  /// its own that leads here, but not under the name of the loopback.
  Judgement judge(const httplib::Request& request, httplib::Response& response) const {
    if (request.get_header_value_count("Host") != 1 || !is_mine(request.get_header_value("Host"))) {
      refuse(response, 403, "This server answers only as " + std::string(kHost) + ":" + std::to_string(port_) + ".");
      return Judgement::Handled;
    }
    if (request.method != "GET" && request.method != "HEAD") {
      response.set_header("Allow", "GET, HEAD");
      refuse(response, 405, "This server is only read.");
      return Judgement::Handled;
    }
    return Judgement::Unhandled;
  }

  /// Of the port that http stands for, browsers leave the number out.
  bool is_mine(const std::string& host) const {
    const std::string port = ":" + std::to_string(port_);
    const auto named = [&](const std::string& name) { return host == name + port || (port_ == 80 && host == name); };
    return named(kHost) || named("localhost");
  }

  Text shown(Text State::*text) const {
    const std::lock_guard lock(mutex_);
    return this->*text;
  }

  void stream(const httplib::Request& request, httplib::Response& response) {
    if (++streams_ > kMostStreams) {
      --streams_;
      return refuse(response, 503, "Too many pages are open.");
    }
    const std::string last = request.has_header("Last-Event-ID") ? request.get_header_value("Last-Event-ID")
                                                                 : request.get_param_value("revision");
    auto known = std::make_shared<std::optional<std::size_t>>(revision_in(last));
    const int peer = request.remote_port;
    watch_->keep(peer);
    response.set_chunked_content_provider(
        "text/event-stream", [this, known](std::size_t, httplib::DataSink& sink) { return report(*known, sink); },
        [this, peer](bool) {
          watch_->release(peer);
          --streams_;
        });
  }

  /// One event, or a comment where there is none for a while; false once the reader has gone.
  bool report(std::optional<std::size_t>& known, httplib::DataSink& sink) {
    std::string text = ":\n\n";
    std::unique_lock lock(mutex_);
    if (!known) known = revision_;
    else if (changed_.wait_for(lock, kPatience, [&] { return ending_ || *known != revision_; }) && !ending_) {
      known = revision_;
      text = "id: " + std::to_string(revision_) + "\nevent: change\ndata: {\"revision\": " + std::to_string(revision_) +
             "}\n\n";
    }
    if (ending_) {
      sink.done();
      return true;
    }
    lock.unlock();
    return sink.is_writable() && sink.write(text.data(), text.size());
  }

  std::optional<ConnectionWatch> watch_;
  httplib::Server server_;
  std::thread thread_;
  int port_ = -1, listener_ = -1;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<int> streams_ = 0;
  // Guarded by the mutex:
  Text page_, data_;
  std::size_t revision_ = 0;
  bool ending_ = false;
};

LoopbackServer::LoopbackServer(int port) : state_(std::make_unique<State>(port)) {}
LoopbackServer::~LoopbackServer() = default;

int LoopbackServer::port() const { return state_->port(); }
std::string LoopbackServer::address() const {
  return "http://" + std::string(kHost) + ":" + std::to_string(port()) + "/";
}
void LoopbackServer::show(std::string page, std::string data, std::size_t revision) {
  state_->show(std::move(page), std::move(data), revision);
}
void LoopbackServer::start() { state_->start(); }

}  // namespace dymsum::cli
