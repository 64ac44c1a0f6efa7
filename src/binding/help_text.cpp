#include "binding/help_text.h"

#include <algorithm>

#include "base/nearest_name.h"
#include "binding/card.h"
#include "binding/help_search.h"

namespace tendril::lua {
namespace {

std::string indented(const std::string& text, const std::string& margin) {
  std::string result = margin;
  for (const char c : text) {
    result += c;
    if (c == '\n') result += margin;
  }
  return result;
}

std::string option_type(const Option& option) {
  if (!option.choices.empty()) return option.expected();
  const std::string range = option.range();
  return range.empty() ? option.kind->expected : option.kind->expected + (range[0] == '>' || range[0] == '<' ? " " : ", ") + range;
}

std::string options_table(const Schema& schema) {
  std::vector<std::vector<std::string>> rows;
  if (schema.list()) rows.push_back({schema.list()->name, "", schema.list()->text, "", schema.list()->kind->expected});
  for (const Option& option : schema.entries()) {
    const std::string preset = option.preset_text();
    rows.push_back({option.name, option.unit, option.text, option.needed ? "required" : preset, option_type(option)});
  }
  return rows.empty() ? "" : table_text({"option", "unit", "meaning", "default", "what fits"}, rows);
}

std::vector<std::string> function_row(const FunctionRecord& function) {
  return {function.call == FunctionRecord::Call::method ? ":" + function.own_name() : function.name, function.text};
}

/// Rows without a head line.
std::string list_text(std::vector<std::vector<std::string>> rows) {
  if (rows.empty()) return {};
  const std::vector<std::string> first = rows.front();
  rows.erase(rows.begin());
  return table_text(first, rows);
}

}  // namespace

std::string help_overview(const Registry& registry) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& module : registry.modules) {
    if (!module->name.empty()) rows.push_back({module->name, module->text});
    else
      for (const FunctionRecord* function : module->functions) rows.push_back(function_row(*function));
  }
  std::sort(rows.begin(), rows.end());
  return "tendril: deformable 1D objects. SI units throughout; 60*units.mm is 0.06 (m).\n" + indented(list_text(rows), "  ") +
         "\nhelp(x) or ?x says more about a function, an object or a module; so does help \"rod.section\".";
}

std::string help_text(const FunctionRecord& function) {
  std::string text = function.signature() + "\n  " + function.text;
  std::vector<std::vector<std::string>> rows;
  for (const Parameter& parameter : function.parameters) rows.push_back({parameter.name, parameter.kind->expected});
  if (!rows.empty()) text += "\n\n" + indented(list_text(rows), "  ");
  if (const std::string options = options_table(function.options); !options.empty()) text += "\n\n" + indented(options, "  ");
  if (!function.example.empty()) text += "\n\n  Example\n" + indented(function.example, "    ");
  return text;
}

std::string help_text(const ClassRecord& record) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& [name, property] : record.properties) rows.push_back({"." + name, property.unit, property.text});
  for (const auto& [name, method] : record.methods) rows.push_back({":" + name, "", method->text});
  std::string text = record.name + "\n  " + record.text;
  if (!rows.empty()) text += "\n\n" + indented(list_text(rows), "  ");
  return text;
}

std::string help_text(const ModuleRecord& module) {
  std::vector<std::vector<std::string>> rows;
  for (const FunctionRecord* function : module.functions) rows.push_back({function->name, function->text});
  for (const PropertyRecord& constant : module.constants) rows.push_back({module.name + "." + constant.name, constant.text});
  std::string text = module.name + "\n  " + module.text;
  if (!rows.empty()) text += "\n\n" + indented(list_text(rows), "  ");
  return text;
}

std::string help_search_text(const Registry& registry, const std::string& query) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> names;
  for (const HelpMatch& match : search_help(registry, query)) {
    constexpr std::size_t most = 100;  // characters: a list is looked over, not read
    rows.push_back({match.name, match.text.size() > most ? match.text.substr(0, match.text.rfind(' ', most)) + " ..." : match.text});
    names.push_back(match.name);
  }
  if (rows.empty()) return {};
  const std::string near = nearest_name(query, names);
  return "nothing is called '" + query + "'" + (near.empty() ? "; what comes near it:" : "; did you mean '" + near + "'?") + "\n" +
         indented(list_text(rows), "  ");
}

std::string help_named(const Registry& registry, const std::string& name) {
  const FunctionRecord* function = registry.function(name);
  if (const auto dot = name.rfind('.'); !function && dot != std::string::npos)
    function = registry.function(name.substr(0, dot) + ":" + name.substr(dot + 1));
  const ClassRecord* record = registry.class_named(name);
  if (function && record) return help_text(*function) + "\n\n" + help_text(*record);  // vec, frame
  if (function) return help_text(*function);
  if (const ModuleRecord* module = name.empty() ? nullptr : registry.module(name)) {
    return record ? help_text(*module) + "\n\n" + help_text(*record) : help_text(*module);
  }
  return record ? help_text(*record) : "";
}

}  // namespace tendril::lua
