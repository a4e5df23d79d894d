#include "versus/child.h"

#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <sstream>

namespace dymsum::bench {
namespace {

std::string pack(const RivalAnswer& answer) {
  std::ostringstream text;
  text.precision(17);
  text << answer.finished << ' ' << answer.median_ms << ' ' << answer.min_ms << ' ' << answer.runs << ' ' << answer.area
       << ' ' << answer.outer << ' ' << answer.holes << ' ' << answer.vertices << ' '
       << (answer.area_exact.empty() ? "-" : answer.area_exact) << ' ' << answer.why_not << '\n';
  return text.str();
}

bool unpack(const std::string& packed, RivalAnswer& answer) {
  if (packed.empty() || packed.back() != '\n') return false;
  std::istringstream text(packed);
  text >> answer.finished >> answer.median_ms >> answer.min_ms >> answer.runs >> answer.area >> answer.outer >>
      answer.holes >> answer.vertices >> answer.area_exact;
  if (!text) return false;
  if (answer.area_exact == "-") answer.area_exact.clear();
  text.get();
  std::getline(text, answer.why_not);
  return true;
}

void write_all(int fd, const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t wrote = write(fd, text.data() + done, text.size() - done);
    if (wrote <= 0) _exit(1);
    done += static_cast<std::size_t>(wrote);
  }
}

/// Everything the child writes until it closes the pipe; false when the time is up first.
bool read_until(int fd, double limit_s, std::string& text) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(limit_s);
  char buffer[4096];
  while (true) {
    const auto left = std::chrono::duration<double, std::milli>(end - std::chrono::steady_clock::now()).count();
    if (left <= 0) return false;
    pollfd waiting{fd, POLLIN, 0};
    const int ready = poll(&waiting, 1, static_cast<int>(left) + 1);
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return false;
    const ssize_t got = read(fd, buffer, sizeof buffer);
    if (got <= 0) return true;
    text.append(buffer, static_cast<std::size_t>(got));
  }
}

}  // namespace

RivalAnswer in_child(const std::function<RivalAnswer()>& work, double limit_s) {
  RivalAnswer answer;
  int ends[2];
  if (pipe(ends) != 0) {
    answer.why_not = "no pipe";
    return answer;
  }
  const pid_t child = fork();
  if (child < 0) {
    answer.why_not = "no child";
    close(ends[0]);
    close(ends[1]);
    return answer;
  }
  if (child == 0) {
    close(ends[0]);
    write_all(ends[1], pack(work()));
    _exit(0);
  }
  close(ends[1]);
  std::string text;
  const bool in_time = read_until(ends[0], limit_s, text);
  close(ends[0]);
  if (!in_time) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  std::ostringstream why;
  if (!in_time) {
    why << "stopped after " << limit_s << " s";
  } else if (WIFSIGNALED(status)) {
    why << "crashed (signal " << WTERMSIG(status) << ")";
  } else if (unpack(text, answer)) {
    return answer;
  } else {
    why << "gave no answer";
  }
  answer = RivalAnswer{};
  answer.why_not = why.str();
  return answer;
}

}  // namespace dymsum::bench
