// What writing files needs of the operating system; with output_file.cpp, the one place in the library that calls it.
// Every function gives 0 or an error number of <cerrno>.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dymsum::base {

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
