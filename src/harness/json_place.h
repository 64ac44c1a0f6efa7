// A place in a JSON file that is being read: what stands there, of which kind, and messages that say where.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/frame.h"
#include "harness/json.h"

namespace tendril {

/// `who` opens all messages ("scene.load: study.scene.json"), then comes the path ("rods[3].holds[1].at"; lists count from 1).
/// All throw UsageError for what is missing or of another kind. The Json and `who` must outlive it.
class JsonPlace {
 public:
  JsonPlace(const Json& json, const std::string& who, std::string path = {}) : json_(json), who_(who), path_(std::move(path)) {}

  double number() const;  ///< finite
  double at_least(double least) const;
  int whole(int least, int most) const;
  bool boolean() const;
  const std::string& text() const;
  Vec3 vector() const;
  std::vector<double> numbers() const;
  /// {"at": place, "quaternion": [w, x, y, z]}, or for people {"at":, "along":, "up":}.
  Frame frame() const;

  /// The items of a list.
  std::vector<JsonPlace> items() const;

  /// An object's members. Missing ones: an error, or nothing.
  JsonPlace operator[](std::string_view key) const;
  bool has(std::string_view key) const { return json_.find(key) != nullptr; }
  double number_or(std::string_view key, double otherwise) const { return has(key) ? (*this)[key].number() : otherwise; }
  bool boolean_or(std::string_view key, bool otherwise) const { return has(key) ? (*this)[key].boolean() : otherwise; }

  /// An error for a member of another name, with the nearest of these.
  void only(std::initializer_list<const char*> keys) const;

  [[noreturn]] void fail(const std::string& why) const;

  /// What `make` returns; an error in it is told with this place.
  template <class Make>
  auto guarded(Make make) const {
    try {
      return make();
    } catch (const UsageError& wrong) {
      if (std::string_view(wrong.what()).starts_with(who_)) throw;
      fail(wrong.what());
    }
  }

 private:
  [[noreturn]] void expected(const char* what) const;

  const Json& json_;
  const std::string& who_;
  std::string path_;
};

}  // namespace tendril
