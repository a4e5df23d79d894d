// Bytes that JavaScript gives, where the library reads files.
#pragma once

#include <string>

#include "bind.h"

namespace dymsum::web {

/// What `action` gives; its errors name the file, also those about the shape that it holds.
template <class Action>
auto in_file(const std::string& name, Action action) {
  try {
    return action();
  } catch (Thrown& thrown) {
    if (thrown.error.evidence.file.empty()) thrown.error.evidence.file = name;
    throw;
  }
}

/// A file of the module's file system, as long as this lives. The name may have folders in front and, for one shape of
/// several, "#NAME" behind.
class FileInMemory {
 public:
  FileInMemory(const std::string& name, const std::string& bytes);
  FileInMemory(const FileInMemory&) = delete;
  FileInMemory& operator=(const FileInMemory&) = delete;
  ~FileInMemory();

  /// The file's path, for the library's readers.
  const std::string& path() const { return path_; }

 private:
  std::string path_, file_;
};

}  // namespace dymsum::web
