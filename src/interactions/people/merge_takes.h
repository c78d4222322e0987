// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/interactions/types.h"

namespace unseen::interactions {

/// Several takes of one room from one camera as one: frames and persons of later takes are numbered on.
/// Who is who is told take by take; every detection has its person. Throws InputError if cameras or frame rates differ, or a take has no detection.
Take merge_takes(const std::vector<Take>& takes);

}  // namespace unseen::interactions
