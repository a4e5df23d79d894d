#include "io/region/dxf_blocks.h"

#include <cmath>
#include <utility>

#include "io/region/dxf_arc.h"
#include "io/region/dxf_layers.h"

namespace dymsum::io {
namespace {

constexpr int kMostCopies = 10000;  // of one INSERT

double number_or(const Source& source, const DxfEntity& entity, int code, double otherwise) {
  const DxfGroup* const group = entity.find(code);
  return group == nullptr ? otherwise : dxf_number(source, *group);
}

int count_or_one(const Source& source, const DxfEntity& insert, int code) {
  const DxfGroup* const group = insert.find(code);
  const int count = group == nullptr ? 1 : dxf_flags(source, *group);
  if (count > kMostCopies) source.fail(ErrorCode::malformed, "INSERT draws too many copies", group->offset);
  return std::max(count, 1);
}

}  // namespace

std::map<std::string, DxfBlock> dxf_blocks(const Source& source, const std::vector<DxfGroup>& groups) {
  std::map<std::string, DxfBlock> blocks;
  DxfBlock* open = nullptr;
  for (const DxfEntity& entity : dxf_entities(source, groups, "BLOCKS")) {
    if (entity.kind == "BLOCK") {
      const DxfGroup* const name = entity.find(2);
      if (name == nullptr) source.fail(ErrorCode::malformed, "a block without a name", entity.offset);
      open = &blocks[without_case(name->value)];
      *open = {{number_or(source, entity, 10, 0), number_or(source, entity, 20, 0)}, {}};
    } else if (entity.kind == "ENDBLK") {
      open = nullptr;
    } else if (open != nullptr) {
      open->entities.push_back(entity);
    }
  }
  return blocks;
}

// The base comes to the origin, is scaled, moved to its row and column, rotated, and moved to its position.
std::vector<PlaneTransform> dxf_placements(const Source& source, const DxfEntity& insert, const DxfBlock& block) {
  const auto number = [&](int code, double otherwise) { return number_or(source, insert, code, otherwise); };
  const Point x_axis = direction(number(50, 0));
  const PlaneTransform rotation{x_axis.x, x_axis.y, -x_axis.y, x_axis.x, number(10, 0), number(20, 0)};
  const PlaneTransform scaling{number(41, 1), 0, 0, number(42, 1), 0, 0},
      moved{1, 0, 0, 1, -block.base.x, -block.base.y};
  if (scaling.a == 0 || scaling.d == 0)
    source.fail(ErrorCode::malformed, "INSERT scales its block to nothing", insert.offset);
  const int columns = count_or_one(source, insert, 70), rows = count_or_one(source, insert, 71);
  if (columns * rows > kMostCopies) source.fail(ErrorCode::malformed, "INSERT draws too many copies", insert.offset);
  std::vector<PlaneTransform> placements;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const PlaneTransform step{1, 0, 0, 1, column * number(44, 0), row * number(45, 0)};
      placements.push_back(rotation.after(step).after(scaling).after(moved));
    }
  return placements;
}

}  // namespace dymsum::io
