// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <span>

#include "interactions/ground/sight.h"
#include "unseen/interactions/types.h"

namespace unseen::interactions {

/// The share of an object's outline in the picture that masks of its superclass cover. Nothing if there is no such mask, or no outline:
/// the object is outside the picture, or partly behind the camera.
std::optional<double> share_in_masks(const Object& object, std::span<const Mask> masks, const View& view);

/// Makes objects surer whose outline masks of their superclass cover, and less sure those whose they do not: the odds that an object exists are
/// multiplied by exp(4 (share − 0.3)), so that a third of the outline, which people and other things may hide, says nothing.
void heed_masks(std::vector<FoundObject>& objects, std::span<const Mask> masks, const View& view);

}  // namespace unseen::interactions
