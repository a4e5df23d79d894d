#include "planar/mask/cell_bricks.h"

namespace dymsum::planar {

Bricks::Bricks(const Bitmap& cells)
    : rows_((cells.rows + kBrick - 1) / kBrick), columns_((cells.columns + kBrick - 1) / kBrick) {
  const std::size_t width = static_cast<std::size_t>(columns_) + 2;
  words_.assign(width * (static_cast<std::size_t>(rows_) + 2), 0);
  for (int r = 0; r < cells.rows; ++r) {
    std::uint64_t* const to = &words_[static_cast<std::size_t>(r / kBrick + 1) * width + 1];
    const int shift = r % kBrick * 8;
    for (int c = 0; c < columns_; ++c) to[c] |= ((cells.row(r)[c / 8] >> (c % 8 * 8)) & 0xff) << shift;
  }
}

}  // namespace dymsum::planar
