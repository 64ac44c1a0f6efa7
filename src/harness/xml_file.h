// What the readers of harness files share: a parsed XML file, its elements by id, numbers read strictly, messages with lines.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/vectors.h"

namespace tendril {

class XmlFile {
 public:
  using Node = pugi::xml_node;

  /// Throws UsageError "scene.import: path: ..." for what is no well-formed XML. `content` must outlive the object.
  XmlFile(std::string_view content, const std::string& path);

  Node root() const { return document_.document_element(); }

  /// An element's name without its namespace prefix.
  static std::string_view local_name(Node node);

  /// Elements that have an `id`, anywhere in the file, found in constant time. The first of several with one id counts.
  Node by_id(std::string_view id) const;
  /// The element that `reference` names; throws, at the line of `from`, when there is none or it is no `tag`.
  Node referenced(Node from, std::string_view id, const char* tag) const;

  /// The text of the child `name`, without blanks around it; empty without such a child.
  static std::string_view text(Node node, const char* name);
  static std::string_view trimmed(std::string_view text);
  /// The words of a list of references.
  static std::vector<std::string_view> words(std::string_view text);

  /// One finite number; throws at the line of `node` for anything else.
  double number(Node node, std::string_view text) const;
  /// The numbers of all children `name`, which must be three.
  Vec3 vector(Node node, const char* name) const;

  [[noreturn]] void fail(Node at, const std::string& why) const;
  int line(Node at) const;  ///< from 1

 private:
  [[noreturn]] void fail_at(std::ptrdiff_t offset, const std::string& why) const;
  void collect_ids();

  std::string_view content_;
  const std::string& path_;
  pugi::xml_document document_;
  std::unordered_map<std::string_view, Node> by_id_;
};

}  // namespace tendril
