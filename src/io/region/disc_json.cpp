// A set with arcs as JSON text: pieces by what they come from; written, never read.
#include <string>

#include "dymsum/growing_disc.h"
#include "io/source.h"

namespace dymsum {

namespace {

class DiscSetWriter {
 public:
  explicit DiscSetWriter(const DiscSet& set) : set_(set) {}

  std::string write() {
    out_ = "{\n\"radius\":";
    number(set_.radius);
    out_ += ",\"radius_exact\":\"" + set_.radius_exact + "\",\"at_error\":";
    number(set_.at_error);
    out_ += ",\n\"parts\":[";
    list(set_.parts, [this](const DiscPart& part) {
      out_ += "\n{\"outer\":";
      ring(part.outer);
      out_ += ",\n\"holes\":[";
      list(part.holes, [this](const DiscRing& hole) { ring(hole); });
      out_ += "]}";
    });
    out_ += "],\n\"segments\":";
    segments(set_.segments);
    out_ += ",\n\"points\":";
    corners(set_.points);
    out_ += ",\n\"tight_segments\":";
    segments(set_.tight_segments);
    out_ += ",\n\"tight_points\":";
    corners(set_.tight_points);
    return out_ + "\n}\n";
  }

 private:
  template <class List, class Write>
  void list(const List& items, Write write) {
    bool first = true;
    for (const auto& item : items) {
      if (!first) out_ += ',';
      first = false;
      write(item);
    }
  }

  void number(double value) { io::append_number(out_, value); }

  void point(const char* name, Point p) {
    out_ += std::string("\"") + name + "\":[";
    number(p.x);
    out_ += ',';
    number(p.y);
    out_ += ']';
  }

  void disc(const CornerDisc& d) {
    out_ += std::string("{\"") + (d.at_node ? "node" : "edge") + "\":" + std::to_string(d.index) + "}";
  }

  void corner(const DiscCorner& c) {
    out_ += '{';
    if (c.kind == DiscCorner::Kind::none) {
      out_ += "\"kind\":\"none\"}";
      return;
    }
    point("at", c.at);
    switch (c.kind) {
      case DiscCorner::Kind::vertex:
        out_ += ",\"kind\":\"vertex\",\"vertex\":" + std::to_string(c.vertex);
        break;
      case DiscCorner::Kind::centre:
        out_ += ",\"kind\":\"centre\",\"disc\":";
        disc(c.disc);
        break;
      case DiscCorner::Kind::contact:
        out_ += ",\"kind\":\"contact\",\"disc\":";
        disc(c.disc);
        break;
      default:
        out_ += ",\"kind\":\"crossing\",\"discs\":[";
        disc(c.disc);
        out_ += ',';
        disc(c.other);
        out_ += ']';
    }
    out_ += '}';
  }

  void ring(const DiscRing& r) {
    out_ += "{\"pieces\":[";
    list(r.pieces, [this](const DiscPiece& p) { piece(p); });
    out_ += "]}";
  }

  void piece(const DiscPiece& p) {
    out_ += "\n{\"of\":";
    if (p.of == DiscPiece::Of::disc) {
      disc(p.disc);
    } else {
      out_ += std::string("{\"") + (p.of == DiscPiece::Of::edge ? "region_edge" : "region_vertex") +
              "\":" + std::to_string(p.index) + "}";
    }
    out_ += ",\"from\":";
    corner(p.from);
    if (p.of != DiscPiece::Of::edge) {
      out_ += ",\"arc\":{";
      point("centre", p.centre);
      out_ += ",\"from_angle\":";
      number(p.from_angle);
      out_ += ",\"sweep\":";
      number(p.sweep);
      out_ += '}';
    }
    out_ += '}';
  }

  void corners(const std::vector<DiscCorner>& items) {
    out_ += '[';
    list(items, [this](const DiscCorner& c) { corner(c); });
    out_ += ']';
  }

  void segments(const std::vector<DiscSegment>& items) {
    out_ += '[';
    list(items, [this](const DiscSegment& s) {
      out_ += "\n{\"from\":";
      corner(s.from);
      out_ += ",\"to\":";
      corner(s.to);
      out_ += '}';
    });
    out_ += ']';
  }

  const DiscSet& set_;
  std::string out_;
};

}  // namespace

std::string disc_set_to_json(const DiscSet& set) { return DiscSetWriter(set).write(); }

}  // namespace dymsum
