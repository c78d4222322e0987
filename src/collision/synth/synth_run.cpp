// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "collision/synth/synth_plan.h"

namespace unseen::collision {
namespace {

constexpr double kTimeStep = 1e-3;          // s, between looks at contacts
constexpr double kRounding = 1e-8;      // m, of overlap that is rounding
constexpr double kLeastBounce = 0.5;    // m/s: a bounce below ends the shot, for the body comes to rest
constexpr int kFloor = -1;

/// A contact among the movers, or of one with the floor.
struct Meeting {
  double gap = 0;
  int a = 0, b = kFloor;
};

class Run {
 public:
  Run(const SynthPlan& plan, const SynthOptions& options) : plan_(plan), options_(options), fps_(options.fps) {}

  bool back(Truth& truth) {
    states_ = plan_.states;
    time_ = plan_.time;
    for (int frame = static_cast<int>(std::ceil(plan_.time * fps_)) - 1; frame >= 0; --frame) {
      while (time_ > frame / fps_) {
        const double dt = std::max(-kTimeStep, frame / fps_ - time_);
        states_ = flown(dt);
        time_ = dt == -kTimeStep ? time_ - kTimeStep : frame / fps_;
        if (nearest(states_).gap < -kRounding) return false;
      }
      record(frame, truth);
    }
    std::reverse(truth.frames.begin(), truth.frames.end());
    return true;
  }

  /// False if bodies overlap that cannot bounce here.
  bool forth(Truth& truth) {
    states_ = plan_.states;
    time_ = plan_.time;
    if (plan_.hit && !first_impact(truth)) return false;
    for (int frame = static_cast<int>(std::ceil(plan_.time * fps_)); frame < plan_.frames; ++frame) {
      while (time_ < frame / fps_) {
        if (!step(frame / fps_, truth)) return false;
        if (ended_) return true;
      }
      record(frame, truth);
    }
    return true;
  }

 private:
  std::vector<SynthState> flown(double dt) const {
    std::vector<SynthState> all;
    for (std::size_t i = 0; i < states_.size(); ++i) all.push_back(fly(plan_.movers[i], states_[i], plan_.gravity, dt));
    return all;
  }

  Meeting nearest(const std::vector<SynthState>& at) const {
    Meeting first{1e9, 0, kFloor};
    const auto& m = plan_.movers;
    if (m.size() == 2) first = {separation(m[0].body, at[0].pose(), m[1].body, at[1].pose()), 0, 1};
    for (std::size_t i = 0; plan_.floor && i < m.size(); ++i) {
      const double gap = separation(m[i].body, at[i].pose(), *plan_.floor);
      if (gap < first.gap) first = {gap, static_cast<int>(i), kFloor};
    }
    return first;
  }

  /// To the frame's time, or one step towards it, or to the contact before and through it.
  bool step(double until, Truth& truth) {
    const double dt = std::min(kTimeStep, until - time_);
    const std::vector<SynthState> next = flown(dt);
    const Meeting meeting = nearest(next);
    if (meeting.gap >= -kRounding) {
      states_ = next;
      time_ = dt < kTimeStep ? until : time_ + dt;
      return true;
    }
    ended_ = plan_.once && !truth.impacts.empty();
    if (ended_) return true;
    if (meeting.b != kFloor && !(plan_.movers[0].body.sphere() && plan_.movers[1].body.sphere())) return false;
    double low = 0, high = dt;
    for (int i = 0; i < 45; ++i) {
      const double middle = 0.5 * (low + high);
      (nearest(flown(middle)).gap < 0 ? high : low) = middle;
    }
    states_ = flown(low);
    time_ += low;
    return bounce(meeting, truth);
  }

  bool bounce(const Meeting& meeting, Truth& truth) {
    SynthHit hit;
    const auto a = static_cast<std::size_t>(meeting.a);
    if (meeting.b == kFloor) {
      hit.normal = plan_.floor->normal;
      separation(plan_.movers[a].body, states_[a].pose(), *plan_.floor, &hit.point);
      if (!collide(plan_.movers[a], states_[a], nullptr, nullptr, plan_.floor_restitution, options_.friction, hit)) return false;
      if (plan_.movers.size() == 1) note(hit, plan_.floor_restitution, truth);
    } else {
      hit.normal = (states_[0].p - states_[1].p).normalized();
      hit.point = states_[1].p + plan_.movers[1].body.radius * hit.normal;
      if (!collide(plan_.movers[0], states_[0], &plan_.movers[1], &states_[1], plan_.restitution, options_.friction, hit)) return false;
      note(hit, plan_.restitution, truth);
    }
    ended_ = hit.approach * plan_.restitution < kLeastBounce;
    return true;
  }

  bool first_impact(Truth& truth) {
    SynthHit hit = *plan_.hit;
    const bool pair = plan_.movers.size() == 2;
    if (!collide(plan_.movers[0], states_[0], pair ? &plan_.movers[1] : nullptr, pair ? &states_[1] : nullptr, plan_.restitution,
                 options_.friction, hit))
      return false;
    double spin = 0;
    for (const SynthState& s : states_) spin = std::max(spin, s.w.norm());
    if (hit.approach < plan_.least_approach || spin < plan_.least_spin || spin > plan_.most_spin) return false;
    note(hit, plan_.restitution, truth);
    return true;
  }

  void note(const SynthHit& hit, double restitution, Truth& truth) const {
    Impact impact;
    impact.time = time_;
    impact.frame = time_ * fps_;
    impact.restitution.value = restitution;
    impact.tangential_restitution = hit.tangential;
    const double normal = hit.impulse.dot(hit.normal);
    impact.friction = (hit.impulse - normal * hit.normal).norm() / normal;
    impact.impulse = hit.impulse;
    impact.contact_point = hit.point;
    impact.normal = hit.normal;
    truth.impacts.push_back(impact);
  }

  void record(int frame, Truth& truth) const {
    FramePose pose;
    pose.frame = frame;
    pose.time = frame / fps_;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const SynthState& s = states_[i];
      pose.bodies[i] = BodyState{s.p, s.v, plan_.movers[i].momentum(s), s.q};
    }
    truth.frames.push_back(pose);
  }

  const SynthPlan& plan_;
  const SynthOptions& options_;
  double fps_;
  std::vector<SynthState> states_;
  double time_ = 0;
  bool ended_ = false;
};

}  // namespace

bool carry_out(const SynthPlan& plan, const SynthOptions& options, Truth& truth) {
  truth.frames.clear();
  truth.impacts.clear();
  Run run(plan, options);
  return run.back(truth) && run.forth(truth) && truth.impacts.size() >= plan.least_impacts &&
         truth.frames.back().time >= plan.time + plan.least_after;
}

}  // namespace unseen::collision
