// Grey images in portable graymap format, P5 (bytes) and P2 (numbers).
#include <algorithm>

#include "io/number_text.h"
#include "io/region/grid_map.h"

namespace dymsum::io {
namespace {

constexpr const char* kTooLarge = "a pixel is larger than the largest value";
constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 30;

class PgmReader {
 public:
  explicit PgmReader(const Source& source) : source_(source), text_(source.text) {}

  GreyImage read() {
    const std::string_view magic = text_.substr(0, 2);
    if (magic != "P5" && magic != "P2") source_.fail(ErrorCode::malformed, "a .pgm file begins with P5 or P2", 0);
    at_ = 2;
    GreyImage image;
    image.width = count("the width", kMostPixels);
    image.height = count("the height", kMostPixels);
    image.most = static_cast<std::uint32_t>(count("the largest value", 65535));
    if (image.width == 0 || image.height == 0 || image.most == 0)
      source_.fail(ErrorCode::malformed, "an image of nothing", at_);
    const std::uint64_t pixels = static_cast<std::uint64_t>(image.width) * image.height;
    if (pixels > kMostPixels) source_.fail(ErrorCode::malformed, "more than 2^30 pixels", at_);
    if (magic == "P5") read_bytes(image, pixels);
    else read_numbers(image, pixels);
    return image;
  }

 private:
  void skip() {
    while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '#')) {
      if (text_[at_] == '#')
        while (at_ < text_.size() && text_[at_] != '\n') ++at_;
      else ++at_;
    }
  }

  std::uint64_t count(const std::string& what, std::uint64_t most) {
    skip();
    if (at_ >= text_.size()) source_.fail(ErrorCode::truncated, "the image ends before " + what, at_);
    const ScannedCount number = scan_count(text_.substr(at_));
    const std::size_t end = at_ + number.length;
    if (number.length == 0 || (end < text_.size() && !is_blank(text_[end])) || number.value > most)
      source_.fail(ErrorCode::malformed, "expected " + what + ", at most " + std::to_string(most), at_);
    at_ = end;
    return number.value;
  }

  // Two bytes each, the larger one first, where values exceed one.
  void read_bytes(GreyImage& image, std::uint64_t pixels) {
    const std::size_t size = image.most > 255 ? 2 : 1;
    if (at_ < text_.size()) ++at_;
    if (text_.size() - at_ < size * pixels)
      source_.fail_in_bytes(ErrorCode::truncated, "the image announces " + std::to_string(pixels) +
                                                      " pixels and ends after " +
                                                      std::to_string((text_.size() - at_) / size) + ", at byte " +
                                                      std::to_string(text_.size()));
    image.pixels.reserve(pixels);
    for (std::uint64_t k = 0; k < pixels; ++k, at_ += size) {
      std::uint32_t value = static_cast<unsigned char>(text_[at_]);
      if (size == 2) value = value << 8 | static_cast<unsigned char>(text_[at_ + 1]);
      if (value > image.most)
        source_.fail_in_bytes(ErrorCode::malformed, kTooLarge + std::string(", at byte ") + std::to_string(at_));
      image.pixels.push_back(static_cast<std::uint16_t>(value));
    }
  }

  void read_numbers(GreyImage& image, std::uint64_t pixels) {
    image.pixels.reserve(std::min<std::uint64_t>(pixels, text_.size() / 2));
    for (std::uint64_t k = 0; k < pixels; ++k) {
      const std::uint64_t value = count("pixel " + std::to_string(k), 65535);
      if (value > image.most) source_.fail(ErrorCode::malformed, kTooLarge, at_);
      image.pixels.push_back(static_cast<std::uint16_t>(value));
    }
  }

  const Source& source_;
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

GreyImage read_pgm(const Source& source) { return PgmReader(source).read(); }

}  // namespace dymsum::io
