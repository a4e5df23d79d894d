#include "cgal/nef_set.h"

// CGAL's short way for an edge that crosses a facet reads an unset face where no facet is at the edge, as between open
// sets.
#define CGAL_NEF3_OVERLAY_BY_HAND_OFF

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_nary_union_3.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_decomposition_3.h>
#include <CGAL/convex_hull_3.h>
#include <CGAL/minkowski_sum_3.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace dymsum::nef {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;
using Number = Kernel::FT;
using Position = Kernel::Point_3;

Number number_of(const Rational& value) {
  return Number(Number::ET(value.numerator())) / Number(Number::ET(value.denominator()));
}
Position position_of(const Place& p) { return {number_of(p[0]), number_of(p[1]), number_of(p[2])}; }

Rational rational_of(const Number& value) {
  std::ostringstream text;
  text << value.exact();
  return Rational::parse(text.str()).value();
}
Place place_of(const Position& p) { return {rational_of(p.x()), rational_of(p.y()), rational_of(p.z())}; }

Nef hull_of(const std::vector<Position>& positions) {
  CGAL::Surface_mesh<Position> surface;
  CGAL::convex_hull_3(positions.begin(), positions.end(), surface);
  return Nef(surface);
}

/// Where the loops of a facet go, one after the other; a vertex alone inside a facet is a loop by itself.
std::vector<std::vector<Position>> loops_of(Nef::Halffacet_const_handle facet) {
  std::vector<std::vector<Position>> loops;
  for (auto cycle = facet->facet_cycles_begin(); cycle != facet->facet_cycles_end(); ++cycle) {
    if (!cycle.is_shalfedge()) continue;
    std::vector<Position> loop;
    const Nef::SHalfedge_const_handle first(cycle);
    Nef::SHalfedge_around_facet_const_circulator at(first), end(at);
    CGAL_For_all(at, end) loop.push_back(at->source()->source()->point());
    loops.push_back(std::move(loop));
  }
  return loops;
}

Side side_of(const Place& a, const Place& b) { return a < b ? Side{a, b} : Side{b, a}; }

/// Changes nothing: to have the volumes built anew.
struct Nothing : CGAL::Modifier_base<Nef::SNC_structure> {
  void operator()(Nef::SNC_structure&) override {}
};

/// A bounded set with the volume outside in front, as minkowski_sum_3 and convex_decomposition_3 take for granted;
/// where walls between volumes go, as in a union, any of these may be.
Nef with_outside_first(Nef nef) {
  Nothing nothing;
  if (nef.volumes_begin()->mark()) nef.delegate(nothing, true, false);
  return nef;
}

struct VerticesOfShell {
  std::vector<Place> places;
  void visit(Nef::Vertex_const_handle v) { places.push_back(place_of(v->point())); }
  void visit(Nef::Halfedge_const_handle) {}
  void visit(Nef::Halffacet_const_handle) {}
  void visit(Nef::SHalfedge_const_handle) {}
  void visit(Nef::SHalfloop_const_handle) {}
  void visit(Nef::SFace_const_handle) {}
};

}  // namespace

struct NefSet::Polyhedron {
  Nef nef;
};

NefSet::NefSet() : NefSet(Polyhedron{Nef(Nef::EMPTY)}) {}
NefSet::NefSet(Polyhedron polyhedron) : polyhedron_(std::make_shared<const Polyhedron>(std::move(polyhedron))) {}

NefSet NefSet::hull(std::span<const Place> places) {
  std::vector<Position> positions;
  for (const Place& p : places) positions.push_back(position_of(p));
  return NefSet({hull_of(positions)});
}

NefSet NefSet::solid(const MeshData& mesh) {
  const auto at = [&](std::uint32_t v) { return Position(mesh.vertices[v].x, mesh.vertices[v].y, mesh.vertices[v].z); };
  Nef odd(Nef::EMPTY);
  for (const Face& f : mesh.faces)
    for (std::size_t k = 1; k + 1 < f.size(); ++k) {
      const std::vector<Position> corners{at(0), at(f[0]), at(f[k]), at(f[k + 1])};
      if (!CGAL::coplanar(corners[0], corners[1], corners[2], corners[3])) odd ^= hull_of(corners);
    }
  return NefSet({odd.regularization()});
}

