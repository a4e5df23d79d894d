// What is called around a fork.
#include "base/around_forks.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>

namespace dymsum::base {
namespace {

struct Noted final : AroundForks {
  Noted() { watch(); }
  ~Noted() { forget(); }
  void before_fork() override { calls += "before "; }
  void after_fork_in_parent() override { calls += "parent "; }
  void after_fork_in_child() override { calls += "child "; }
  std::string calls;
};

int exit_code_of_child(bool (*child)(const Noted&), const Noted& noted) {
  const pid_t pid = ::fork();
  if (pid == 0) ::_exit(child(noted) ? 0 : 1);
  int status = 0;
  EXPECT_EQ(::waitpid(pid, &status, 0), pid);
  return status;
}

TEST(AroundForks, calls_what_is_watched_and_forgets_it_in_the_child) {
  Noted noted;
  { const Noted gone; }
  const auto child = [](const Noted& of) {
    const pid_t pid = ::fork();
    if (pid == 0) ::_exit(of.calls == "before child " ? 0 : 1);
    int status = 0;
    return ::waitpid(pid, &status, 0) == pid && status == 0 && of.calls == "before child ";
  };
  EXPECT_EQ(exit_code_of_child(child, noted), 0);
  EXPECT_EQ(noted.calls, "before parent ");
  EXPECT_EQ(exit_code_of_child([](const Noted& of) { return of.calls == "before parent before child "; }, noted), 0);
}

}  // namespace
}  // namespace dymsum::base
