#include "harness/scene_file_versions.h"

#include "base/error.h"
#include "harness/json_place.h"
#include "harness/scene_file.h"

namespace tendril {
namespace {

/// Version 0: {"length", "section"}; since then {"length", "parts": [{"upto", "section"}]}.
void sections_to_parts(Json& file) {
  Json* rods = file.find("rods");
  auto* list = rods ? std::get_if<Json::List>(&rods->value) : nullptr;
  if (!list) return;
  for (Json& rod : *list) {
    Json* section = rod.find("section");
    const Json* length = rod.find("length");
    if (!section || !length || rod.find("parts")) continue;
    Json part{Json::Object{{"upto", *length}, {"section", std::move(*section)}}};
    for (JsonMember& member : std::get<Json::Object>(rod.value))
      if (member.key == "section") member = {"parts", Json{Json::List{std::move(part)}}};
  }
}

using Step = void (*)(Json& file);
constexpr Step steps[] = {sections_to_parts};  // the k-th leads from version k to k + 1
static_assert(std::size(steps) == scene_file_version);

}  // namespace

void bring_up_to_date(Json& file, const std::string& who) {
  const JsonPlace root(file, who);
  if (!root.has("format") || root["format"].text() != "tendril scene")
    throw UsageError(who + ": this is no scene file (\"format\": \"tendril scene\" is missing)");
  const int version = root["version"].whole(0, 1'000'000);
  if (version > scene_file_version)
    root["version"].fail("the file is of version " + std::to_string(version) + ", this program reads versions up to " +
                         std::to_string(scene_file_version) + "; a newer one is needed");
  for (int k = version; k < scene_file_version; ++k) steps[k](file);
}

}  // namespace tendril
