// Reads binary glTF back for the tests: its JSON as a tree, its accessors as numbers.
#pragma once

#include <charconv>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace tendril::test {

struct Json {
  enum class Kind { null, number, text, flag, list, object } kind = Kind::null;
  double number = 0;
  std::string text;
  std::vector<Json> items;
  std::map<std::string, Json> members;

  bool has(const std::string& name) const { return members.count(name) > 0; }
  const Json& operator[](const std::string& name) const { return members.at(name); }
  const Json& operator[](std::size_t i) const { return items.at(i); }
  std::size_t size() const { return items.size(); }
  std::size_t index() const { return static_cast<std::size_t>(number); }
};

class JsonReader {
 public:
  explicit JsonReader(const std::string& text) : text_(text) {}
  Json read() {
    Json value = any();
    blanks();
    if (at_ != text_.size()) throw std::runtime_error("JSON: something after its end");
    return value;
  }

 private:
  void blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\n')) ++at_;
  }
  bool take(char c) {
    blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!take(c)) throw std::runtime_error("JSON: '" + std::string(1, c) + "' expected at " + std::to_string(at_));
  }
  Json any() {
    blanks();
    Json value;
    if (take('{')) {
      value.kind = Json::Kind::object;
      while (!take('}')) {
        if (!value.members.empty()) expect(',');
        const std::string name = string();
        expect(':');
        if (!value.members.emplace(name, any()).second) throw std::runtime_error("JSON: '" + name + "' twice");
      }
    } else if (take('[')) {
      value.kind = Json::Kind::list;
      while (!take(']')) {
        if (!value.items.empty()) expect(',');
        value.items.push_back(any());
      }
    } else if (text_[at_] == '"') {
      value.kind = Json::Kind::text;
      value.text = string();
    } else if (text_.compare(at_, 4, "true") == 0) {
      value.kind = Json::Kind::flag;
      value.number = 1;
      at_ += 4;
    } else {
      value.kind = Json::Kind::number;
      const auto [end, error] = std::from_chars(&text_[at_], text_.data() + text_.size(), value.number);
      if (error != std::errc{}) throw std::runtime_error("JSON: a number expected at " + std::to_string(at_));
      at_ = static_cast<std::size_t>(end - text_.data());
    }
    return value;
  }
  std::string string() {
    expect('"');
    std::string value;
    for (; text_.at(at_) != '"'; ++at_) {
      if (text_[at_] == '\\') ++at_;
      value += text_[at_];
    }
    ++at_;
    return value;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

struct Glb {
  Json json;
  std::string data;

  explicit Glb(const std::string& bytes) {
    const auto word = [&](std::size_t at) {
      std::uint32_t value;
      std::memcpy(&value, bytes.data() + at, 4);
      return static_cast<std::size_t>(value);
    };
    if (bytes.substr(0, 4) != "glTF" || word(4) != 2 || word(8) != bytes.size()) throw std::runtime_error("GLB: bad header");
    const std::size_t json_size = word(12), data_at = 20 + json_size;
    if (json_size % 4 || bytes.substr(16, 4) != "JSON" || word(data_at) % 4 || bytes.substr(data_at + 4, 4) != std::string("BIN\0", 4) ||
        data_at + 8 + word(data_at) != bytes.size())
      throw std::runtime_error("GLB: bad chunks");
    const std::string text = bytes.substr(20, json_size);
    json = JsonReader(text).read();
    data = bytes.substr(data_at + 8);
    if (json["buffers"][0]["byteLength"].index() != data.size()) throw std::runtime_error("GLB: bad buffer");
  }

  static int width(const std::string& type) {
    return std::map<std::string, int>{{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}}.at(type);
  }
  /// The accessor's rows.
  std::vector<std::vector<double>> rows(const Json& number) const {
    const Json& accessor = json["accessors"][number.index()];
    const Json& view = json["bufferViews"][accessor["bufferView"].index()];
    const int columns = width(accessor["type"].text), component = static_cast<int>(accessor["componentType"].number);
    const std::size_t size = component == 5123 ? 2 : 4, count = accessor["count"].index();
    std::size_t at = view["byteOffset"].index();
    if (at % 4 || view["byteLength"].index() != count * size * static_cast<std::size_t>(columns) || at + view["byteLength"].index() > data.size())
      throw std::runtime_error("GLB: an accessor that does not fit its view");
    std::vector<std::vector<double>> all(count);
    for (auto& row : all)
      for (int k = 0; k < columns; ++k, at += size) {
        float real;
        std::uint16_t half;
        std::uint32_t whole;
        if (component == 5126) std::memcpy(&real, &data[at], 4), row.push_back(real);
        else if (component == 5123) std::memcpy(&half, &data[at], 2), row.push_back(half);
        else std::memcpy(&whole, &data[at], 4), row.push_back(whole);
      }
    return all;
  }

  /// The number of the node of this name; -1 without one.
  int node(const std::string& name) const {
    for (std::size_t i = 0; i < json["nodes"].size(); ++i)
      if (json["nodes"][i]["name"].text == name) return static_cast<int>(i);
    return -1;
  }
};

}  // namespace tendril::test
