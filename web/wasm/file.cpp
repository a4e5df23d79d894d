#include "file.h"

#include <cstdio>
#include <filesystem>
#include <system_error>

#include "bind.h"

namespace dymsum::web {
namespace {

/// Nothing leads out of the current folder, which is empty but for such files.
std::string relative(const std::string& name) {
  std::string path = std::filesystem::path("/" + name).lexically_normal().string();
  path.erase(0, path.find_first_not_of('/'));
  return path;
}

bool is_written(const std::string& path, const std::string& bytes) {
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return false;
  const bool whole = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  return std::fclose(file) == 0 && whole;
}

}  // namespace

FileInMemory::FileInMemory(const std::string& name, const std::string& bytes) : path_(relative(name)), file_(path_) {
  // "#" may also be in the name of a file itself, and of a shape: what is after one and has no extension names a shape.
  for (std::size_t mark = file_.rfind('#'); mark != std::string::npos && file_.find('.', mark) == std::string::npos;
       mark = file_.rfind('#'))
    file_.erase(mark);
  std::error_code ignored;
  std::filesystem::create_directories(std::filesystem::path(file_).parent_path(), ignored);
  if (!is_written(file_, bytes))
    throw Thrown{
        {ErrorCode::cannot_open, "no file can have this name", {name, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}}};
}

FileInMemory::~FileInMemory() {
  std::error_code ignored;
  std::filesystem::remove(file_, ignored);
}

}  // namespace dymsum::web
