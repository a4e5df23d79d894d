// Compressed files: .gz around any file, and the .zip that a .3mf is. Where the library is compiled without zlib and
// libzip (WebAssembly), they are refused by name.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "dymsum/result.h"

namespace dymsum::io {

/// What a compressed file of so many bytes may hold at most: files that people have shrink to a twentieth or less, and
/// those that are made to fill memory to a thousandth.
constexpr std::uint64_t most_unpacked(std::uint64_t packed) { return (std::uint64_t{1} << 26) + 100 * packed; }

/// Whether this library was compiled with what reads and writes them.
bool has_archives();

bool is_gzip(std::string_view bytes);
bool is_zip(std::string_view bytes);

/// What a .gz file holds; of several members one after the other, all. Errors: truncated, malformed, out_of_memory past
/// most_unpacked, unsupported_format without archives.
Result<std::string> unzipped_gz(std::string_view bytes, std::string_view file);
/// The bytes of a .gz file, the same for the same text. Error unsupported_format without archives.
Result<std::string> gz_of(std::string_view text);

struct ZipEntry {
  std::string name, content;
};
/// The content of the entry of this name, in any case (as the packages of Windows' programs have it); empty where there
/// is none. Errors as unzipped_gz, also for encrypted entries.
Result<std::string> zip_entry(std::string_view bytes, const std::string& name, std::string_view file);
/// The bytes of a .zip file, the same for the same entries. Error unsupported_format without archives.
Result<std::string> zip_of(std::span<const ZipEntry> entries);

}  // namespace dymsum::io
