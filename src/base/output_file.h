// Files that are written: whole ones, which replace others when they are complete, and ones that grow.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "dymsum/result.h"

namespace dymsum::base {

// A file that grows by whole records, and that one process at a time writes to.

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

// What writing files needs of the operating system; with output_file.cpp, the one place in the library that calls it.
// Every function gives 0 or an error number of <cerrno>.

/// May this existing file be changed?
int may_be_changed(const std::filesystem::path& path);
/// May files be made in this folder? The empty path is the current one.
int may_hold_new_files(const std::filesystem::path& folder);

int write_to_standard_output(std::string_view text);

/// Writes into a device or a pipe, which cannot be replaced.
int write_through(const std::filesystem::path& path, std::string_view text);

/// A file beside its target that disappears unless `publish` succeeds: nameless where the system has such files, else
/// with another name in the same folder.
class OutputDraft {
 public:
  explicit OutputDraft(const std::filesystem::path& target);
  OutputDraft(const OutputDraft&) = delete;
  OutputDraft& operator=(const OutputDraft&) = delete;
  ~OutputDraft();

  int open();
  /// Writes the file with the permissions of an older target; returns when the text is on the disk.
  int write(std::string_view text);
  /// Takes the target's name, and its position.
  int publish();

 private:
  std::string draft_name(unsigned attempt) const;
  int give_name();

  std::filesystem::path target_, directory_;
  std::string name_;
  int file_ = -1;
};

}  // namespace dymsum::base