NefSet NefSet::interior() const { return NefSet({polyhedron_->nef.interior()}); }
NefSet NefSet::closure() const { return NefSet({polyhedron_->nef.closure()}); }
NefSet NefSet::complement() const { return NefSet({polyhedron_->nef.complement()}); }
NefSet NefSet::regularized() const { return NefSet({polyhedron_->nef.regularization()}); }
NefSet NefSet::without(const NefSet& other) const { return NefSet({polyhedron_->nef - other.polyhedron_->nef}); }
NefSet NefSet::common_with(const NefSet& other) const { return NefSet({polyhedron_->nef * other.polyhedron_->nef}); }
NefSet united(const std::vector<NefSet>& sets) {
  CGAL::Nef_nary_union_3<Nef> all;
  for (const NefSet& set : sets) all.add_polyhedron(set.polyhedron_->nef);
  return NefSet({all.get_union()});
}
bool operator==(const NefSet& a, const NefSet& b) { return a.polyhedron_->nef == b.polyhedron_->nef; }

std::vector<std::vector<Place>> NefSet::convex_pieces() const {
  Nef parts = with_outside_first(polyhedron_->nef);
  CGAL::convex_decomposition_3(parts);
  std::vector<std::vector<Place>> pieces;
  for (auto volume = parts.volumes_begin(); volume != parts.volumes_end(); ++volume) {
    if (!volume->mark()) continue;
    VerticesOfShell corners;
    for (auto shell = volume->shells_begin(); shell != volume->shells_end(); ++shell)
      parts.visit_shell_objects(Nef::SFace_const_handle(shell), corners);
    pieces.push_back(std::move(corners.places));
  }
  return pieces;
}

NefSet cgal_sum(const NefSet& a, const NefSet& b) {
  Nef p = with_outside_first(a.polyhedron_->nef), q = with_outside_first(b.polyhedron_->nef);  // decomposed there
  return NefSet({CGAL::minkowski_sum_3(p, q)});
}

bool NefSet::empty() const { return polyhedron_->nef.is_empty(); }

Location NefSet::locate(const Place& at) const {
  const Nef::Object_handle found = polyhedron_->nef.locate(position_of(at));
  Nef::Vertex_const_handle vertex;
  Nef::Halfedge_const_handle edge;
  Nef::Halffacet_const_handle facet;
  Nef::Volume_const_handle volume;
  if (CGAL::assign(vertex, found)) return {vertex->mark(), 0};
  if (CGAL::assign(edge, found)) return {edge->mark(), 1};
  if (CGAL::assign(facet, found)) return {facet->mark(), 2};
  if (CGAL::assign(volume, found)) return {volume->mark(), 3};
  throw std::logic_error("a place in no cell");
}

Cells NefSet::cells() const {
  const Nef& nef = polyhedron_->nef;
  Cells cells;
  for (auto v = nef.vertices_begin(); v != nef.vertices_end(); ++v) cells.vertices.insert(place_of(v->point()));
  for (auto e = nef.halfedges_begin(); e != nef.halfedges_end(); ++e)
    if (!e->is_twin()) cells.edges.insert(side_of(place_of(e->source()->point()), place_of(e->target()->point())));
  for (auto f = nef.halffacets_begin(); f != nef.halffacets_end(); ++f) {
    if (f->is_twin()) continue;
    std::vector<Side> sides;
    for (const std::vector<Position>& loop : loops_of(f))
      for (std::size_t k = 0; k < loop.size(); ++k)
        sides.push_back(side_of(place_of(loop[k]), place_of(loop[(k + 1) % loop.size()])));
    std::sort(sides.begin(), sides.end());
    cells.facets.insert(std::move(sides));
  }
  return cells;
}

Rational NefSet::volume() const {
  const Nef& nef = polyhedron_->nef;
  Number six = 0;
  const auto from_origin = [](const Position& p) { return p - CGAL::ORIGIN; };
  for (auto f = nef.halffacets_begin(); f != nef.halffacets_end(); ++f) {
    if (f->incident_volume()->mark() || !f->twin()->incident_volume()->mark()) continue;
    for (const std::vector<Position>& loop : loops_of(f))
      for (std::size_t k = 1; k + 1 < loop.size(); ++k)
        six += CGAL::determinant(from_origin(loop[0]), from_origin(loop[k]), from_origin(loop[k + 1]));
  }
  return rational_of(six) / 6;
}

}  // namespace dymsum::nef
