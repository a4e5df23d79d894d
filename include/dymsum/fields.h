// The fields of records, each listed once: from these lists Python, JavaScript and reports have theirs. All of them, as
// a record may not be listed in one file of a program and unlisted in another.
#pragma once

#include "dymsum/obstacle_fields.h"
#include "dymsum/planar_fields.h"
#include "dymsum/shape_fields.h"
#include "dymsum/solid_fields.h"
