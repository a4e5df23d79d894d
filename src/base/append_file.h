// A file that grows by whole records, and that one process at a time writes to.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "dymsum/result.h"

namespace dymsum::base {

/// Open for appending, and locked until it is closed or the process ends in any way.
class AppendFile {
 public:
  /// Nothing where somebody else has locked it. Made where it is not there. Error cannot_write: also for what is no
  /// regular file.
  static Result<std::optional<AppendFile>> open(const std::string& path);
  AppendFile(AppendFile&& other) noexcept;
  AppendFile& operator=(AppendFile&& other) noexcept;
  ~AppendFile();

  /// All of it. It is not to be opened and closed by other means: on some systems that would lose the lock. Error
  /// cannot_open.
  Result<std::string> read();
  /// Cuts it off. Error cannot_write.
  Result<void> resize(std::uint64_t bytes);
  /// Writes after its end, without a copy in this process: what has been appended survives its death. Error
  /// cannot_write: then part of it may have been written.
  Result<void> append(std::string_view bytes);
  const std::string& path() const { return path_; }

 private:
  AppendFile(std::string path, int file) : path_(std::move(path)), file_(file) {}
  std::string path_;
  int file_ = -1;
};

}  // namespace dymsum::base
