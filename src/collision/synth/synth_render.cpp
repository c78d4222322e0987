// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "collision/synth/synth_look.h"
#include "collision/synth/synth_motion.h"
#include "collision/synth/synth_plan.h"
#include "collision/synth/synth_sight.h"
#include "core/linear.h"
#include "unseen/collision/synth.h"

namespace unseen::collision {
namespace {

constexpr int kSamples = 16;        // a pixel: at different places in it and times of the exposure
constexpr double kShade = 0.45;     // of the light that a shadow takes
constexpr int kNoiseValues = 1 << 14;

/// A body as it moves while the shutter is open.
struct Exposure {
  std::vector<SynthSight> sights;  ///< one a sample
  SynthPatch patch;                ///< what they cover
  Vec3 center;                ///< half-way, world
  double reach = 0;
  SynthPatch shadow;
};

class Film {
 public:
  Film(const SynthShot& scene, const SynthOptions& options, Context& context)
      : scene_(scene), options_(options), context_(context), camera_(scene.truth.camera),
        backdrop_(make_backdrop(scene, static_cast<std::uint64_t>(options.seed), context)) {
    for (std::size_t i = 0; i < scene.truth.bodies.size(); ++i) {
      if (scene.truth.bodies[i].shape == Shape::fixed) continue;
      movers_.push_back({synth_body(scene.truth.bodies[i]), i == 0 ? 1.0 : scene.truth.mass_ratio.value_or(1.0), 0.0});
    }
    for (std::size_t i = 0; i < movers_.size(); ++i) paints_.emplace_back(movers_[i].body, static_cast<int>(i));
    hang_curtain();
    for (const Vec3& c : backdrop_.colors)
      for (int k = 0; k < 3; ++k) still_.push_back(static_cast<float>(encoded(c[k])));
    for (int k = 0; k < kSamples; ++k)
      offsets_[k] = {std::fmod(0.5 + 0.7548776662466927 * k, 1.0) - 0.5, std::fmod(0.5 + 0.5698402909980532 * k, 1.0) - 0.5};
    Random random(static_cast<std::uint64_t>(options.seed) * 13 + 3);
    for (int i = 0; i < kNoiseValues; ++i) noise_.push_back(static_cast<float>(options.noise * random.normal()));
  }

  void expose(std::size_t index, std::vector<std::uint8_t>& picture) const {
    std::vector<Exposure> exposures;
    for (std::size_t i = 0; i < movers_.size(); ++i) exposures.push_back(exposure_of(index, i));
    const auto width = static_cast<std::size_t>(camera_.width);
    picture.resize(still_.size());
    parallel_blocks(context_, static_cast<std::size_t>(camera_.height), 16, [&](std::size_t begin, std::size_t end) {
      std::vector<float> row(3 * width);
      for (std::size_t v = begin; v < end; ++v) {
        std::copy_n(still_.begin() + static_cast<std::ptrdiff_t>(3 * width * v), 3 * width, row.begin());
        for (int u = 0; u < camera_.width; ++u) paint(u, static_cast<int>(v), exposures, &row[3 * static_cast<std::size_t>(u)]);
        sense(index, v, row, &picture[3 * width * v]);
      }
    });
  }

 private:
  /// The first impact is behind it.
  void hang_curtain() {
    if (!options_.curtain || scene_.truth.impacts.empty()) return;
    const Vec3 p = scene_.truth.T_world_camera.inverse() * scene_.truth.impacts.front().contact_point;
    const auto [left, right] = curtain_columns(movers_, p, camera_);
    curtain_ = {left, 0, right, camera_.height};
    for (int v = 0; v < camera_.height; ++v)
      for (int u = curtain_.left; u < curtain_.right; ++u)
        backdrop_.colors[static_cast<std::size_t>(v) * camera_.width + u] = (0.5 + 0.2 * std::sin(0.15 * u)) * Vec3(0.25, 0.3, 0.22);
  }

  /// The body's state at a time within half a frame of a frame: flown from the nearest frame that no impact lies between.
  SynthPose pose_at(std::size_t index, std::size_t body, double time) const {
    const auto& frames = scene_.truth.frames;
    std::size_t best = index;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = index > 0 ? index - 1 : 0; i <= std::min(index + 1, frames.size() - 1); ++i) {
      const double from = std::min(time, frames[i].time), to = std::max(time, frames[i].time);
      const bool broken = std::any_of(scene_.truth.impacts.begin(), scene_.truth.impacts.end(),
                                      [&](const Impact& impact) { return impact.time > from && impact.time < to; });
      if (broken || to - from >= nearest) continue;
      nearest = to - from;
      best = i;
    }
    const BodyState& s = *frames[best].bodies[body];
    const SynthMover& mover = movers_[body];
    const Vec3 w = solve_symmetric<3>(mover.mass * mover.body.inertia, s.q.conjugate() * s.k);
    return fly(mover, {s.p, s.v, s.q, w}, Vec3(0, 0, -scene_.shot.gravity), time - frames[best].time).pose();
  }

