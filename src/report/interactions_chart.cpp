// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "report/interactions_structures.h"

namespace unseen::report {
namespace {

using namespace interactions;

/// Empty without likelihoods.
Json series_of(SceneBuilder& scene, const Person& person, int label, double fps) {
  std::vector<float> x, y;
  for (std::size_t i = 0; i < std::min(person.frames.size(), person.likelihood.size()); ++i) {
    const int frame = person.frames[i].frame;
    if (i > 0 && frame - person.frames[i - 1].frame > fps) {  // away for more than a second
      x.push_back(x.back());
      y.push_back(std::numeric_limits<float>::quiet_NaN());
    }
    x.push_back(static_cast<float>(frame / fps));
    y.push_back(static_cast<float>(person.likelihood[i]));
  }
  if (x.empty()) return {};
  return {{"name", name_of(person)}, {"color", label}, {"line", true}, {"x", scene.scalars(x)}, {"y", scene.scalars(y)}};
}

/// A window, and the objects that it proves.
Json span_of(const Reconstruction& r, std::size_t w) {
  const Window& window = r.windows[w];
  Json proves = Json::array();
  std::string name;
  for (std::size_t i = 0; i < r.objects.size(); ++i)
    if (std::count(r.objects[i].windows.begin(), r.objects[i].windows.end(), static_cast<int>(w)) > 0) {
      proves.push_back(i);
      name += fmt::format("{}{}", name.empty() ? "" : ", ", name_of(r.objects[i]));
    }
  const auto person = std::find_if(r.people.begin(), r.people.end(), [&](const Person& p) { return p.id == window.person; });
  Json span = {{"from", number(window.first / r.fps)},
               {"to", number((window.last + 1) / r.fps)},
               {"name", name.empty() ? "no object" : name},
               {"color", person_label(static_cast<std::size_t>(person - r.people.begin()))},
               {"weight", number(window.likelihood)}};
  if (!proves.empty()) span["elements"] = {{"structure", "objects"}, {"indices", std::move(proves)}};
  return span;
}

}  // namespace

void add_likelihood_chart(SceneBuilder& scene, const Reconstruction& r) {
  Json series = Json::array(), spans = Json::array();
  for (std::size_t p = 0; p < r.people.size(); ++p)
    if (Json one = series_of(scene, r.people[p], person_label(p), r.fps); !one.empty()) series.push_back(std::move(one));
  for (std::size_t w = 0; w < r.windows.size(); ++w) spans.push_back(span_of(r, w));
  if (series.empty()) return;
  scene.header["charts"].push_back({{"title", "Likelihood of an interaction"},
                                    {"x", {{"name", "time, s"}, {"unit", "s"}, {"seconds", 1}}},
                                    {"y", {{"name", "likelihood; bars: windows that a scenelet explains"}, {"unit", ""}, {"high", 1}}},
                                    {"series", std::move(series)},
                                    {"spans", std::move(spans)}});
}

}  // namespace unseen::report
