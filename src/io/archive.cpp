#include "io/archive.h"

#include <zip.h>
#include <zlib.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <utility>

#include "io/read_file.h"

namespace dymsum::io {

namespace {

constexpr int kGzip = 16 + MAX_WBITS;  ///< zlib's way to name the format
// Text of a million triangles takes a third of the time that level 9 takes, which is libzip's own choice, and a third
// more bytes.
constexpr int kLevel = 3;
constexpr std::size_t kBlock = std::size_t{1} << 18;

Error too_much(std::string_view file, std::uint64_t packed) {
  return file_error(
      ErrorCode::out_of_memory,
      "what is compressed takes more than " + std::to_string(most_unpacked(packed) >> 20) + " MB; unpack it first",
      file);
}

Error followed_by_other(std::string_view file, std::ptrdiff_t at) {
  return file_error(ErrorCode::malformed,
                    "what is compressed ends, and other bytes follow, from byte " + std::to_string(at) +
                        " on; gzip -dc unpacks what is before them",
                    file);
}

uInt as_size(std::size_t size) {
  return static_cast<uInt>(std::min<std::size_t>(size, std::numeric_limits<uInt>::max()));
}

/// zlib reads through pointers to what is not constant, and changes nothing.
Bytef* input(const char* bytes) { return reinterpret_cast<Bytef*>(const_cast<char*>(bytes)); }

class Inflater {
 public:
  Inflater() {
    if (inflateInit2(&stream_, kGzip) != Z_OK) throw std::bad_alloc();
  }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() { inflateEnd(&stream_); }

  Result<std::string> run(std::string_view bytes, std::string_view file) {
    std::string out;
    std::string block(kBlock, '\0');
    const char* const end = bytes.data() + bytes.size();
    const char* at = bytes.data();
    for (;;) {
      stream_.next_in = input(at);
      stream_.avail_in = as_size(static_cast<std::size_t>(end - at));
      stream_.next_out = reinterpret_cast<Bytef*>(block.data());
      stream_.avail_out = as_size(block.size());
      const int state = inflate(&stream_, Z_NO_FLUSH);
      at = reinterpret_cast<const char*>(stream_.next_in);
      out.append(block.data(), block.size() - stream_.avail_out);
      if (out.size() > most_unpacked(bytes.size())) return too_much(file, bytes.size());
      if (state == Z_MEM_ERROR) throw std::bad_alloc();
      if (state == Z_STREAM_END) {
        const std::string_view rest(at, static_cast<std::size_t>(end - at));
        const std::size_t more = rest.find_first_not_of('\0');  // zeros pad some files
        if (more == std::string_view::npos) return out;
        if (more > 0 || !is_gzip(rest)) return followed_by_other(file, at + more - bytes.data());
        if (inflateReset(&stream_) != Z_OK) throw std::bad_alloc();
      } else if (state == Z_BUF_ERROR || (state == Z_OK && at == end && stream_.avail_out > 0)) {
        return file_error(ErrorCode::truncated, "the compressed file ends early", file);
      } else if (state != Z_OK) {
        return file_error(ErrorCode::malformed, "this is no sound .gz file: " + reason(), file);
      }
    }
  }

 private:
  std::string reason() const { return stream_.msg ? stream_.msg : "its bytes do not fit together"; }
  z_stream stream_{};
};

class ZipError {
 public:
  ZipError() { zip_error_init(&error_); }
  ZipError(const ZipError&) = delete;
  ZipError& operator=(const ZipError&) = delete;
  ~ZipError() { zip_error_fini(&error_); }
  zip_error_t* get() { return &error_; }
  std::string text() { return zip_error_strerror(&error_); }

 private:
  zip_error_t error_{};
};

using Archive = std::unique_ptr<zip_t, decltype(&zip_discard)>;

/// The archive in these bytes, which have to stay; or one that is to be written, into `kept`.
Archive opened(std::string_view bytes, int flags, ZipError& error, zip_source_t** kept = nullptr) {
  zip_source_t* const source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, error.get());
  if (!source) throw std::bad_alloc();
  if (kept) zip_source_keep(*kept = source);
  zip_t* const archive = zip_open_from_source(source, flags, error.get());
  if (!archive) zip_source_free(source);
  return {archive, &zip_discard};
}

Error malformed(std::string_view file, const std::string& why) {
  return file_error(ErrorCode::malformed, "this is no sound .zip file: " + why, file);
}

Result<std::string> whole_source(zip_source_t* source) {
  zip_stat_t about;
  if (zip_source_open(source) != 0 || zip_source_stat(source, &about) != 0) throw std::bad_alloc();
  std::string out(about.size, '\0');
  const zip_int64_t read = zip_source_read(source, out.data(), out.size());
  zip_source_close(source);
  if (read != static_cast<zip_int64_t>(out.size())) throw std::bad_alloc();  // it stands in memory
  return out;
}

}  // namespace

