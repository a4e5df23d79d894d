#include "io/region/dxf_layers.h"

#include <algorithm>

#include "io/region/dxf_words.h"

namespace dymsum::io {
namespace {

/// No bulge, nothing hidden, rings closed and lines open.
bool is_own_polyline(const Source& source, const DxfEntity& entity) {
  const std::string_view layer = dxf_layer(entity);
  const bool line = layer == kDxfLine;
  const DxfGroup* const flags = entity.find(70);
  return (line || layer == kDxfOuter || layer == kDxfHole) && flags != nullptr &&
         dxf_flags(source, *flags) == (line ? 0 : 1) && entity.find(10) != nullptr && entity.find(42) == nullptr;
}

bool is_own_entity(const Source& source, const DxfEntity& entity) {
  if (entity.find(60) != nullptr || entity.find(67) != nullptr) return false;
  if (entity.kind == "POINT") return dxf_layer(entity) == kDxfPoint;
  return entity.kind == "LWPOLYLINE" && is_own_polyline(source, entity);
}

}  // namespace

std::string without_case(std::string_view name) {
  std::string text(name);
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string_view dxf_layer(const DxfEntity& entity) {
  const DxfGroup* const layer = entity.find(8);
  return layer == nullptr ? "0" : layer->value;
}

DxfHiddenLayers::DxfHiddenLayers(const Source& source, const std::vector<DxfGroup>& groups) {
  for (const DxfEntity& layer : dxf_entities(source, groups, "TABLES")) {
    const DxfGroup* const name = layer.find(2);
    if (layer.kind != "LAYER" || name == nullptr) continue;
    const DxfGroup *const colour = layer.find(62), *const flags = layer.find(70);
    const bool off = colour != nullptr && dxf_number(source, *colour) < 0;
    const bool frozen = flags != nullptr && (dxf_flags(source, *flags) & 1) != 0;
    if (off || frozen) names_.insert(without_case(name->value));
  }
}

bool DxfHiddenLayers::contains(std::string_view layer) const {
  return !names_.empty() && names_.count(without_case(layer)) > 0;
}

bool is_own_dxf(const Source& source, const std::vector<DxfGroup>& groups, const std::vector<DxfEntity>& entities) {
  if (groups.empty() || groups.front().code != 999 || groups.front().value != kDxfOwn) return false;
  bool outer = false;
  for (const DxfEntity& entity : entities) {
    outer = outer || dxf_layer(entity) == kDxfOuter;
    if (!is_own_entity(source, entity) || (!outer && dxf_layer(entity) == kDxfHole)) return false;
  }
  return dxf_entities(source, groups, "TABLES").empty();
}

}  // namespace dymsum::io
