// Output files appear whole or not at all: the text goes to a nameless file, or one with another name, in the same
// directory, is synced, and is renamed over the target as the last step.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "dymsum/region_io.h"
#include "io/read_file.h"

namespace dymsum {

namespace {

Error cannot_write(const std::string& path, const std::string& what, int error) {
  Evidence evidence;
  evidence.file = path;
  return {ErrorCode::cannot_write, what + ": " + std::strerror(error), std::move(evidence)};
}

/// 0, or the error number.
int write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(file, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

/// A file beside the target that disappears unless `publish` succeeds.
class Draft {
 public:
  explicit Draft(const std::filesystem::path& target) : target_(target), directory_(target.parent_path()) {
    if (directory_.empty()) directory_ = ".";
  }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
  ~Draft() {
    if (file_ >= 0) ::close(file_);
    if (!name_.empty()) ::unlink(name_.c_str());
  }

  int open() {
#ifdef O_TMPFILE
    file_ = ::open(directory_.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (file_ >= 0) return 0;
#endif
    for (unsigned attempt = 0;; ++attempt) {
      const std::string name = draft_name(attempt);
      file_ = ::open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
      if (file_ < 0 && errno == EEXIST && attempt < kMostNames) continue;
      if (file_ < 0) return errno;
      name_ = name;
      return 0;
    }
  }

  int write(std::string_view text) {
    if (const int error = write_all(file_, text)) return error;
    struct stat old;
    if (::stat(target_.c_str(), &old) == 0 && ::fchmod(file_, old.st_mode & 0777) != 0) return errno;
    return ::fsync(file_) == 0 ? 0 : errno;
  }

  int publish() {
    if (const int error = name_.empty() ? give_name() : 0) return error;
    const int closed = ::close(std::exchange(file_, -1)) == 0 ? 0 : errno;
    if (closed) return closed;
    if (::rename(name_.c_str(), target_.c_str()) != 0) return errno;
    name_.clear();
    return 0;
  }

 private:
  static constexpr unsigned kMostNames = 1000;

  std::string draft_name(unsigned attempt) const {
    const std::string number = std::to_string(::getpid()) + "-" + std::to_string(attempt);
    return (directory_ / ("." + target_.filename().string() + "." + number + ".part")).string();
  }

  int give_name() {
    const std::string self = "/proc/self/fd/" + std::to_string(file_);
    for (unsigned attempt = 0;; ++attempt) {
      const std::string name = draft_name(attempt);
      if (::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) {
        name_ = name;
        return 0;
      }
      if (errno != EEXIST || attempt >= kMostNames) return errno;
    }
  }

  std::filesystem::path target_, directory_;
  std::string name_;
  int file_ = -1;
};

/// Devices and pipes cannot be replaced, only written to.
int write_through(const std::string& path, std::string_view text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) return errno;
  const int error = write_all(file, text);
  const int closed = ::close(file) == 0 ? 0 : errno;
  return error ? error : closed;
}

}  // namespace

std::string written_path(const std::string& path) {
  constexpr int kMostLinks = 40;  // as the system follows
  std::filesystem::path target = path;
  std::error_code none;
  for (int k = 0; k < kMostLinks; ++k) {
    const std::filesystem::path next = std::filesystem::read_symlink(target, none);
    if (none) break;                       // no link
    target = target.parent_path() / next;  // next alone where it is absolute
  }
  return target.string();
}

Result<void> write_file(const std::string& path, std::string_view text) {
  if (path == "-") {
    const int error = write_all(STDOUT_FILENO, text);
    if (error) return cannot_write(path, "writing to standard output failed", error);
    return {};
  }
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status))
    return io::file_error(ErrorCode::cannot_write, "this is a directory", path);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    const int error = write_through(path, text);
    if (error) return cannot_write(path, "writing failed", error);
    return {};
  }
  if (std::filesystem::exists(status) && ::access(path.c_str(), W_OK) != 0) {
    return cannot_write(path, "the file may not be changed", errno);
  }
  const std::filesystem::path target = written_path(path);
  if (std::filesystem::is_symlink(target, ignored))
    return io::file_error(ErrorCode::cannot_write, "symbolic links lead from it round in a circle", path);
  Draft draft(target);
  const std::string place = target == path ? "here" : "at " + target.string() + ", where it leads";
  if (const int error = draft.open()) return cannot_write(path, "no file can be made " + place, error);
  if (const int error = draft.write(text))
    return cannot_write(path, "writing failed, an older file is untouched", error);
  if (const int error = draft.publish()) return cannot_write(path, "the finished file cannot take its name", error);
  return {};
}

}  // namespace dymsum
