// Every record whose fields are listed, with what the npm package calls it.
#pragma once

#include <tuple>

#include "dymsum/fields.h"

namespace dymsum::names {

/// A record; `interface` is its name in index.d.ts, or null where it has none of its own.
template <class Record>
struct Listing {
  using Type = Record;
  const char* interface = nullptr;
};

inline constexpr std::tuple kRecords{
    // planar_fields.h
    Listing<Evidence>{}, Listing<Point>{"Point"}, Listing<RationalPoint>{"ExactPoint"}, Listing<Contact>{"Contact"},
    Listing<ConvolutionSizes>{"ConvolutionSizes"}, Listing<SumStats::Stage>{}, Listing<SumStats>{"SumStats"},
    Listing<Rounding>{"Rounding"}, Listing<FrameWork>{"FrameWork"}, Listing<EditWork>{"EditWork"},
    Listing<RingChange>{"RingChange"}, Listing<FrameChanges>{"FrameChanges"}, Listing<Lifetime>{},
    Listing<FamilyWork>{}, Listing<ScaleContact>{"ScaleContact"}, Listing<ScaleInterval>{"ScaleInterval"},
    Listing<ScaleRange>{"ScaleRange"}, Listing<PlanarFeature>{"PlanarFeature"}, Listing<PlanarTouch>{"PlanarTouch"},
    Listing<PlanarWay>{"PlanarWay"}, Listing<PlanarDistance>{"PlanarDistance"},
    // solid_fields.h
    Listing<Point3>{"Point3"}, Listing<RationalPoint3>{"ExactPoint3"}, Listing<SolidFeature>{"SolidFeature"},
    Listing<SolidContact>{"SolidContact"}, Listing<SpatialStats::Stage>{}, Listing<SpatialStats>{"SpatialStats"},
    Listing<SolidFrameWork>{"SolidFrameWork"}, Listing<SolidEditWork>{},
    Listing<SolidFrameChanges>{"SolidFrameChanges"}, Listing<MotionWork>{"MotionWork"},
    Listing<ConvexDepth>{"ConvexDepth"}, Listing<ConvexSum::FacetCount>{}, Listing<SolidTouch>{"SolidTouch"},
    Listing<SolidWay>{"SolidWay"}, Listing<SolidDistance::Work>{}, Listing<SolidDistance>{"SolidDistance"},
    Listing<SolidScaleContact>{"SolidScaleContact"}, Listing<SolidScaleInterval>{"SolidScaleInterval"},
    Listing<SolidScaleRange>{"SolidScaleRange"},
    // obstacle_fields.h
    Listing<Configuration>{"Configuration"}, Listing<ObstacleEvent>{"ObstacleEvent"},
    Listing<TightFeature>{"ObstacleTight"}, Listing<Patch>{"Patch"}, Listing<Shell>{"Shell"},
    Listing<ObstacleWork>{"ObstacleWork"}, Listing<Clearance>{"Clearance"}, Listing<FreeAngles>{"FreeAngles"},
    Listing<FreeComponent>{"FreeComponent"}, Listing<SearchLimit::Passage>{}, Listing<SearchLimit>{},
    Listing<NoPath>{"NoPath"}, Listing<PlanWork>{}, Listing<PathCheck>{"PathCheck"},
    // shape_fields.h; positions of cuts and pieces have another form in the package
    Listing<FeatureBar>{"FeatureBar"}, Listing<BridgeContact>{"BridgeContact"}, Listing<AlphaBridge>{"AlphaBridge"},
    Listing<Cut>{}, Listing<DiscEvent>{"DiscEvent"}, Listing<Measured>{"Measured"}, Listing<Piece>{},
    Listing<Decomposition>{}};

}  // namespace dymsum::names
