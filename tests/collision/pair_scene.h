// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/collision/types.h"

namespace unseen::collision::test {

constexpr double kFps = 120.0, kFocal = 1000.0;

inline ShotCamera camera() {
  ShotCamera c;
  c.camera = {kFocal, kFocal, 640, 360, 1280, 720};
  return c;
}

inline Body ball(const std::string& name, double radius) {
  Body b;
  b.name = name;
  b.radius = radius;
  return b;
}

inline Shot pair_shot(double ra, double rb) {
  Shot shot;
  shot.name = "shot";
  shot.bodies = {ball("a", ra), ball("b", rb)};
  return shot;
}

}  // namespace unseen::collision::test
