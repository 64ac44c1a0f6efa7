// JSON: what is written is read again bit by bit, and what is none is refused with its place.
#include <catch2/catch.hpp>

#include <cstring>
#include <limits>
#include <random>

#include "base/error.h"
#include "harness/json.h"
#include "harness/json_place.h"

using namespace tendril;
using Catch::Matchers::Contains;

namespace {

Json random_json(std::mt19937& random, int depth) {
  std::uniform_int_distribution<int> kind(0, depth > 0 ? 5 : 3), count(0, 4), letter(1, 126);
  Json json;
  switch (kind(random)) {
    case 0: break;
    case 1: json.value = letter(random) % 2 == 0; break;
    case 2: {
      double number = 0;
      do {
        const std::uint64_t bits = (std::uint64_t(random()) << 32) | random();
        std::memcpy(&number, &bits, sizeof number);
      } while (!std::isfinite(number));
      json.value = number;
      break;
    }
    case 3: {
      std::string word;
      for (int k = count(random); k > 0; --k) word += static_cast<char>(letter(random));
      json.value = word + (letter(random) < 20 ? "\xc3\xa9" : "");
      break;
    }
    case 4: {
      Json::List list;
      for (int k = count(random); k > 0; --k) list.push_back(random_json(random, depth - 1));
      json.value = std::move(list);
      break;
    }
    default: {
      Json::Object object;
      for (int k = count(random); k > 0; --k) object.push_back({"key " + std::to_string(k), random_json(random, depth - 1)});
      json.value = std::move(object);
    }
  }
  return json;
}

bool same(const Json& a, const Json& b) {
  if (a.value.index() != b.value.index()) return false;
  if (const double* x = std::get_if<double>(&a.value)) return std::memcmp(x, &std::get<double>(b.value), sizeof *x) == 0;
  if (const auto* list = std::get_if<Json::List>(&a.value))
    return std::equal(list->begin(), list->end(), std::get<Json::List>(b.value).begin(), std::get<Json::List>(b.value).end(), same);
  if (const auto* object = std::get_if<Json::Object>(&a.value)) {
    const auto& other = std::get<Json::Object>(b.value);
    return std::equal(object->begin(), object->end(), other.begin(), other.end(),
                      [](const JsonMember& x, const JsonMember& y) { return x.key == y.key && same(x.value, y.value); });
  }
  if (const std::string* word = std::get_if<std::string>(&a.value)) return *word == std::get<std::string>(b.value);
  if (const bool* flag = std::get_if<bool>(&a.value)) return *flag == std::get<bool>(b.value);
  return true;
}

std::string error_of(std::string_view text) {
  try {
    parse_json(text, "file");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("json: what is written is read again, bit by bit") {
  for (unsigned seed = 1; seed <= 500; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const Json json = random_json(random, 5);
    const std::string text = json_text(json);
    INFO(text);
    const Json again = parse_json(text, "file");
    CHECK(same(json, again));
    CHECK(json_text(again) == text);
  }
  for (const double number : {0.0, -0.0, 1.0, -1.0, 0.1, 1e300, 5e-324, std::numeric_limits<double>::max(), 123456789.0, 1e15, 2e22}) {
    const Json again = parse_json(json_text({number}), "file");
    INFO(number);
    CHECK(same(again, {number}));
  }
}

TEST_CASE("json: the layout is for people") {
  const char* text = "{\n  \"name\": \"hose\",\n  \"points\": [\n    [1, 2.5, -0.0],\n    [0, 0, 1e+100]\n  ],\n  \"empty\": [],\n"
                     "  \"one\": {\"a\": 1, \"b\": [1, 2]}\n}\n";
  CHECK(json_text(parse_json(text, "file")) == text);
}

TEST_CASE("json: what is none is refused with its place") {
  CHECK_THAT(error_of(""), Contains("file: ") && Contains("unexpected end of input"));
  CHECK_THAT(error_of("{\"a\": 1,\n \"b\": nan}"), Contains("line 2"));
  CHECK_THAT(error_of("[1, 2"), Contains("unexpected end of input"));
  CHECK_THAT(error_of("[1e999]"), Contains("1e999"));
  CHECK_THAT(error_of("[Infinity]"), Contains("line 1"));
  CHECK_THAT(error_of("[1] 2"), Contains("line 1"));
  CHECK_THAT(error_of("[1,]"), Contains("line 1"));
  CHECK_THAT(error_of("\"\xff\""), Contains("UTF-8"));
  CHECK_THAT(error_of("{\"a\": 1, \"b\": 2, \"a\": 3}"), Contains("the key 'a' stands twice"));
  CHECK_THAT(error_of(std::string(100'000, '[')), Contains("nested deeper than 32"));
  std::string objects;
  for (int k = 0; k < 100'000; ++k) objects += "{\"a\":";
  CHECK_THAT(error_of(objects), Contains("nested deeper than 32"));
  CHECK_NOTHROW(parse_json(std::string(32, '[') + std::string(32, ']'), "file"));
  CHECK(error_of("[\"" + std::string(100'000, 'x')).size() < 1000);
  CHECK_THROWS_WITH(json_text({std::string("caf\xe9")}), Contains("is not UTF-8"));
  CHECK(error_of("{\"\x1b[31m").find('\x1b') == std::string::npos);
}

TEST_CASE("json place: kinds, ranges and unknown keys are told by their path") {
  const Json json = parse_json("{\"rods\": [{\"name\": \"a\", \"length\": 1, \"clip\": true, \"at\": [1, 2, \"x\"], \"none\": null,"
                               " \"long\": \"01234567890123456789012345678901234567890123456789012345678901234567890123456789abc\"}]}", "file");
  const std::string who = "load";
  const JsonPlace rod = JsonPlace(json, who)["rods"].items().front();
  CHECK(rod["name"].text() == "a");
  CHECK(rod["length"].number() == 1);
  CHECK(rod.number_or("missing", 7) == 7);
  CHECK_FALSE(rod.boolean_or("missing", false));
  CHECK_THROWS_WITH(rod["name"].number(), "load: rods[1].name: got \"a\", expected a number");
  CHECK_THROWS_WITH(rod["length"].text(), "load: rods[1].length: got 1, expected a text");
  CHECK_THROWS_WITH(rod["length"].boolean(), "load: rods[1].length: got 1, expected true or false");
  CHECK_THROWS_WITH(rod["length"].items(), "load: rods[1].length: got 1, expected a list");
  CHECK_THROWS_WITH(rod["length"].whole(2, 5), "load: rods[1].length: got 1, expected a whole number from 2 to 5");
  CHECK_THROWS_WITH(rod["length"].at_least(2), "load: rods[1].length: got 1, expected a number of at least 2");
  CHECK_THROWS_WITH(rod["length"]["x"], "load: rods[1].length: got 1, expected an object");
  CHECK_THROWS_WITH(rod["at"].vector(), "load: rods[1].at[3]: got \"x\", expected a number");
  CHECK_THROWS_WITH(rod["clip"].vector(), "load: rods[1].clip: got true, expected a list of 3 numbers");
  CHECK_THROWS_WITH(rod["none"].numbers(), "load: rods[1].none: got null, expected a list");
  CHECK_THROWS_WITH(rod["long"].number(), Contains("...") && Contains("expected a number"));
  CHECK_THROWS_WITH(rod["shape"], "load: rods[1]: 'shape' is missing");
  CHECK_THROWS_WITH(rod.only({"name", "length", "clips", "at", "none", "long"}),
                    Contains("load: rods[1]: unknown key 'clip'; did you mean 'clips'?"));
  CHECK_THROWS_WITH(rod.number_or("name", 1), Contains("expected a number"));
}

TEST_CASE("json place: frames by quaternion or by directions") {
  const std::string who = "load";
  const auto frame = [&](const char* text) {
    const Json json = parse_json(text, who);
    return JsonPlace(json, who).frame();
  };
  CHECK(frame("{\"at\": [1, 2, 3], \"quaternion\": [0.6, 0, 0.8, 0]}").rotation.y() == 0.8);
  const Frame looking = frame("{\"at\": [1, 2, 3], \"along\": [0, 2, 0], \"up\": [1, 0, 0]}");
  CHECK((looking.d3() - Vec3::UnitY()).norm() < 1e-15);
  CHECK((looking.d1() - Vec3::UnitX()).norm() < 1e-15);
  CHECK_THROWS_WITH(frame("{\"at\": [1, 2, 3], \"quaternion\": [2, 0, 0, 0]}"), "load: quaternion: its length is 2, expected 1");
  CHECK_THROWS_WITH(frame("{\"at\": [1, 2, 3], \"quaternion\": [1, 0, 0]}"), Contains("expected a list of 4 numbers, w, x, y, z"));
  CHECK_THROWS_WITH(frame("{\"at\": [1, 2, 3]}"), Contains("'quaternion' is missing"));
  CHECK_THROWS_WITH(frame("{\"at\": [1, 2, 3], \"quaternion\": [1, 0, 0, 0], \"up\": [1, 0, 0]}"), Contains("give one or the other"));
  CHECK_THROWS_WITH(frame("{\"at\": [1, 2, 3], \"along\": [0, 0, 0]}"), Contains("'along' must be a finite vector"));
  CHECK_THROWS_WITH(frame("{\"at\": [1, 2, 3], \"quaternoin\": [1, 0, 0, 0]}"), Contains("did you mean 'quaternion'?"));
}
