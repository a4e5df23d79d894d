// Output files appear whole or not at all: the text goes to a draft in the same directory, which takes the target's
// name as the last step.
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "base/output_file.h"
#include "dymsum/region_io.h"
#include "io/archive.h"
#include "io/read_file.h"

namespace dymsum {

namespace {

Error cannot_write(const std::string& path, const std::string& what, int error) {
  Evidence evidence;
  evidence.file = path;
  return {ErrorCode::cannot_write, what + ": " + std::strerror(error), std::move(evidence)};
}

/// Whether something is there that is no file: it can be written to, not replaced.
bool is_device(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

/// The words in which a message names the file that is written for `path`.
std::string where(const std::string& path, const std::filesystem::path& target) {
  return target == path ? "here" : "at " + target.string() + ", where it leads";
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

Result<void> check_writable(const std::string& path) {
  if (path == "-") return {};
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_directory(status))
    return io::file_error(ErrorCode::cannot_write, "this is a directory", path);
  if (std::filesystem::exists(status)) {
    if (const int error = base::may_be_changed(path)) return cannot_write(path, "the file may not be changed", error);
  }
  if (is_device(path)) return {};
  const std::filesystem::path target = written_path(path);
  if (std::filesystem::is_symlink(target, ignored))
    return io::file_error(ErrorCode::cannot_write, "symbolic links lead from it round in a circle", path);
  if (const int error = base::may_hold_new_files(target.parent_path()))
    return cannot_write(path, "no file can be made " + where(path, target), error);
  return {};
}

namespace {

Result<void> write_bytes(const std::string& path, std::string_view text) {
  if (path == "-") {
    const int error = base::write_to_standard_output(text);
    if (error) return cannot_write(path, "writing to standard output failed", error);
    return {};
  }
  if (Result<void> may = check_writable(path); !may) return may;
  if (is_device(path)) {
    const int error = base::write_through(path, text);
    if (std::error_code gone; error == ENXIO && std::filesystem::is_fifo(path, gone))
      return io::file_error(ErrorCode::cannot_write, "nobody reads from this pipe", path);
    if (error) return cannot_write(path, "writing failed", error);
    return {};
  }
  const std::filesystem::path target = written_path(path);
  base::OutputDraft draft(target);
  if (const int error = draft.open()) return cannot_write(path, "no file can be made " + where(path, target), error);
  if (const int error = draft.write(text))
    return cannot_write(path, "writing failed, an older file is untouched", error);
  if (const int error = draft.publish()) return cannot_write(path, "the finished file cannot take its name", error);
  return {};
}

}  // namespace

Result<void> write_file(const std::string& path, std::string_view text) {
  if (!io::ends_in_gz(path)) return write_bytes(path, text);
  const Result<std::string> packed = io::gz_of(text);
  if (!packed) return packed.error();
  return write_bytes(path, *packed);
}

}  // namespace dymsum