bool has_archives() { return true; }
bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }
bool is_zip(std::string_view bytes) { return bytes.starts_with("PK"); }

Result<std::string> unzipped_gz(std::string_view bytes, std::string_view file) { return Inflater().run(bytes, file); }

Result<std::string> gz_of(std::string_view text) {
  z_stream stream{};  // without a header of ours: no name, no time
  if (deflateInit2(&stream, kLevel, Z_DEFLATED, kGzip, 8, Z_DEFAULT_STRATEGY) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, decltype(&deflateEnd)> closed(&stream, &deflateEnd);
  std::string out, block(kBlock, '\0');
  int state = Z_OK;
  for (std::size_t at = 0; state != Z_STREAM_END;) {
    if (stream.avail_in == 0) {
      stream.next_in = input(text.data() + at);
      stream.avail_in = as_size(text.size() - at);
      at += stream.avail_in;
    }
    stream.next_out = reinterpret_cast<Bytef*>(block.data());
    stream.avail_out = as_size(block.size());
    state = deflate(&stream, at == text.size() ? Z_FINISH : Z_NO_FLUSH);
    if (state == Z_STREAM_ERROR) throw std::bad_alloc();
    out.append(block.data(), block.size() - stream.avail_out);
  }
  return out;
}

Result<std::string> zip_entry(std::string_view bytes, const std::string& name, std::string_view file) {
  ZipError error;
  const Archive archive = opened(bytes, ZIP_RDONLY, error);
  if (!archive) return malformed(file, error.text());
  const zip_int64_t index = zip_name_locate(archive.get(), name.c_str(), ZIP_FL_NOCASE);
  if (index < 0) return std::string();
  const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> entry(
      zip_fopen_index(archive.get(), static_cast<zip_uint64_t>(index), 0), &zip_fclose);
  if (!entry) return malformed(file, "its " + name + ": " + zip_strerror(archive.get()));
  std::string out, block(kBlock, '\0');
  for (;;) {
    const zip_int64_t count = zip_fread(entry.get(), block.data(), block.size());
    if (count < 0) return malformed(file, "its " + name + ": " + zip_file_strerror(entry.get()));
    if (count == 0) return out;
    out.append(block.data(), static_cast<std::size_t>(count));
    if (out.size() > most_unpacked(bytes.size())) return too_much(file, bytes.size());
  }
}

Result<std::string> zip_of(std::span<const ZipEntry> entries) {
  constexpr zip_uint16_t kFirstDay = 0x21;  // of 1980, the first that a .zip can tell
  ZipError error;
  zip_source_t* kept = nullptr;
  Archive archive = opened({}, ZIP_TRUNCATE, error, &kept);
  const std::unique_ptr<zip_source_t, decltype(&zip_source_free)> written(kept, &zip_source_free);
  if (!archive) throw std::bad_alloc();
  for (const ZipEntry& entry : entries) {
    zip_source_t* const content = zip_source_buffer(archive.get(), entry.content.data(), entry.content.size(), 0);
    const zip_int64_t index = content ? zip_file_add(archive.get(), entry.name.c_str(), content, ZIP_FL_ENC_UTF_8) : -1;
    if (index < 0) {
      if (content) zip_source_free(content);
      throw std::bad_alloc();
    }
    const auto at = static_cast<zip_uint64_t>(index);
    if (zip_set_file_compression(archive.get(), at, ZIP_CM_DEFLATE, kLevel) != 0) throw std::bad_alloc();
    zip_file_set_dostime(archive.get(), at, 0, kFirstDay, 0);
  }
  if (zip_close(archive.get()) != 0) throw std::bad_alloc();
  static_cast<void>(archive.release());  // closed
  return whole_source(written.get());
}

}  // namespace dymsum::io
