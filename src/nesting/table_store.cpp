#include "nesting/table_store.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/bytes.h"
#include "io/read_file.h"
#include "nesting/answer_record.h"

namespace dymsum::nesting {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "dymsumNT", kExtension = ".nfpt";
/// Magic, format, nothing, checksum of these; length of the payload, nothing, checksum of it.
constexpr std::size_t kHeader = 24, kFrame = 16;

std::string store_header() {
  std::string header(kMagic);
  io::append_bytes(header, kRecordFormat);
  io::append_bytes(header, std::uint32_t{0});
  io::append_bytes(header, checksum(header));
  return header;
}

std::string record_of(const Key& key, const TableAnswer& answer) {
  std::string payload(key.begin(), key.end());
  append_answer(payload, answer);
  std::string record;
  io::append_bytes(record, std::uint64_t{payload.size()});
  io::append_bytes(record, checksum(payload));
  return record + payload;
}

Error store_error(ErrorCode code, const std::string& what, const fs::path& path) {
  return io::file_error(code, what, path.string());
}

/// What was found in a file.
struct Scan {
  std::size_t good = 0;     ///< bytes from its beginning
  std::string why;          ///< what is wrong behind them; empty where nothing is
  bool unfinished = false;  ///< it ends within a record, as where a process is writing or was killed
};

}  // namespace

class StoreReader {
 public:
  StoreReader(const std::vector<Key>& keys, std::vector<std::optional<TableAnswer>>& answers) : answers_(answers) {
    for (std::uint32_t i = 0; i < keys.size(); ++i) index_of_.emplace(keys[i], i);
  }

  Scan scan(std::string_view bytes) {
    if (bytes.empty()) return {};
    const std::string header = store_header();
    if (header.starts_with(bytes.substr(0, kHeader)) && bytes.size() < kHeader)
      return {0, "its header is cut off", true};
    if (!bytes.starts_with(header)) return {0, "it is not a store of this version, or its header is damaged", false};
    std::size_t at = kHeader;
    while (at < bytes.size()) {
      const std::string_view rest = bytes.substr(at);
      const auto number = [&](std::size_t offset) {
        return io::from_bytes<std::uint64_t>(rest, offset, std::endian::little);
      };
      if (rest.size() < kFrame || number(0) > rest.size() - kFrame)
        return {at, "it ends within a record, from byte " + std::to_string(at) + " on", true};
      const std::string_view payload = rest.substr(kFrame, number(0));
      if (checksum(payload) != number(8) || !take(payload))
        return {at, "it is damaged at byte " + std::to_string(at), false};
      at += kFrame + payload.size();
    }
    return {at, "", false};
  }

 private:
  /// Whether it is a record.
  bool take(std::string_view payload) {
    Key key{};
    if (payload.size() < key.size()) return false;
    std::copy_n(payload.begin(), key.size(), key.begin());
    std::optional<TableAnswer> answer = answer_in(payload.substr(key.size()));
    if (!answer) return false;
    const auto found = index_of_.find(key);
    if (found == index_of_.end()) return true;
    std::optional<TableAnswer>& slot = answers_[found->second];
    if (!slot || slot->status == TableAnswer::Status::timed_out) slot = std::move(answer);
    return true;
  }

  std::map<Key, std::uint32_t> index_of_;
  std::vector<std::optional<TableAnswer>>& answers_;
};

namespace {

Result<base::AppendFile> own_file(const StorePath& position) {
  const std::string stem = "shard-" + std::to_string(position.shard) + "-of-" + std::to_string(position.shards) + ".";
  for (std::uint64_t k = 1;; ++k) {
    Result<std::optional<base::AppendFile>> file = base::AppendFile::open(
        (fs::path(position.folder) / (stem + std::to_string(k) + std::string(kExtension))).string());
    if (!file) return file.error();
    std::optional<base::AppendFile> opened = std::move(file).value();
    if (opened) return *std::move(opened);
  }
}

/// What is there is no folder.
std::optional<Error> other_than_folder(const fs::path& path, ErrorCode code) {
  std::error_code unknown;
  const fs::file_status status = fs::status(path, unknown);
  if (fs::is_directory(status)) return std::nullopt;
  if (fs::exists(status)) return store_error(code, "this is not a folder", path);
  if (fs::is_symlink(path, unknown)) return store_error(code, "this is a symbolic link to what is not there", path);
  return std::nullopt;
}

/// The files of a store, by name.
Result<std::vector<fs::path>> files_of(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code failed;
  for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed))
    if (at->path().extension() == kExtension) files.push_back(at->path());
  if (failed) return store_error(ErrorCode::cannot_open, "the folder cannot be read: " + failed.message(), folder);
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

Result<TableStore> TableStore::open(const StorePath& position, bool writable, const std::vector<Key>& keys,
                                    std::vector<std::optional<TableAnswer>>& answers) {
  TableStore store;
  if (position.folder.empty()) return store;
  StoreReader reader(keys, answers);
  const ErrorCode code = writable ? ErrorCode::cannot_write : ErrorCode::cannot_open;
  if (std::optional<Error> error = other_than_folder(position.folder, code)) return *std::move(error);
  if (writable) {
    std::error_code failed;
    fs::create_directories(position.folder, failed);
    if (failed)
      return store_error(ErrorCode::cannot_write, "the folder cannot be made: " + failed.message(), position.folder);
    Result<base::AppendFile> own = own_file(position);
    if (own) store.own_ = std::move(own).value();
    else store.unwritable_ = own.error();
  }
  const Result<std::vector<fs::path>> files = files_of(position.folder);
  if (!files) return files.error();
  for (const fs::path& file : *files) {
    const bool own = store.own_ && fs::path(store.own_->path()) == file;
    // A pipe or a device may never end.
    if (std::error_code unknown; !own && !fs::is_regular_file(file, unknown)) {
      store.refused_.push_back({file.string(), "it is not a regular file"});
      continue;
    }
    const Result<std::string> bytes = own ? store.own_->read() : io::read_file(file.string());
    if (!bytes) return bytes.error();
    const Scan scan = reader.scan(*bytes);
    ++store.files_;
    // What another process is just writing is no damage.
    if (!scan.why.empty() && (own || !scan.unfinished)) store.refused_.push_back({file.string(), scan.why});
    if (own && scan.good < bytes->size())
      if (const Result<void> cut = store.own_->resize(scan.good); !cut) return cut.error();
    if (own) store.begun_ = scan.good > 0;
  }
  return store;
}

Result<void> TableStore::add(const std::vector<std::pair<Key, const TableAnswer*>>& answers) {
  if (!own_) return {};
  std::string bytes = begun_ ? "" : store_header();
  for (const auto& [key, answer] : answers) bytes += record_of(key, *answer);
  begun_ = true;
  return own_->append(bytes);
}

}  // namespace dymsum::nesting
