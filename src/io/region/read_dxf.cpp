// DXF text: the planar lines and arcs of the section ENTITIES, as one shape.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/region/dxf_arc.h"
#include "io/region/dxf_chains.h"
#include "io/region/dxf_groups.h"
#include "io/region/dxf_layers.h"
#include "io/region/dxf_words.h"
#include "io/region/readers.h"
#include "io/region/ring_order.h"

namespace dymsum::io {
namespace {

/// A vertex with the bulge of the segment that leaves it.
struct DxfVertex {
  Point at;
  double bulge = 0;
};

class DxfReader {
 public:
  explicit DxfReader(const Source& source) : source_(source) {}

  RegionData read() {
    const std::vector<DxfGroup> groups = dxf_groups(source_);
    const std::vector<DxfEntity> entities = dxf_entities(source_, groups, "ENTITIES");
    own_ = is_own_dxf(source_, groups, entities);
    hidden_layers_.emplace(source_, groups);
    for (const DxfEntity& entity : entities) take(entity);
    if (open_polyline_) fail(*open_polyline_, "the polyline is not ended by SEQEND");
    DxfChains chains = join_pieces(source_, std::move(pieces_));
    std::move(chains.rings.begin(), chains.rings.end(), std::back_inserter(rings_));
    std::move(chains.polylines.begin(), chains.polylines.end(), std::back_inserter(data_.polylines));
    if (!own_ && !nest_rings(std::move(rings_), data_.parts))
      source_.fail(ErrorCode::malformed, "too many rings around one another", 0);
    return std::move(data_);
  }

 private:
  [[noreturn]] void fail(const DxfEntity& entity, const std::string& what) const {
    source_.fail(ErrorCode::malformed, what, entity.offset);
  }

  double number(const DxfEntity& entity, int code, const char* what) const {
    const DxfGroup* const group = entity.find(code);
    if (group == nullptr) fail(entity, std::string(entity.kind) + " has no " + what);
    return dxf_number(source_, *group);
  }
  int flags(const DxfEntity& entity, int code) const {
    const DxfGroup* const group = entity.find(code);
    return group == nullptr ? 0 : dxf_flags(source_, *group);
  }
  Point point(const DxfEntity& entity, int code) const {
    return {number(entity, code, "x coordinate"), number(entity, code + 10, "y coordinate")};
  }

  /// Entities outside of the plane z = 0, or that are seen from another side.
  void require_planar(const DxfEntity& entity) const {
    const bool vertices = entity.kind != "LWPOLYLINE";
    for (const DxfGroup& group : entity) {
      const bool third = (vertices && (group.code == 30 || group.code == 31)) || group.code == 38;
      if (third && source_.drops_third) continue;
      if ((third || group.code == 210 || group.code == 220) && dxf_number(source_, group) != 0)
        source_.fail(ErrorCode::malformed, "only what lies in the plane z = 0 can be read", group.offset);
      if (group.code == 230 && !(dxf_number(source_, group) > 0))
        source_.fail(ErrorCode::malformed, "only what is seen from above can be read", group.offset);
    }
  }

  /// Invisible, on a layer that is, or not in the model but on a sheet of paper.
  bool is_hidden(const DxfEntity& entity) const {
    return flags(entity, 60) == 1 || flags(entity, 67) == 1 || hidden_layers_->contains(dxf_layer(entity));
  }

  static bool is_annotation(std::string_view kind) {
    static constexpr std::array<std::string_view, 7> kKinds = {"TEXT",   "MTEXT",    "DIMENSION", "LEADER",
                                                               "ATTDEF", "VIEWPORT", "MLEADER"};
    return std::find(kKinds.begin(), kKinds.end(), kind) != kKinds.end();
  }

  void take(const DxfEntity& entity) {
    if (open_polyline_) return take_vertex(entity);
    if (is_annotation(entity.kind)) return;
    if (is_hidden(entity)) return take_hidden(entity);
    require_planar(entity);
    if (entity.kind == "LWPOLYLINE") take_light_polyline(entity);
    else if (entity.kind == "POLYLINE") begin_polyline(entity);
    else if (entity.kind == "LINE") take_line(entity);
    else if (entity.kind == "ARC") take_arc(entity);
    else if (entity.kind == "CIRCLE") take_circle(entity);
    else if (entity.kind == "POINT") data_.points.push_back(point(entity, 10));
    else if (entity.kind == "INSERT") fail(entity, "INSERT draws a block: explode blocks into their lines first");
    else fail(entity, in_quotes(entity.kind) + " cannot be read: only lines, polylines, arcs, circles and points can");
  }

  /// The vertices of a hidden polyline follow it.
  void take_hidden(const DxfEntity& entity) {
    if (entity.kind == "POLYLINE") open_polyline_ = entity;
  }

