#include "names/enumerations.h"

#include "dymsum/continuous_depth.h"
#include "dymsum/convex_solid.h"
#include "dymsum/convex_sum.h"
#include "dymsum/decomposition.h"
#include "dymsum/edit_script.h"
#include "dymsum/editable_solid_sum.h"
#include "dymsum/editable_sum.h"
#include "dymsum/family.h"
#include "dymsum/fill.h"
#include "dymsum/growing_disc.h"
#include "dymsum/layout_check.h"
#include "dymsum/local_sum.h"
#include "dymsum/mesh_io.h"
#include "dymsum/named_repairs.h"
#include "dymsum/names.h"
#include "dymsum/nfp_table.h"
#include "dymsum/placement.h"
#include "dymsum/planar_local_sum.h"
#include "dymsum/planner.h"
#include "dymsum/region_io.h"
#include "dymsum/rotating_sum.h"
#include "dymsum/scale_range.h"
#include "dymsum/scaling_sum.h"
#include "dymsum/set_check.h"
#include "dymsum/solid_erosion.h"
#include "dymsum/solid_family.h"
#include "dymsum/solid_offset.h"
#include "dymsum/spatial_trace.h"
#include "dymsum/uncertain_answers.h"

namespace dymsum::names {
namespace {

template <class E>
Enumerators of(const char* name) {
  return {name, {names_of<E>().begin(), names_of<E>().end()}};
}

}  // namespace

std::vector<Enumerators> enumerations() {
  return {of<BetweenSteps>("BetweenSteps"),
          of<CandidatePosition::Kind>("Kind"),
          of<CheckVerdict>("CheckVerdict"),
          of<Concavity>("Concavity"),
          of<Contact::Kind>("Kind"),
          of<ConvexEngine>("ConvexEngine"),
          of<Cut::End>("End"),
          of<CurveBound>("CurveBound"),
          of<DepthEngine>("DepthEngine"),
          of<DiscBound>("DiscBound"),
          of<DiscCorner::Kind>("Kind"),
          of<DiscPiece::Of>("Of"),
          of<DiscSide>("DiscSide"),
          of<Discontinuity>("Discontinuity"),
          of<Engine>("Engine"),
          of<ErrorCode>("ErrorCode"),
          of<EditKind>("EditKind"),
          of<EventChange>("EventChange"),
          of<EventKind>("EventKind"),
          of<FacetChange::Kind>("Kind"),
          of<FamilyFeature>("FamilyFeature"),
          of<FeatureBar::Birth>("Birth"),
          of<FeatureBar::Death>("Death"),
          of<Fill>("Fill"),
          of<FrameMode>("FrameMode"),
          of<Holds>("Holds"),
          of<LayoutFault::Kind>("Kind"),
          of<LayoutFormat>("LayoutFormat"),
          of<LocalEngine>("LocalEngine"),
          of<LocalPart::Where>("Where"),
          of<Meeting>("Meeting"),
          of<MeshFormat>("MeshFormat"),
          of<MeshRepairKind>("MeshRepairKind"),
          of<MotionCheck::Outcome>("Outcome"),
          of<MovingOperand>("MovingOperand"),
          of<NestedShells>("NestedShells"),
          of<NoPath::Kind>("Kind"),
          of<ObstacleEvent::Kind>("Kind"),
          of<OffsetBound>("OffsetBound"),
          of<PlanarFeature::Kind>("Kind"),
          of<PlanarLocalPart::Where>("Where"),
          of<Precision>("Precision"),
          of<RegionFormat>("RegionFormat"),
          of<RegionRepairKind>("RegionRepairKind"),
          of<RingChange::Kind>("Kind"),
          of<ScaleContact::Kind>("Kind"),
          of<ScriptAction>("ScriptAction"),
          of<Semantics>("Semantics"),
          of<SolidEditKind>("SolidEditKind"),
          of<SolidFamilyFeature>("SolidFamilyFeature"),
          of<SolidFeature::Kind>("Kind"),
          of<SpatialEngine>("SpatialEngine"),
          of<SpatialTrace::Facet::Kind>("Kind"),
          of<StepKind>("StepKind"),
          of<TableAnswer::Rounding>("Rounding"),
          of<TableAnswer::Status>("Status"),
          of<TableRow::Kind>("Kind"),
          of<ThirdCoordinates>("ThirdCoordinates"),
          of<Touching>("Touching"),
          of<TurnDirection>("TurnDirection"),
          of<Waypoint::Move>("Move")};
}

}  // namespace dymsum::names
