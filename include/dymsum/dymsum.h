// Everything.
#pragma once

#include "dymsum/mesh.h"
#include "dymsum/mesh_io.h"
#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/region_io.h"
#include "dymsum/result.h"
#include "dymsum/scale.h"
#include "dymsum/scale_range.h"
#include "dymsum/scaling_sum.h"
#include "dymsum/shapes.h"
#include "dymsum/solids.h"
#include "dymsum/trace.h"
