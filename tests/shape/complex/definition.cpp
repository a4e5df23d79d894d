#include "shape/complex/definition.h"

#include <algorithm>
#include <sstream>

#include "exact/root_expression.h"

namespace dymsum::testing {
namespace {

using exact::RootExpression;
using shape::Complex;
using shape::ExactDisc;
using shape::kNoIndex;
using shape::Site;

using Number = RootExpression;

/// The sign of (distance of the closed site from the disc's centre) - radius.
int reach(const Site& s, const ExactDisc& d) {
  const Number ax(s.a.x), ay(s.a.y), x = d.centre.x - ax, y = d.centre.y - ay;
  const auto from_point = [&](const Number& px, const Number& py) {
    return sign_of(px * px + py * py - d.radius * d.radius);
  };
  if (s.kind == Site::Kind::vertex) return from_point(x, y);
  const Number ex = Number(s.b.x) - ax, ey = Number(s.b.y) - ay, e2 = ex * ex + ey * ey;
  const Number along = x * ex + y * ey;
  if (sign_of(along) <= 0) return from_point(x, y);
  if (sign_of(along - e2) >= 0) return from_point(x - ex, y - ey);
  const Number across = x * ey - y * ex;
  return sign_of(across * across - d.radius * d.radius * e2);
}

std::string node_errors(const Complex& c, std::uint32_t n) {
  std::ostringstream out;
  const ExactDisc d = exact_disc(c, n);
  if (n > 0 && c.nodes[n - 1].rank > c.nodes[n].rank) out << "rank of node " << n << "\n";
  if (n > 0) {
    const int sign = exact::compare(exact_radius(c, n - 1), d.radius);
    if (sign != (c.nodes[n - 1].rank < c.nodes[n].rank ? -1 : 0)) out << "order of node " << n << "\n";
  }
  if (c.nodes[n].kind == shape::Node::Kind::corner) return out.str();
  for (std::uint32_t s = 0; s < c.sites.size(); ++s) {
    if (reach(c.sites[s], d) < 0)
      out << "site " << s << " reaches into node " << n << " at " << c.nodes[n].centre.x << " " << c.nodes[n].centre.y
          << " r " << c.nodes[n].radius << "\n";
  }
  for (const shape::Contact& contact : contacts_of(c, n)) {
    if (reach(c.sites[contact.site], d) != 0) out << "node " << n << " misses site " << contact.site << "\n";
  }
  return out.str();
}

std::string edge_errors(const Complex& c) {
  std::ostringstream out;
  std::vector<int> ends(c.edges.size(), 0);
  for (std::uint32_t n = 0; n < c.nodes.size(); ++n) {
    const auto count = c.first_spoke[n + 1] - c.first_spoke[n];
    using Kind = shape::Node::Kind;
    const Kind kind = c.nodes[n].kind;
    const bool fits = kind == Kind::corner ? count == 1 : kind == Kind::joint ? count >= 3 : count == 2;
    if (!fits) out << "node " << n << " has " << count << " spokes\n";
    for (auto s = c.first_spoke[n]; s < c.first_spoke[n + 1]; ++s) {
      const shape::Edge& e = c.edges[c.spokes[s].edge];
      ++ends[c.spokes[s].edge];
      if ((c.spokes[s].up ? e.low : e.high) != n) out << "spoke of node " << n << "\n";
    }
  }
  for (std::uint32_t i = 0; i < c.edges.size(); ++i) {
    const shape::Edge& e = c.edges[i];
    if (ends[i] != (e.high == kNoIndex ? 1 : 2)) out << "edge " << i << " has " << ends[i] << " spokes\n";
    if (e.high == kNoIndex) continue;
    const bool ascends = c.nodes[e.low].rank < c.nodes[e.high].rank;
    if (ascends == e.flat) out << "edge " << i << (e.flat ? " is not flat\n" : " does not ascend\n");
  }
  return out.str();
}

}  // namespace

std::string check_complex(const Complex& c) {
  std::string out;
  for (std::uint32_t n = 0; n < c.nodes.size() && out.size() < 2000; ++n) out += node_errors(c, n);
  return out + edge_errors(c);
}

std::string summary(const Complex& c) {
  const auto name = [&](std::uint32_t n) {
    std::ostringstream out;
    if (n == kNoIndex) return std::string("-");
    const shape::Node& node = c.nodes[n];
    out << static_cast<int>(node.kind) << "/" << node.rank << "/" << node.centre.x + 0.0 << "/" << node.centre.y + 0.0
        << "/" << node.radius;
    return out.str();
  };
  std::vector<std::string> lines;
  for (const shape::Edge& e : c.edges) {
    std::ostringstream out;
    out << name(e.low) << " " << name(e.high) << " " << e.left << " " << e.right << " " << e.flat << "\n";
    lines.push_back(out.str());
  }
  std::sort(lines.begin(), lines.end());
  std::string text = std::to_string(c.nodes.size()) + " nodes\n";
  for (const std::string& line : lines) text += line;
  return text;
}

}  // namespace dymsum::testing
