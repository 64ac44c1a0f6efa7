#include "harness/json_place.h"

#include <cmath>

#include "base/nearest_name.h"
#include "base/number_text.h"
#include "base/printable.h"

namespace tendril {
namespace {

std::string described(const Json& json) {
  if (const bool* flag = std::get_if<bool>(&json.value)) return *flag ? "true" : "false";
  if (const double* number = std::get_if<double>(&json.value)) return number_text(*number);
  if (const std::string* word = std::get_if<std::string>(&json.value))
    return '"' + printable(*word, 60) + '"';
  if (const auto* list = std::get_if<Json::List>(&json.value)) return "a list of " + std::to_string(list->size());
  return std::holds_alternative<Json::Object>(json.value) ? "an object" : "null";
}

}  // namespace

void JsonPlace::fail(const std::string& why) const {
  throw UsageError(who_ + ": " + (path_.empty() ? "" : path_ + ": ") + printable(why, 500));
}

void JsonPlace::expected(const char* what) const { fail("got " + described(json_) + ", expected " + what); }

double JsonPlace::number() const {
  const double* number = std::get_if<double>(&json_.value);
  if (!number || !std::isfinite(*number)) expected("a number");
  return *number;
}

double JsonPlace::at_least(double least) const {
  const double value = number();
  if (value < least) expected(("a number of at least " + number_text(least)).c_str());
  return value;
}

int JsonPlace::whole(int least, int most) const {
  const double value = number();
  if (value != std::floor(value) || value < least || value > most)
    expected(("a whole number from " + std::to_string(least) + " to " + std::to_string(most)).c_str());
  return static_cast<int>(value);
}

bool JsonPlace::boolean() const {
  const bool* flag = std::get_if<bool>(&json_.value);
  if (!flag) expected("true or false");
  return *flag;
}

const std::string& JsonPlace::text() const {
  const std::string* word = std::get_if<std::string>(&json_.value);
  if (!word) expected("a text");
  return *word;
}

std::vector<JsonPlace> JsonPlace::items() const {
  const auto* list = std::get_if<Json::List>(&json_.value);
  if (!list) expected("a list");
  std::vector<JsonPlace> places;
  places.reserve(list->size());
  for (std::size_t i = 0; i < list->size(); ++i)
    places.emplace_back((*list)[i], who_, path_ + "[" + std::to_string(i + 1) + "]");
  return places;
}

std::vector<double> JsonPlace::numbers() const {
  std::vector<double> values;
  for (const JsonPlace& item : items()) values.push_back(item.number());
  return values;
}

Vec3 JsonPlace::vector() const {
  const auto* list = std::get_if<Json::List>(&json_.value);
  if (!list || list->size() != 3) expected("a list of 3 numbers");
  Vec3 v;
  for (int k = 0; k < 3; ++k) {
    const double* number = std::get_if<double>(&(*list)[k].value);
    if (!number || !std::isfinite(*number)) items()[k].expected("a number");
    v[k] = *number;
  }
  return v;
}

Frame JsonPlace::frame() const {
  only({"at", "quaternion", "along", "up"});
  const Vec3 at = (*this)["at"].vector();
  if (!has("quaternion")) {
    if (!has("along")) fail("'quaternion' is missing (or 'along')");
    return guarded([&] { return Frame::looking(at, (*this)["along"].vector(), has("up") ? (*this)["up"].vector() : Vec3(Vec3::Zero())); });
  }
  if (has("along") || has("up")) fail("got both 'quaternion' and 'along' or 'up'; give one or the other");
  const JsonPlace place = (*this)["quaternion"];
  const std::vector<double> q = place.numbers();
  if (q.size() != 4) place.expected("a list of 4 numbers, w, x, y, z");
  const Quat rotation(q[0], q[1], q[2], q[3]);
  if (!(std::abs(rotation.norm() - 1) <= 1e-9)) place.fail("its length is " + number_text(rotation.norm()) + ", expected 1");
  return {at, rotation};
}

JsonPlace JsonPlace::operator[](std::string_view key) const {
  if (!std::holds_alternative<Json::Object>(json_.value)) expected("an object");
  const Json* member = json_.find(key);
  if (!member) fail("'" + std::string(key) + "' is missing");
  return {*member, who_, (path_.empty() ? "" : path_ + ".") + std::string(key)};
}

void JsonPlace::only(std::initializer_list<const char*> keys) const {
  const auto* object = std::get_if<Json::Object>(&json_.value);
  if (!object) expected("an object");
  const std::vector<std::string> known(keys.begin(), keys.end());
  for (const JsonMember& member : *object)
    if (std::find(known.begin(), known.end(), member.key) == known.end())
      fail("unknown key " + unknown_name(member.key, "keys", known));
}

}  // namespace tendril
