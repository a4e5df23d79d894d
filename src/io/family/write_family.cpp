#include <algorithm>
#include <span>

#include "dymsum/family_file.h"
#include "io/family/family_text.h"
#include "planar/family/scaling_family.h"

namespace dymsum {
namespace {

using FamilyJson = nlohmann::json;
using planar::SumStructures;

FamilyJson name_json(const SumVertex& v) {
  FamilyJson json = FamilyJson::array();
  for (const Contact* c : {&v.in, &v.out})
    for (const std::uint32_t n : {static_cast<std::uint32_t>(c->kind), c->p, c->q}) json.push_back(n);
  if (v.corner_p == SumVertex::kNone) return json;
  json.push_back(v.corner_p);
  json.push_back(v.corner_q);
  return json;
}

FamilyJson event_json(const ScaleEvent& e) {
  return FamilyJson::array({e.parameter.to_string(), static_cast<int>(e.kind), e.visible ? 1 : 0, e.topology ? 1 : 0});
}

class CellsWriter {
 public:
  explicit CellsWriter(const planar::ScalingCells& cells) : cells_(cells) {}

  FamilyJson cell(std::uint32_t k) {
    const SumStructures& structures = cells_.structures;
    if (!structures.kept(k)) return nullptr;
    FamilyJson parts = FamilyJson::array();
    for (const SumStructures::Ring& ring : structures.rings(k)) {
      if (!ring.hole) parts.push_back(FamilyJson::array());
      parts.back().push_back(ring_json(ring));
    }
    known_.next_cell();
    return FamilyJson::array({cells_.named_at[k], std::move(parts), pieces_json(structures.pieces(k))});
  }

 private:
  FamilyJson ring_json(const SumStructures::Ring& ring) {
    const std::span<const std::uint32_t> now = cells_.structures.vertices(ring);
    const io::KnownRings::Names& then = known_.before(ring.identity);
    const std::size_t most = std::min(now.size(), then.size());
    std::size_t head = 0, tail = 0;
    while (head < most && now[head] == then[head]) ++head;
    while (head + tail < most && now[now.size() - 1 - tail] == then[then.size() - 1 - tail]) ++tail;
    FamilyJson json = FamilyJson::array({ring.identity, head, tail});
    for (const std::uint32_t name : now.subspan(head, now.size() - head - tail)) json.push_back(name);
    known_.add(ring.identity, {now.begin(), now.end()});
    return json;
  }
  FamilyJson pieces_json(const SumStructures::Pieces& pieces) const {
    FamilyJson json = FamilyJson::array({pieces.segments, pieces.points, pieces.tight_segments, pieces.tight_points});
    for (const std::uint32_t name : cells_.structures.vertices(pieces)) json.push_back(name);
    return json;
  }

  const planar::ScalingCells& cells_;
  io::KnownRings known_;
};

FamilyJson options_json(const FamilyOptions& options) {
  return {{"moving", name(options.moving)},
          {"reflect_q", options.reflect_q ? 1 : 0},
          {"semantics", name(options.semantics)},
          {"structure_bytes", options.structure_bytes}};
}

}  // namespace

std::string format_family(const ScalingFamily& family) {
  const planar::FamilyInternals::State& s = planar::FamilyInternals::of(family);
  FamilyJson content = {{"motion", io::kScalingMotion},       {"p", io::region_json(s.p)},
                        {"q", io::region_json(s.q)},          {"low", s.low.exact().to_string()},
                        {"high", s.high.exact().to_string()}, {"ratio", s.ratio.exact().to_string()},
                        {"options", options_json(s.options)}, {"events", FamilyJson::array()},
                        {"names", FamilyJson::array()},       {"cells", FamilyJson::array()}};
  for (const ScaleEvent& e : s.cells.events) content["events"].push_back(event_json(e));
  for (const SumVertex& v : s.cells.structures.names()) content["names"].push_back(name_json(v));
  CellsWriter writer(s.cells);
  for (std::uint32_t k = 0; k < s.cells.structures.cell_count(); ++k) content["cells"].push_back(writer.cell(k));
  return io::format_checked(io::kFamilyFormat, content);
}

}  // namespace dymsum
