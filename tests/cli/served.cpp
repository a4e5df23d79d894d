#include "served.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>

namespace dymsum::cli_test {
namespace {

constexpr std::chrono::seconds kLongest(60);

[[noreturn]] void become(const std::string& folder, const std::vector<std::string>& arguments) {
  const auto file = [](const std::string& name) { return ::open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600); };
  const bool ready = ::chdir((folder + "/work").c_str()) == 0 && ::dup2(file(folder + "/served"), 1) == 1 &&
                     ::dup2(file(folder + "/told"), 2) == 2 && ::setenv("DYMSUM_VIEWER", "viewer.html", 1) == 0;
  std::vector<char*> words;
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  if (ready) ::execv(DYMSUM_CLI, words.data());
  ::_exit(127);
}

int exit_code(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

}  // namespace

nlohmann::json data_of(const std::string& page) {
  const std::string opening = "<script id=\"dymsum-data\" type=\"application/json\">";
  const std::size_t at = page.find(opening);
  if (at == std::string::npos) throw std::runtime_error("a page without a place for data:\n" + page.substr(0, 500));
  const std::size_t from = at + opening.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

Served::Served(const Workplace& work, std::vector<std::string> arguments) : work_(work) {
  arguments.insert(arguments.begin(), {"dymsum", "view", "--no-open"});
  const std::string folder = work.folder().string();
  work.write("../served", "");
  process_ = ::fork();
  if (process_ == 0) become(folder, arguments);
  const auto start = std::chrono::steady_clock::now();
  const std::string head = "http://127.0.0.1:";
  while (port_ == 0 && !has_ended() && std::chrono::steady_clock::now() - start < kLongest) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const std::string said = read_text(work.folder() / "served");
    if (said.starts_with(head) && said.ends_with("/\n")) port_ = std::stoi(said.substr(head.size()));
  }
}

Served::~Served() {
  if (!has_ended()) end(SIGKILL);
}

bool Served::has_ended() {
  int status = 0;
  if (process_ > 0 && ::waitpid(process_, &status, WNOHANG) == process_) {
    process_ = -1;
    code_ = exit_code(status);
  }
  return process_ < 0;
}

int Served::end(int signal) {
  if (has_ended()) return code_;
  ::kill(process_, signal);
  const auto start = std::chrono::steady_clock::now();
  while (!has_ended()) {
    if (std::chrono::steady_clock::now() - start > kLongest) ::kill(process_, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return code_;
}

std::string Served::told() const { return read_text(work_.folder() / "told"); }

}  // namespace dymsum::cli_test
