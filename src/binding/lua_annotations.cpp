// Editor annotations in the format of the Lua language server, from the record of everything bound.
#include "binding/lua_registry.h"

namespace tendril::lua {
namespace {

std::string one_line(std::string text) {
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

std::string meaning(const Option& option) {
  std::string text = option.text;
  std::string details = option.unit;
  const auto add = [&](const std::string& detail) {
    if (!detail.empty()) details += (details.empty() ? "" : "; ") + detail;
  };
  add(option.range());
  if (const std::string preset = option.preset_text(); !preset.empty()) add("default " + preset);
  return details.empty() ? text : text + " (" + details + ")";
}

std::string type_of(const Option& option) {
  if (option.choices.empty()) return option.kind->annotation;
  std::string type;
  for (const std::string& choice : option.choices) type += (type.empty() ? "\"" : "|\"") + choice + '"';
  return type;
}

/// "tendril.rod.section.options"
std::string options_class(const FunctionRecord& function) {
  std::string name = "tendril." + function.name + ".options";
  for (char& c : name)
    if (c == ':') c = '.';
  return name;
}

std::string options_annotation(const FunctionRecord& function) {
  std::string text = "---@class (exact) " + options_class(function) + "\n";
  if (const auto& list = function.options.list())
    text += "---@field [integer] " + list->kind->annotation + " " + one_line(list->text) + "\n";
  for (const Option& option : function.options.entries())
    text += "---@field " + option.name + (option.needed ? " " : "? ") + type_of(option) + " " + one_line(meaning(option)) + "\n";
  return text + "\n";
}

std::string function_annotation(const FunctionRecord& function, const std::string& owner) {
  std::string text = function.takes_options ? options_annotation(function) : "";
  text += "---" + one_line(function.text) + "\n";
  std::string parameters;
  const auto add = [&](const std::string& name, const std::string& type, bool optional) {
    text += "---@param " + name + (optional ? "? " : " ") + type + "\n";
    parameters += (parameters.empty() ? "" : ", ") + name;
  };
  for (const Parameter& parameter : function.parameters) {
    std::string type = parameter.kind->annotation;
    const bool optional = type.ends_with('?');
    if (optional) type.pop_back();
    add(parameter.name, type, optional);
  }
  if (function.takes_options) add("options", options_class(function), !function.options.needs_something());
  if (!function.returns.empty()) text += "---@return " + function.returns + "\n";
  return text + "function " + owner + function.own_name() + "(" + parameters + ") end\n\n";
}

/// Of the operators that the annotations know.
std::string operator_annotation(const FunctionRecord& operation) {
  const std::string name = operation.event.substr(2);
  if (name == "unm" || name == "len") return "---@operator " + name + ": " + operation.returns + "\n";
  if (name != "add" && name != "sub" && name != "mul" && name != "div") return {};
  return "---@operator " + name + "(" + operation.parameters.at(1).kind->annotation + "): " + operation.returns + "\n";
}

std::string class_annotation(const ClassRecord& record) {
  std::string text = "---" + one_line(record.text) + "\n---@class " + record.name + "\n";
  for (const auto& [name, property] : record.properties)
    text += "---@field " + name + " " + property.annotation + " " + one_line(property.text) +
            (property.unit.empty() ? "" : " (" + property.unit + ")") + "\n";
  if (record.member_names) text += "---@field [string] any\n";
  if (record.push_entry) text += "---@field [integer] any\n";
  for (const FunctionRecord* operation : record.operations) text += operator_annotation(*operation);
  // A local table carries the methods, so that the class needs no global of its own name.
  const std::string holder = record.name + "_methods";
  text += "local " + holder + " = {}\n\n";
  for (const auto& [name, method] : record.methods) text += function_annotation(*method, holder + ":");
  return text;
}

}  // namespace

std::string annotations(const Registry& registry) {
  std::string text =
      "---@meta tendril\n"
      "-- Written by `tendril --annotations`: do not edit. For editors that speak to the Lua language server.\n\n";
  for (const auto& record : registry.classes) text += class_annotation(*record);
  for (const auto& module : registry.modules) {
    if (!module->name.empty()) {
      text += "---" + one_line(module->text) + "\n";
      text += module->name + " = {}\n\n";
    }
    for (const PropertyRecord& constant : module->constants)
      text += "---" + constant.text + (constant.unit.empty() ? "" : " (" + constant.unit + ")") + "\n---@type number\n" +
              module->name + "." + constant.name + " = 0\n\n";
    for (const FunctionRecord* function : module->functions)
      text += function_annotation(*function, module->name.empty() ? "" : module->name + ".");
  }
  return text;
}

}  // namespace tendril::lua
