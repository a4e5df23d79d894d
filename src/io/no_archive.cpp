// Stands for archive.cpp where zlib and libzip are not linked.
#include "io/archive.h"
#include "io/read_file.h"

namespace dymsum::io {

namespace {

Error none(std::string_view file) {
  return file_error(ErrorCode::unsupported_format, "compressed files are read and written by the native program only",
                    file);
}

}  // namespace

bool has_archives() { return false; }
bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }
bool is_zip(std::string_view bytes) { return bytes.starts_with("PK"); }
Result<std::string> unzipped_gz(std::string_view, std::string_view file) { return none(file); }
Result<std::string> gz_of(std::string_view) { return none({}); }
Result<std::string> zip_entry(std::string_view, const std::string&, std::string_view file) { return none(file); }
Result<std::string> zip_of(std::span<const ZipEntry>) { return none({}); }

}  // namespace dymsum::io
