#include "harness/xml_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"

namespace tendril {

XmlFile::XmlFile(std::string_view content, const std::string& path) : content_(content), path_(path) {
  if (trimmed(content).empty()) fail_at(-1, "the file is empty");
  const pugi::xml_parse_result parsed = document_.load_buffer(content.data(), content.size());
  if (!parsed) fail_at(parsed.offset, std::string("this is no well-formed XML: ") + parsed.description());
  if (!root()) fail_at(-1, "there is no element in the file");
  collect_ids();
}

void XmlFile::collect_ids() {
  // By hand over the tree: a hostile file can be nested deeper than a stack.
  for (Node node = root(); node;) {
    if (const char* id = node.attribute("id").value(); *id) by_id_.emplace(id, node);
    if (Node child = node.first_child()) {
      node = child;
      continue;
    }
    while (node && !node.next_sibling()) node = node.parent();
    node = node.next_sibling();
  }
}

std::string_view XmlFile::local_name(Node node) {
  const std::string_view name = node.name();
  const auto colon = name.find(':');
  return colon == name.npos ? name : name.substr(colon + 1);
}

XmlFile::Node XmlFile::by_id(std::string_view id) const {
  const auto found = by_id_.find(id);
  return found == by_id_.end() ? Node() : found->second;
}

XmlFile::Node XmlFile::referenced(Node from, std::string_view id, const char* tag) const {
  const Node found = by_id(id);
  if (found && local_name(found) == tag) return found;
  const std::string owner = "<" + std::string(from.name()) + " id=\"" + from.attribute("id").value() + "\">";
  if (id.empty()) fail(from, owner + " names no " + tag);
  if (!found) fail(from, owner + " refers to '" + std::string(id) + "', which is not in the file");
  fail(from, owner + " refers to '" + std::string(id) + "', which is a " + std::string(local_name(found)) + ", expected a " + tag);
}

std::string_view XmlFile::trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::string_view XmlFile::text(Node node, const char* name) { return trimmed(node.child(name).text().get()); }

std::vector<std::string_view> XmlFile::words(std::string_view text) {
  std::vector<std::string_view> found;
  while (!(text = trimmed(text)).empty()) {
    const auto end = std::min(text.find_first_of(" \t\r\n"), text.size());
    found.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return found;
}

double XmlFile::number(Node node, std::string_view text) const {
  double value = 0;
  const std::string_view body = text.starts_with('+') ? text.substr(1) : text;
  const auto [end, error] = std::from_chars(body.data(), body.data() + body.size(), value);
  if (error != std::errc() || end != body.data() + body.size() || !std::isfinite(value))
    fail(node, "<" + std::string(node.name()) + ">: got '" + std::string(text.substr(0, 40)) + "', expected a finite number");
  return value;
}

Vec3 XmlFile::vector(Node node, const char* name) const {
  Vec3 found = Vec3::Zero();
  int count = 0;
  for (Node child : node.children(name)) {
    if (count < 3) found[count] = number(child, trimmed(child.text().get()));
    ++count;
  }
  if (count != 3)
    fail(node, "<" + std::string(node.name()) + ">: got " + std::to_string(count) + " <" + name + ">, expected 3");
  return found;
}

int XmlFile::line(Node at) const {
  const auto offset = std::clamp<std::ptrdiff_t>(at.offset_debug(), 0, static_cast<std::ptrdiff_t>(content_.size()));
  return 1 + static_cast<int>(std::count(content_.begin(), content_.begin() + offset, '\n'));
}

void XmlFile::fail(Node at, const std::string& why) const { fail_at(at.offset_debug(), why); }

void XmlFile::fail_at(std::ptrdiff_t offset, const std::string& why) const {
  std::string where = path_;
  if (offset >= 0) {
    const auto end = content_.begin() + std::min<std::ptrdiff_t>(offset, static_cast<std::ptrdiff_t>(content_.size()));
    where += ":" + std::to_string(1 + std::count(content_.begin(), end, '\n'));
  }
  throw UsageError("scene.import: " + where + ": " + why);
}

}  // namespace tendril
