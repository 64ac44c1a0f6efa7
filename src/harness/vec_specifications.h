// A VEC file keeps nearly everything in specifications, which lie in its documents and say by an attribute of what type they are.
#pragma once

#include "harness/xml_file.h"

namespace tendril {

/// The type that xsi:type names, without its prefix; empty where there is none.
inline std::string_view vec_type(XmlFile::Node node) {
  for (pugi::xml_attribute attribute : node.attributes()) {
    const std::string_view name = attribute.name();
    if (name != "type" && !name.ends_with(":type")) continue;
    const std::string_view type = attribute.value();
    const auto colon = type.find(':');
    return colon == type.npos ? type : type.substr(colon + 1);
  }
  return {};
}

/// All specifications of a type, in every document.
template <class Take>
void each_specification(const XmlFile& file, std::string_view type, Take take) {
  for (XmlFile::Node document : file.root().children("DocumentVersion"))
    for (XmlFile::Node specification : document.children("Specification"))
      if (vec_type(specification) == type) take(specification);
}

}  // namespace tendril