  Exposure exposure_of(std::size_t index, std::size_t body) const {
    const RigidTransform T = scene_.truth.T_world_camera.inverse();
    const FramePose& frame = scene_.truth.frames[index];
    const SynthBody& shape = movers_[body].body;
    Exposure e;
    e.center = frame.bodies[body]->p;
    e.reach = shape.reach;
    for (int k = 0; k < kSamples; ++k) {
      const double shift = ((k + 0.5) / kSamples - 0.5) * options_.exposure / scene_.truth.fps;
      const SynthPose pose = pose_at(index, body, frame.time + shift);
      const Vec3 p = T * pose.p;
      if (p.z() < 1.2 * shape.reach) return {};
      e.sights.emplace_back(shape, paints_[body], pose, scene_.truth.T_world_camera.rotation);
      const SynthPatch patch = patch_around(camera_.project(p), 1.3 * camera_.fx * shape.reach / (p.z() - shape.reach) + 1, camera_);
      e.patch = k == 0 ? patch : united(e.patch, patch);
    }
    if (options_.shadow) e.shadow = shadow_patch(e, T);
    return e;
  }

  /// Where the shadow can fall, on wall and floor.
  SynthPatch shadow_patch(const Exposure& e, const RigidTransform& T_camera_world) const {
    const Vec3 lamp = to_lamp();
    SynthPatch patch;
    bool any = false;
    const auto add = [&](double distance) {
      const Vec3 p = T_camera_world * Vec3(e.center - distance * lamp);
      if (distance < 0 || p.z() < 0.1) return;
      const SynthPatch here = patch_around(camera_.project(p), 4 * camera_.fx * e.reach / p.z(), camera_);
      patch = any ? united(patch, here) : here;
      any = true;
    };
    add((e.center.y() - backdrop_.wall) / lamp.y());
    if (backdrop_.floor) add((e.center.z() - *backdrop_.floor) / lamp.z());
    return patch;
  }

  /// Share of the lamp's light at a place: less near the line from a body away from the lamp.
  double light_at(const Vec3& place, int u, int v, const std::vector<Exposure>& exposures) const {
    double light = 1;
    for (const Exposure& e : exposures) {
      if (!e.shadow.holds(u, v)) continue;
      const Vec3 from = place - e.center;
      const double along = from.dot(to_lamp());
      if (along > 0) continue;
      const double t = std::clamp((std::sqrt(std::max(0.0, from.squaredNorm() - along * along)) / e.reach - 0.4) / 1.0, 0.0, 1.0);
      light *= 1 - kShade * (1 - t * t * (3 - 2 * t));
    }
    return light;
  }

  void paint(int u, int v, const std::vector<Exposure>& exposures, float* pixel) const {
    bool near = false, shaded = false;
    for (const Exposure& e : exposures) {
      near = near || e.patch.holds(u, v);
      shaded = shaded || e.shadow.holds(u, v);
    }
    if ((!near && !shaded) || curtain_.holds(u, v)) return;
    const std::size_t at = static_cast<std::size_t>(v) * camera_.width + u;
    const double light = light_at(backdrop_.places[at], u, v, exposures);
    Vec3 sum = Vec3::Zero();
    int hits = 0;
    for (int k = 0; near && k < kSamples; ++k) {
      const Vec3 ray = camera_.unproject(u + offsets_[k].x(), v + offsets_[k].y(), 1.0);
      double nearest = std::numeric_limits<double>::infinity();
      const SynthSight* seen = nullptr;
      int face = 0;
      for (const Exposure& e : exposures) {
        int entered = 0;
        const double distance = e.patch.holds(u, v) ? e.sights[static_cast<std::size_t>(k)].hit(ray, entered) : nearest;
        if (distance >= nearest) continue;
        nearest = distance;
        seen = &e.sights[static_cast<std::size_t>(k)];
        face = entered;
      }
      if (seen == nullptr) continue;
      sum += seen->color(ray, nearest, face);
      ++hits;
    }
    if (hits == 0 && light == 1) return;
    sum += (kSamples - hits) * light * backdrop_.colors[at];
    for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(encoded(sum[c] / kSamples));
  }

  /// Noise and rounding of one row.
  void sense(std::size_t index, std::size_t v, const std::vector<float>& row, std::uint8_t* out) const {
    std::uint64_t state = (static_cast<std::uint64_t>(options_.seed) << 40) ^ (index << 20) ^ v;
    for (std::size_t u = 0; u < row.size(); u += 3) {
      state += 0x9E3779B97F4A7C15ULL;  // splitmix64
      std::uint64_t h = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9ULL;
      h = (h ^ (h >> 27)) * 0x94D049BB133111EBULL;
      h ^= h >> 31;
      for (int c = 0; c < 3; ++c) {
        const float value = row[u + c] + noise_[(h >> (20 * c)) & (kNoiseValues - 1)] + 0.5f;
        out[u + c] = static_cast<std::uint8_t>(std::clamp(value, 0.0f, 255.0f));
      }
    }
  }

  const SynthShot& scene_;
  const SynthOptions& options_;
  Context& context_;
  Camera camera_;
  Backdrop backdrop_;
  std::vector<SynthMover> movers_;
  std::vector<Paint> paints_;
  SynthPatch curtain_;
  std::array<Vec2, kSamples> offsets_;  ///< in the pixel: low-discrepancy points (Roberts' R2 sequence)
  std::vector<float> still_;  ///< levels of the picture without bodies
  std::vector<float> noise_;
};

}  // namespace

void render(const SynthShot& scene, const SynthOptions& options, Context& context,
            const std::function<void(int frame, const std::vector<std::uint8_t>& bgr)>& film) {
  const Film camera(scene, options, context);
  std::vector<std::uint8_t> picture;
  const std::size_t count = scene.truth.frames.size();
  for (std::size_t i = 0; i < count; ++i) {
    context.progress(static_cast<double>(i) / static_cast<double>(count));
    camera.expose(i, picture);
    film(scene.truth.frames[i].frame, picture);
  }
}

}  // namespace unseen::collision
