// DXF text: the planar lines and curves of the section ENTITIES, and of the blocks that it draws, as one shape.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/region/curves.h"
#include "io/region/dxf_chains.h"
#include "io/region/dxf_groups.h"
#include "io/region/read_shapes.h"
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

  NamedShape read() try {
    const std::vector<DxfGroup> groups = dxf_groups(source_);
    const std::vector<DxfEntity> entities = dxf_entities(source_, groups, "ENTITIES");
    own_ = is_own_dxf(source_, groups, entities);
    hidden_layers_.emplace(source_, groups);
    blocks_ = dxf_blocks(source_, groups);
    take_all(entities);
    DxfChains chains = join_pieces(source_, std::move(pieces_));
    std::move(chains.rings.begin(), chains.rings.end(), std::back_inserter(rings_));
    for (ChordChain& chain : chains.open) data_.polylines.push_back(std::move(chain.on));
    if (!own_ && !nest_chains(std::move(rings_), data_.parts, source_.options.curves.bound))
      source_.fail(ErrorCode::malformed, "too many rings around one another", 0);
    return {"", std::move(data_), unit_of(groups), curves_};
  } catch (const CurveFailure& failure) {
    source_.fail(failure.trouble == CurveTrouble::not_finite ? ErrorCode::not_finite : ErrorCode::malformed,
                 text_of(failure), at_);
  }

 private:
  static constexpr int kMostNested = 16;
  static constexpr std::size_t kMostEntities = 1'000'000;

  /// The unit by the codes of $INSUNITS.
  std::string unit_of(const std::vector<DxfGroup>& groups) const {
    static constexpr const char* kUnits[] = {"", "in", "ft", "mi", "mm", "cm", "m", "km"};
    const DxfGroup* const unit = dxf_variable(groups, "$INSUNITS");
    const std::size_t code = unit == nullptr ? 0 : static_cast<std::size_t>(dxf_flags(source_, *unit));
    return code < std::size(kUnits) ? kUnits[code] : code == 13 ? "um" : "";
  }

  void take_all(const std::vector<DxfEntity>& entities) {
    for (const DxfEntity& entity : entities) {
      at_ = entity.offset;
      if (++taken_ > kMostEntities) fail(entity, "blocks draw more than 1000000 entities");
      take(entity);
    }
    if (open_polyline_) fail(*open_polyline_, "the polyline is not ended by SEQEND");
  }

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
      if (group.code == 230 && entity.kind == "SPLINE") continue;  // its points lie in the plane, whatever is up
      if (third && source_.drops_third()) continue;
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
    static constexpr std::array<std::string_view, 8> kKinds = {"TEXT",   "MTEXT",    "DIMENSION", "LEADER",
                                                               "ATTDEF", "VIEWPORT", "MLEADER",   "ATTRIB"};
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
    else if (entity.kind == "ELLIPSE") take_ellipse(entity);
    else if (entity.kind == "SPLINE") take_spline(entity);
    else if (entity.kind == "POINT") data_.points.push_back(placed(entity, point(entity, 10)));
    else if (entity.kind == "INSERT") take_insert(entity);
    else if (entity.kind == "SEQEND" && std::exchange(attributes_open_, false)) return;
    else
      fail(entity,
           in_quotes(entity.kind) +
               " cannot be read: only lines, polylines, arcs, circles, ellipses, splines, points and blocks can");
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

  Point placed(const DxfEntity& entity, Point p) const {
    const Point at = placement_.apply(p);
    if (!std::isfinite(at.x) || !std::isfinite(at.y))
      source_.fail(ErrorCode::not_finite, "a coordinate leaves the range of doubles", entity.offset);
    return at;
  }
  EllipseArc placed(const DxfEntity& entity, const EllipseArc& arc) const {
    return {placed(entity, arc.start), placement_.apply_vector(arc.u), placement_.apply_vector(arc.v), arc.sweep};
  }

  void add_chain(const DxfEntity& entity, const std::vector<DxfVertex>& vertices, bool closed) {
    ChordChain chain;
    if (!vertices.empty()) chain.add(placed(entity, vertices.front().at));
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (i + 1 == vertices.size() && !closed) break;
      const DxfVertex &from = vertices[i], &to = vertices[(i + 1) % vertices.size()];
      const Point end = placed(entity, to.at);
      if (from.bulge == 0 || from.at == to.at) chain.add(end);
      else append_arc(chain, placed(entity, bulge_arc(from.at, to.at, from.bulge)), end, source_.options.curves);
    }
    if (closed && !chain.empty()) chain.pop_back();
    curves_ += chain.curves;
    if (own_) return add_own(entity, std::move(chain.on));
    const bool meets = chain.on.size() > 2 && chain.front() == chain.back();
    if (meets) chain.pop_back();
    if (chain.empty()) fail(entity, "a polyline without vertices");
    if (closed || meets) rings_.push_back(std::move(chain));
    else data_.polylines.push_back(std::move(chain.on));
  }

  /// Takes a chain of a file of our own as it stands, distinguished by its layer.
  void add_own(const DxfEntity& entity, std::vector<Point> chain) {
    const std::string_view layer = dxf_layer(entity);
    if (layer == kDxfOuter) data_.parts.push_back({std::move(chain), {}});
    else if (layer == kDxfHole) data_.parts.back().holes.push_back(std::move(chain));
    else data_.polylines.push_back(std::move(chain));
  }

  double radius(const DxfEntity& entity) const {
    const double r = number(entity, 40, "radius");
    if (!(r > 0)) fail(entity, "the radius has to be positive");
    return r;
  }

  void take_line(const DxfEntity& entity) {
    DxfPiece piece{{}, 0, entity.offset};
    for (const int code : {10, 11}) piece.chain.add(placed(entity, point(entity, code)));
    if (piece.chain.front() != piece.chain.back()) pieces_.push_back(std::move(piece));  // else it draws nothing
  }

  void add_arc(const DxfEntity& entity, const EllipseArc& arc, Point end) {
    const EllipseArc there = placed(entity, arc);
    DxfPiece piece{{}, there.reach() * kArcJoint, entity.offset};
    piece.chain.add(there.start);
    append_arc(piece.chain, there, placed(entity, end), source_.options.curves);
    ++curves_;
    pieces_.push_back(std::move(piece));
  }

  void add_ellipse(const DxfEntity& entity, Point centre, Point u, Point v) {
    rings_.push_back(ellipse_ring(placed(entity, centre), placement_.apply_vector(u), placement_.apply_vector(v),
                                  source_.options.curves));
    ++curves_;
  }

  void take_arc(const DxfEntity& entity) {
    const double r = radius(entity), from = number(entity, 50, "first angle"), to = number(entity, 51, "last angle");
    const Point centre = point(entity, 10);
    const std::optional<EllipseArc> arc = degree_arc(centre, r, from, to);
    if (!arc) fail(entity, "the arc begins and ends in the same direction");
    add_arc(entity, *arc, on_circle(centre, r, to));
  }

  void take_circle(const DxfEntity& entity) {
    const double r = radius(entity);
    add_ellipse(entity, point(entity, 10), {r, 0}, {0, r});
  }

  void take_ellipse(const DxfEntity& entity) {
    constexpr double kWhole = 2 * std::numbers::pi, kNear = 1e-9;
    const Point centre = point(entity, 10), u = point(entity, 11);
    const double ratio = number(entity, 40, "ratio of its axes");
    if (!(ratio > 0) || (u.x == 0 && u.y == 0)) fail(entity, "the axes of the ellipse have to be positive");
    const Point v{-u.y * ratio, u.x * ratio};
    const double from = entity.find(41) != nullptr ? number(entity, 41, "") : 0;
    const double to = entity.find(42) != nullptr ? number(entity, 42, "") : kWhole;
    double sweep = std::fmod(to - from, kWhole);
    if (std::abs(sweep) < kNear || kWhole - std::abs(sweep) < kNear) return add_ellipse(entity, centre, u, v);
    if (sweep < 0) sweep += kWhole;
    const auto axis = [&](double t) {
      return Point{u.x * std::cos(t) + v.x * std::sin(t), u.y * std::cos(t) + v.y * std::sin(t)};
    };
    const Point first = axis(from), next = axis(from + std::numbers::pi / 2), last = axis(from + sweep);
    add_arc(entity, {{centre.x + first.x, centre.y + first.y}, first, next, sweep},
            {centre.x + last.x, centre.y + last.y});
  }

  void take_spline(const DxfEntity& entity) {
    const DxfSpline spline = dxf_spline(source_, entity);
    BezierCurve control{{}, spline.control.weights};
    for (const Point p : spline.control.points) control.points.push_back(placed(entity, p));
    CurveOptions options = source_.options.curves;
    const double size = curve_size(control.points);
    if (!options.error) options.error = kCurveError * size;
    if (!(size > 0)) fail(entity, "the spline is a single point");
    DxfPiece piece{{}, size * kArcJoint, entity.offset};
    for (const BezierCurve& curve : spline_curves(spline.degree, spline.knots, control)) {
      if (piece.chain.empty()) piece.chain.add(curve.points.front());
      append_bezier(piece.chain, curve, options);
    }
    piece.chain.curves = 1;
    ++curves_;
    const Point from = piece.chain.front(), to = piece.chain.back();
    const bool closed = (flags(entity, 70) & 1) != 0 || from == to;
    if (!closed) return pieces_.push_back(std::move(piece));
    piece.chain.pop_back();
    rings_.push_back(std::move(piece.chain));
  }

  void take_insert(const DxfEntity& entity) {
    const DxfGroup* const name = entity.find(2);
    const auto block = name == nullptr ? blocks_.end() : blocks_.find(without_case(name->value));
    if (block == blocks_.end()) fail(entity, "INSERT draws a block that there is none of");
    attributes_open_ = flags(entity, 66) == 1;
    if (inside_.size() == kMostNested || std::count(inside_.begin(), inside_.end(), &block->second) > 0)
      fail(entity, "blocks draw each other in a circle, or too deep");
    inside_.push_back(&block->second);
    const bool attributes = std::exchange(attributes_open_, false);
    for (const PlaneTransform& placement : dxf_placements(source_, entity, block->second)) {
      const PlaneTransform outer = std::exchange(placement_, placement_.after(placement));
      take_all(block->second.entities);
      placement_ = outer;
    }
    inside_.pop_back();
    attributes_open_ = attributes;
  }

  const Source& source_;
  bool own_ = false;
  std::optional<DxfHiddenLayers> hidden_layers_;
  std::map<std::string, DxfBlock> blocks_;
  std::vector<const DxfBlock*> inside_;  ///< blocks that are drawn
  PlaneTransform placement_;             ///< of what they draw
  bool attributes_open_ = false;         ///< those of an INSERT follow it, and are ended by SEQEND
  std::size_t taken_ = 0, curves_ = 0;
  std::size_t at_ = 0;  ///< where the entity is that is read
  RegionData data_;
  std::vector<ChordChain> rings_;
  std::vector<DxfPiece> pieces_;
  std::optional<DxfEntity> open_polyline_;
  std::vector<DxfVertex> vertices_;  ///< of that
};

}  // namespace

std::vector<NamedShape> read_dxf(const Source& source) { return {DxfReader(source).read()}; }

}  // namespace dymsum::io
