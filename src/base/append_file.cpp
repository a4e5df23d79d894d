#include "base/append_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
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

}  // namespace dymsum::base
