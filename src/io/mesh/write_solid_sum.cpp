// A sum of solids as JSON text: an item of a list is a line.
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "dymsum/solid_sum_io.h"
#include "dymsum/volume_text.h"
#include "io/source.h"

namespace dymsum {

namespace {

using Kind = SolidFeature::Kind;
using Loops = std::vector<std::vector<std::uint32_t>>;

std::string kind_of(const SpatialFace& f) {
  if (f.p.kind == Kind::face && f.q.kind == Kind::vertex) return "face_vertex";
  if (f.p.kind == Kind::vertex && f.q.kind == Kind::face) return "vertex_face";
  return f.p.kind == Kind::edge && f.q.kind == Kind::edge ? "edge_edge" : "merged";
}

class SolidSumWriter {
 public:
  explicit SolidSumWriter(const SpatialSum& sum) : sum_(sum) {}

  std::string write() {
    out_ = "{\n";
    counts();
    list("vertex_list", sum_.vertices.size(), [this](std::size_t v) { vertex(v); });
    const std::vector<SpatialEdge> edges = sum_.edges();
    list("edge_list", edges.size(), [&](std::size_t k) { edge(edges[k]); });
    list("face_list", sum_.faces.size(), [this](std::size_t f) { face(sum_.faces[f]); });
    out_ += ",\n\"tight_list\":{\n";
    tight();
    return out_ + "\n}\n}\n";
  }

 private:
  void counts() {
    constexpr std::size_t kMostBits = 16384;
    const std::optional<Rational> volume = sum_.volume_exact_within(kMostBits);
    out_ += "\"shells\":" + std::to_string(sum_.shells) + ",\n\"vertices\":" + std::to_string(sum_.vertices.size()) +
            ",\n\"faces\":" + std::to_string(sum_.faces.size()) + ",\n\"volume\":";
    measure(sum_.volume(), volume_text);
    out_ += ",\n\"volume_exact\":" + (volume ? "\"" + volume->to_string() + "\"" : "null") + ",\n\"area\":";
    measure(sum_.area(), surface_text);
    out_ += ",\n\"tight\":{\"points\":" + std::to_string(sum_.tight_points.size()) +
            ",\"segments\":" + std::to_string(sum_.tight_segments.size()) +
            ",\"faces\":" + std::to_string(sum_.tight_faces.size()) +
            "},\n\"convolution\":{\"fv\":" + std::to_string(sum_.stats.face_vertex) +
            ",\"ee\":" + std::to_string(sum_.stats.edge_edge) + "}";
  }
  /// Past the range of doubles as text.
  void measure(double value, std::string (*text)(const SpatialSum&)) {
    if (std::isnormal(value) || sum_.faces.empty()) io::append_number(out_, value);
    else out_ += "\"" + text(sum_) + "\"";
  }

  template <class Write>
  void list(const char* name, std::size_t count, Write write) {
    if (!out_.ends_with("{\n")) out_ += ",\n";
    out_ += "\"" + std::string(name) + "\":[";
    for (std::size_t k = 0; k < count; ++k) {
      out_ += k == 0 ? "\n" : ",\n";
      write(k);
    }
    out_ += "]";
  }

  void vertex(std::size_t v) {
    const RationalPoint3 at = sum_.exact(v);
    out_ += "{\"at\":[";
    for (const Rational* c : {&at.x, &at.y, &at.z}) {
      if (c != &at.x) out_ += ",";
      if (const double near = c->to_double(); std::isfinite(near)) io::append_number(out_, near);
      else out_ += "null";  // past the range of doubles
    }
    out_ += "],\"exact\":[\"" + at.x.to_string() + "\",\"" + at.y.to_string() + "\",\"" + at.z.to_string() + "\"],";
    pair(sum_.vertex_contacts[v]);
    out_ += "}";
  }
  void edge(const SpatialEdge& e) {
    out_ += "{\"vertices\":[" + std::to_string(e.from) + "," + std::to_string(e.to) + "],\"faces\":";
    indices(e.faces);
    out_ += ",";
    pair(e.contact);
    out_ += "}";
  }
  void face(const SpatialFace& f) {
    out_ += "{\"kind\":\"" + kind_of(f) + "\",";
    pair(SolidContact{f.p, f.q});
    out_ += ",\"shell\":" + std::to_string(f.shell) + ",\"loops\":";
    loops(f.loops);
    out_ += "}";
  }
  void tight() {
    list("faces", sum_.tight_faces.size(), [this](std::size_t k) {
      out_ += "{\"loops\":";
      loops(sum_.tight_faces[k]);
      out_ += ",\"front\":{", pair(sum_.tight_face_contacts[k][0]);
      out_ += "},\"back\":{", pair(sum_.tight_face_contacts[k][1]);
      out_ += "}}";
    });
    list("segments", sum_.tight_segments.size(), [this](std::size_t k) {
      const auto& [from, to] = sum_.tight_segments[k];
      out_ += "{\"vertices\":[" + std::to_string(from) + "," + std::to_string(to) + "],\"contacts\":";
      contacts(sum_.tight_segment_contacts[k]);
      out_ += "}";
    });
    list("points", sum_.tight_points.size(), [this](std::size_t k) {
      out_ += "{\"vertex\":" + std::to_string(sum_.tight_points[k]) + ",\"contacts\":";
      contacts(sum_.tight_point_contacts[k]);
      out_ += "}";
    });
  }

  void contacts(const std::vector<SolidContact>& all) {
    out_ += "[";
    for (std::size_t k = 0; k < all.size(); ++k) {
      out_ += k == 0 ? "{" : ",{";
      pair(all[k]);
      out_ += "}";
    }
    out_ += "]";
  }
  /// What touches; null where nothing is named.
  void pair(const std::optional<SolidContact>& contact) {
    if (!contact) {
      out_ += "\"p\":null,\"q\":null";
      return;
    }
    out_ += "\"p\":";
    feature(contact->p);
    out_ += ",\"q\":";
    feature(contact->q);
  }
  void feature(const SolidFeature& f) {
    const std::string a = std::to_string(f.a);
    out_ += f.kind == Kind::vertex ? "{\"vertex\":" + a + "}"
            : f.kind == Kind::edge ? "{\"edge\":[" + a + "," + std::to_string(f.b) + "]}"
                                   : "{\"face\":" + a + "}";
  }
  void loops(const Loops& all) {
    out_ += "[";
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (k > 0) out_ += ",";
      indices(all[k]);
    }
    out_ += "]";
  }
  void indices(const std::vector<std::uint32_t>& all) {
    out_ += "[";
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (k > 0) out_ += ",";
      out_ += std::to_string(all[k]);
    }
    out_ += "]";
  }

  const SpatialSum& sum_;
  std::string out_;
};

}  // namespace

std::string solid_sum_to_json(const SpatialSum& sum) { return SolidSumWriter(sum).write(); }

}  // namespace dymsum
