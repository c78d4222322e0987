// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/scenelets_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "report/json_write.h"
#include "unseen/core/quantile.h"

namespace unseen::report {
namespace {

using namespace interactions;

struct Info {
  std::vector<std::size_t> of_recording;
  std::map<std::string, std::size_t> with_category;      ///< scenelets that have one
  std::map<std::string, std::vector<double>> by_action;  ///< H of each, ascending
};

Info info_of(const Database& database) {
  Info info;
  info.of_recording.resize(database.recordings.size());
  for (const Scenelet& s : database.scenelets) {
    ++info.of_recording[static_cast<std::size_t>(s.recording)];
    info.by_action[kActions[static_cast<int>(s.actions[static_cast<std::size_t>(s.middle)])]].push_back(s.highest_saliency);
    for (std::size_t c = 0; c < kCategories.size(); ++c)
      if (std::any_of(s.objects.begin(), s.objects.end(), [&](const Object& o) { return category_index(o.category) == static_cast<int>(c); })) ++info.with_category[kCategories[c]];
  }
  for (auto& [action, saliency] : info.by_action) std::sort(saliency.begin(), saliency.end());
  return info;
}

constexpr std::array kQuantiles = {0.0, 0.1, 0.5, 0.9, 1.0};

}  // namespace

std::string database_info_json(const Database& database) {
  const Info info = info_of(database);
  Json json;
  json["scenelets"] = database.scenelets.size();
  json["recordings"] = list_of(database.recordings, [&](const Source& s, std::size_t i) {
    return Json{{"name", s.name}, {"room", s.room}, {"licence", s.licence}, {"scenelets", info.of_recording[i]}};
  });
  json["categories"] = Json::object();
  for (const auto& [category, count] : info.with_category) json["categories"][category] = count;
  json["actions"] = Json::object();
  for (const auto& [action, saliency] : info.by_action) {
    Json quantiles = Json::array();
    for (const double q : kQuantiles) quantiles.push_back(number(quantile(saliency, q)));
    json["actions"][action] = Json{{"scenelets", saliency.size()}, {"saliency", quantiles}};
  }
  return text_of(json);
}

std::string database_info_table(const Database& database) {
  const Info info = info_of(database);
  std::string text = fmt::format("{} scenelets of {} recordings\n", database.scenelets.size(), database.recordings.size());
  std::map<std::pair<std::string, std::string>, std::pair<std::size_t, std::size_t>> by_room;  // room and licence: recordings, scenelets
  for (std::size_t i = 0; i < database.recordings.size(); ++i) {
    auto& [recordings, scenelets] = by_room[{database.recordings[i].room, database.recordings[i].licence}];
    ++recordings;
    scenelets += info.of_recording[i];
  }
  constexpr std::size_t kMostRooms = 20;
  std::size_t shown = 0;
  for (const auto& [room, counts] : by_room)
    if (++shown <= kMostRooms) text += fmt::format("  {:<28} {:>4} recordings {:>6} scenelets   licence {}\n", room.first, counts.first, counts.second, room.second.empty() ? "unknown" : room.second);
  if (by_room.size() > kMostRooms) text += fmt::format("  and {} rooms more\n", by_room.size() - kMostRooms);
  text += "scenelets with a\n";
  for (const auto& [category, count] : info.with_category) text += fmt::format("  {:<28} {:>6}\n", category, count);
  text += fmt::format("{:<30} {:>6}   saliency {:>4} {:>5} {:>5} {:>5} {:>5}\n", "action", "", "least", "10 %", "50 %", "90 %", "most");
  for (const auto& [action, saliency] : info.by_action) {
    text += fmt::format("  {:<28} {:>6}           ", action, saliency.size());
    for (const double q : kQuantiles) text += fmt::format(" {:5.2f}", quantile(saliency, q));
    text += '\n';
  }
  return text;
}

}  // namespace unseen::report
