// Output files appear whole or not at all.
#include <csignal>
#include <fstream>
#include <iterator>

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "io/reading.h"

namespace dymsum::io_test {
namespace {

namespace fs = std::filesystem;

std::string text_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

TEST(WriteFile, writes_and_replaces) {
  const Folder folder("write");
  ASSERT_TRUE(write_file(folder / "a.wkt", "one").ok());
  EXPECT_EQ(text_of(folder / "a.wkt"), "one");
  ASSERT_TRUE(write_file(folder / "a.wkt", "second").ok());
  EXPECT_EQ(text_of(folder / "a.wkt"), "second");
  ASSERT_TRUE(write_file(folder / "a.wkt", "").ok());
  EXPECT_EQ(text_of(folder / "a.wkt"), "");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(WriteFile, keeps_permissions_and_symbolic_links) {
  const Folder folder("links");
  ASSERT_TRUE(write_file(folder / "real.wkt", "one").ok());
  fs::permissions(folder / "real.wkt", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("real.wkt", folder / "link.wkt");
  ASSERT_TRUE(write_file(folder / "link.wkt", "two").ok());
  EXPECT_TRUE(fs::is_symlink(folder / "link.wkt"));
  EXPECT_EQ(text_of(folder / "real.wkt"), "two");
  EXPECT_EQ(fs::status(folder / "real.wkt").permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(WriteFile, symbolic_links_to_what_is_not_there_yet_stay_and_are_followed) {
  const Folder folder("dangling");
  fs::create_directory(folder / "inner");
  fs::create_symlink("../made.wkt", folder / "inner/link.wkt");
  fs::create_symlink("inner/link.wkt", folder / "chain.wkt");
  fs::create_symlink(folder / "made.wkt", folder / "absolute.wkt");
  EXPECT_EQ(fs::path(written_path(folder / "chain.wkt")).lexically_normal(), folder / "made.wkt");
  EXPECT_EQ(written_path(folder / "made.wkt"), folder / "made.wkt");
  for (const char* const link : {"chain.wkt", "absolute.wkt", "inner/link.wkt"}) {
    fs::remove(folder / "made.wkt");
    ASSERT_TRUE(write_file(folder / link, link).ok()) << link;
    EXPECT_TRUE(fs::is_symlink(folder / link)) << link;
    EXPECT_FALSE(fs::is_symlink(folder / "made.wkt"));
    EXPECT_EQ(text_of(folder / "made.wkt"), link);
  }
}

TEST(WriteFile, symbolic_links_that_lead_nowhere_are_refused) {
  const Folder folder("nowhere");
  fs::create_symlink("b.wkt", folder / "a.wkt");
  fs::create_symlink("a.wkt", folder / "b.wkt");
  fs::create_symlink("missing/c.wkt", folder / "c.wkt");
  const auto circle = write_file(folder / "a.wkt", "one"), missing = write_file(folder / "c.wkt", "one");
  ASSERT_FALSE(circle.ok());
  EXPECT_EQ(circle.error().code, ErrorCode::cannot_write);
  EXPECT_NE(circle.error().message.find("in a circle"), std::string::npos) << circle.error().to_string();
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::cannot_write);
  EXPECT_NE(missing.error().message.find("missing/c.wkt, where it leads"), std::string::npos)
      << missing.error().to_string();
  EXPECT_EQ(missing.error().evidence.file, folder / "c.wkt");
  for (const char* const link : {"a.wkt", "b.wkt", "c.wkt"}) EXPECT_TRUE(fs::is_symlink(folder / link)) << link;
}

TEST(WriteFile, new_files_obey_the_mask) {
  const Folder folder("mask");
  const mode_t old = ::umask(027);
  ASSERT_TRUE(write_file(folder / "a.wkt", "one").ok());
  ::umask(old);
  struct stat status {};
  ASSERT_EQ(::stat((folder / "a.wkt").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777u, 0640u);
}

TEST(WriteFile, refuses_directories_and_missing_directories) {
  const Folder folder("refuse");
  fs::create_directory(folder / "dir.wkt");
  const auto directory = write_file(folder / "dir.wkt", "one");
  ASSERT_FALSE(directory.ok());
  EXPECT_EQ(directory.error().code, ErrorCode::cannot_write);
  EXPECT_NE(directory.error().message.find("directory"), std::string::npos);
  const auto missing = write_file(folder / "missing/a.wkt", "one");
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.error().code, ErrorCode::cannot_write);
  EXPECT_EQ(missing.error().evidence.file, folder / "missing/a.wkt");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(WriteFile, a_full_device_is_an_error) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const auto written = write_file("/dev/full", "one");
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.error().code, ErrorCode::cannot_write);
  EXPECT_TRUE(write_file("/dev/null", "one").ok());
}

/// Runs in a child, because limits and signals are the process's own. Returns its exit status.
template <class Run>
int in_child(Run run) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(run());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(WriteFile, when_the_space_runs_out_the_older_file_stays) {
  const Folder folder("space");
  ASSERT_TRUE(write_file(folder / "a.wkt", "older").ok());
  const std::string path = folder / "a.wkt";
  const int status = in_child([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100'000, 100'000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const auto written = write_file(path, std::string(200'000, 'x'));
    return !written.ok() && written.error().code == ErrorCode::cannot_write ? 0 : 1;
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(text_of(path), "older");
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(WriteFile, standard_output_reports_what_it_cannot_take) {
  const int status = in_child([] {
    if (::freopen("/dev/full", "w", stdout) == nullptr) return 2;
    const auto written = write_file("-", "one");
    return !written.ok() && written.error().code == ErrorCode::cannot_write ? 0 : 1;
  });
  EXPECT_EQ(status, 0);
}

TEST(WriteFile, killed_at_any_time_the_file_is_the_old_one_or_the_new_one) {
  const Folder folder("killed");
  const std::string path = folder / "a.wkt";
  const std::string texts[] = {std::string(3'000'000, 'a'), std::string(3'000'000, 'b')};
  ASSERT_TRUE(write_file(path, texts[0]).ok());
  for (int k = 0; k < 25; ++k) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::signal(SIGINT, SIG_DFL);  // which a shell ignores for what it runs in the background
      for (int turn = 0;; ++turn) {
        if (!write_file(path, texts[turn % 2]).ok()) ::_exit(1);
      }
    }
    ::usleep(static_cast<useconds_t>(1000 + 1700 * k));
    ::kill(child, k % 2 == 0 ? SIGKILL : SIGINT);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
    const std::string now = text_of(path);
    EXPECT_TRUE(now == texts[0] || now == texts[1]) << now.size();
  }
}

}  // namespace
}  // namespace dymsum::io_test
