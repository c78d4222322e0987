// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "planes/patches/patches.h"
#include "planes/scan/scale.h"
#include "planes/selection/select.h"
#include "unseen/planes/types.h"

namespace unseen::planes {

/// Warns of coordinates whose last digits were lost before they came here: rounded to single precision, or text with too few digits.
void warn_of_rounding(const Survey& survey, double scale, Context& context);

/// Warns of an estimated scale that is hardly one of metres.
void warn_of_units(const Survey& survey, const Space& space, double scale, Context& context);

/// Warns where an estimated scale leaves most of the points without a plane, or a given one many because they are farther apart.
void warn_of_few(PointSource& source, const Survey& seen, const Space& space, bool estimated, const Arrangement& result, Context& context);

/// Warns where most patches are strips of curved surfaces.
void warn_of_curves(const Patches& patches, const Space& space, Context& context);

/// Warns of planes that are related to others although their own points certainly say otherwise: two things in one, or pieces of something else.
void warn_of_turned(const Arrangement& result, Context& context);

/// Warns where planes are at right angles that the angles asked for do not name.
void warn_of_right_angles(const Arrangement& result, const AngleSet& angles, Context& context);

/// Says so if the tags find no floor or the like, or little but slopes: the scan may be turned.
void warn_of_up(const Arrangement& result, Context& context);

}  // namespace unseen::planes