  void take_light_polyline(const DxfEntity& entity) {
    std::vector<DxfVertex> vertices;
    bool y_missing = false;
    for (const DxfGroup& group : entity) {
      if (group.code == 10) {
        if (y_missing) source_.fail(ErrorCode::malformed, "a vertex without y coordinate", group.offset);
        vertices.push_back({{dxf_number(source_, group), 0}, 0});
        y_missing = true;
      } else if (group.code == 20) {
        if (!y_missing) source_.fail(ErrorCode::malformed, "a y coordinate without x", group.offset);
        vertices.back().at.y = dxf_number(source_, group);
        y_missing = false;
      } else if (group.code == 42) {
        if (vertices.empty()) source_.fail(ErrorCode::malformed, "a bulge without vertex", group.offset);
        vertices.back().bulge = dxf_number(source_, group);
      }
    }
    if (y_missing) fail(entity, "a vertex without y coordinate");
    if (const DxfGroup* const count = entity.find(90);
        count != nullptr && dxf_number(source_, *count) != static_cast<double>(vertices.size()))
      source_.fail(ErrorCode::malformed,
                   "there are " + std::to_string(vertices.size()) + " vertices, not " + in_quotes(count->value),
                   count->offset);
    add_chain(entity, vertices, (flags(entity, 70) & 1) != 0);
  }

  // A polyline is followed by its vertices and ended by SEQEND.
  void begin_polyline(const DxfEntity& entity) {
    constexpr int kFitted = 2 | 4, kMesh = 16 | 64;
    if ((flags(entity, 70) & (kFitted | kMesh)) != 0) fail(entity, "fitted curves and meshes cannot be read");
    open_polyline_ = entity;
    vertices_.clear();
  }

  void take_vertex(const DxfEntity& entity) {
    if (entity.kind == "VERTEX" && is_hidden(*open_polyline_)) return;
    if (entity.kind == "VERTEX") {
      require_planar(entity);
      const DxfGroup* const bulge = entity.find(42);
      vertices_.push_back({point(entity, 10), bulge == nullptr ? 0 : dxf_number(source_, *bulge)});
      return;
    }
    if (entity.kind != "SEQEND") fail(*open_polyline_, "the polyline is not ended by SEQEND");
    const DxfEntity polyline = *std::exchange(open_polyline_, std::nullopt);
    if (!is_hidden(polyline)) add_chain(polyline, vertices_, (flags(polyline, 70) & 1) != 0);
  }

  void add_chain(const DxfEntity& entity, const std::vector<DxfVertex>& vertices, bool closed) {
    std::vector<Point> chain;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      chain.push_back(vertices[i].at);
      if (i + 1 < vertices.size() || closed)
        append_bulge(chain, vertices[i].at, vertices[(i + 1) % vertices.size()].at, vertices[i].bulge);
    }
    require_finite(entity, chain);
    if (own_) return add_own(entity, std::move(chain));
    const bool meets = chain.size() > 2 && chain.front() == chain.back();
    if (meets) chain.pop_back();
    if (chain.empty()) fail(entity, "a polyline without vertices");
    if (closed || meets) rings_.push_back(std::move(chain));
    else data_.polylines.push_back(std::move(chain));
  }

  /// Takes a chain of a file of our own as it stands, distinguished by its layer.
  void add_own(const DxfEntity& entity, std::vector<Point> chain) {
    const std::string_view layer = dxf_layer(entity);
    if (layer == kDxfOuter) data_.parts.push_back({std::move(chain), {}});
    else if (layer == kDxfHole) data_.parts.back().holes.push_back(std::move(chain));
    else data_.polylines.push_back(std::move(chain));
  }

  void require_finite(const DxfEntity& entity, const std::vector<Point>& chain) const {
    for (const Point p : chain)
      if (!std::isfinite(p.x) || !std::isfinite(p.y))
        source_.fail(ErrorCode::not_finite, "the arc leaves the range of doubles", entity.offset);
  }

  double radius(const DxfEntity& entity) const {
    const double r = number(entity, 40, "radius");
    if (!(r > 0)) fail(entity, "the radius has to be positive");
    return r;
  }

  void take_line(const DxfEntity& entity) {
    const Point from = point(entity, 10), to = point(entity, 11);
    if (from != to) pieces_.push_back({{from, to}, 0, entity.offset});  // one without length draws nothing
  }

  void take_arc(const DxfEntity& entity) {
    const double r = radius(entity);
    std::vector<Point> chain =
        arc_chain(point(entity, 10), r, number(entity, 50, "first angle"), number(entity, 51, "last angle"));
    if (chain.empty()) fail(entity, "the arc begins and ends in the same direction");
    require_finite(entity, chain);
    pieces_.push_back({std::move(chain), r * kArcJoint, entity.offset});
  }

  void take_circle(const DxfEntity& entity) {
    Ring ring = circle_ring(point(entity, 10), radius(entity));
    require_finite(entity, ring);
    rings_.push_back(std::move(ring));
  }

  const Source& source_;
  bool own_ = false;
  std::optional<DxfHiddenLayers> hidden_layers_;
  RegionData data_;
  std::vector<Ring> rings_;
  std::vector<DxfPiece> pieces_;
  std::optional<DxfEntity> open_polyline_;
  std::vector<DxfVertex> vertices_;  ///< of that
};

}  // namespace

std::vector<NamedShape> read_dxf(const Source& source) { return {{"", DxfReader(source).read()}}; }

}  // namespace dymsum::io
