#include "base/output_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

namespace dymsum::base {
namespace {

Error failed(ErrorCode code, const std::string& path, const std::string& what) {
  Evidence evidence;
  evidence.file = path;
  return {code, what + ": " + std::strerror(errno), std::move(evidence)};
}

Error not_a_file(const std::string& path) {
  Evidence evidence;
  evidence.file = path;
  return {ErrorCode::cannot_write, "this is not a regular file", std::move(evidence)};
}

Error cannot_append(const std::string& path, const std::string& what) {
  return failed(ErrorCode::cannot_write, path, what);
}

}  // namespace

Result<std::optional<AppendFile>> AppendFile::open(const std::string& path) {
  // A pipe or a device may let nobody open it until somebody comes, never end, or forget what is written.
  const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0666);
  if (file < 0) return cannot_append(path, "the file cannot be opened for writing");
  AppendFile opened(path, file);
  struct stat status;
  if (::fstat(file, &status) != 0) return cannot_append(path, "the file cannot be looked at");
  if (!S_ISREG(status.st_mode)) return not_a_file(path);
  if (::flock(file, LOCK_EX | LOCK_NB) == 0) return std::optional(std::move(opened));
  if (errno == EWOULDBLOCK) return std::optional<AppendFile>();
  return cannot_append(path, "the file cannot be locked");
}

AppendFile::AppendFile(AppendFile&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)) {}

AppendFile& AppendFile::operator=(AppendFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(file_, other.file_);
  return *this;
}

AppendFile::~AppendFile() {
  if (file_ >= 0) ::close(file_);
}

Result<std::string> AppendFile::read() {
  std::string bytes;
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  for (;;) {
    const std::size_t size = bytes.size();
    bytes.resize(size + kChunk);
    const ssize_t count = ::pread(file_, bytes.data() + size, kChunk, static_cast<off_t>(size));
    if (count < 0 && errno != EINTR) return failed(ErrorCode::cannot_open, path_, "reading failed");
    bytes.resize(size + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count == 0) return bytes;
  }
}

Result<void> AppendFile::resize(std::uint64_t bytes) {
  if (::ftruncate(file_, static_cast<off_t>(bytes)) != 0) return cannot_append(path_, "the file cannot be cut off");
  return {};
}

Result<void> AppendFile::append(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return cannot_append(path_, "writing failed");
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return {};
}

namespace {

constexpr unsigned kMostNames = 1000;

int write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(file, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return errno;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return 0;
}

/// Opens a pipe or a device. Of a pipe that nobody reads that would wait for ever: its reader, which may just be
/// starting, is given a second.
int open_for_reader(const std::filesystem::path& path) {
  using namespace std::chrono_literals;
  const auto end = std::chrono::steady_clock::now() + 1s;
  int file = -1;
  while ((file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) < 0) {
    if (errno != ENXIO || std::chrono::steady_clock::now() >= end) return -1;
    std::this_thread::sleep_for(10ms);
    errno = ENXIO;
  }
  // Writing waits as usual.
  ::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) & ~O_NONBLOCK);
  return file;
}

}  // namespace

int may_be_changed(const std::filesystem::path& path) { return ::access(path.c_str(), W_OK) == 0 ? 0 : errno; }

int may_hold_new_files(const std::filesystem::path& folder) {
  return ::access(folder.empty() ? "." : folder.c_str(), W_OK | X_OK) == 0 ? 0 : errno;
}

int write_to_standard_output(std::string_view text) { return write_all(STDOUT_FILENO, text); }

int write_through(const std::filesystem::path& path, std::string_view text) {
  const int file = open_for_reader(path);
  if (file < 0) return errno;
  const int error = write_all(file, text);
  const int closed = ::close(file) == 0 ? 0 : errno;
  return error ? error : closed;
}

OutputDraft::OutputDraft(const std::filesystem::path& target) : target_(target), directory_(target.parent_path()) {
  if (directory_.empty()) directory_ = ".";
}

OutputDraft::~OutputDraft() {
  if (file_ >= 0) ::close(file_);
  if (!name_.empty()) ::unlink(name_.c_str());
}

int OutputDraft::open() {
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

int OutputDraft::write(std::string_view text) {
  if (const int error = write_all(file_, text)) return error;
  struct stat old;
  if (::stat(target_.c_str(), &old) == 0 && ::fchmod(file_, old.st_mode & 0777) != 0) return errno;
  return ::fsync(file_) == 0 ? 0 : errno;
}

int OutputDraft::publish() {
  if (const int error = name_.empty() ? give_name() : 0) return error;
  const int closed = ::close(std::exchange(file_, -1)) == 0 ? 0 : errno;
  if (closed) return closed;
  if (::rename(name_.c_str(), target_.c_str()) != 0) return errno;
  name_.clear();
  return 0;
}

std::string OutputDraft::draft_name(unsigned attempt) const {
  const std::string number = std::to_string(::getpid()) + "-" + std::to_string(attempt);
  return (directory_ / ("." + target_.filename().string() + "." + number + ".part")).string();
}

int OutputDraft::give_name() {
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

}  // namespace dymsum::base
