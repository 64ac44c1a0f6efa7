#include "binding/method_steps.h"

#include "binding/card.h"
#include "binding/lua_class.h"

namespace tendril::lua {
namespace {

std::string counts_text(const MethodStep& step) {
  std::string text;
  for (const auto& [what, count] : step.counts) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  return text;
}

}  // namespace

std::string steps_table(const std::vector<MethodStep>& steps) {
  std::vector<std::vector<std::string>> rows;
  for (const MethodStep& step : steps) rows.push_back({step.name, quantity(step.seconds, "s"), counts_text(step)});
  return table_text({"step", "time", "counts"}, rows);
}

void bind_steps(lua_State* L) {
  Class<MethodStep>(L, "One step of a method, by the thesis's name")
      .property("name", "", "Of the step", [](const MethodStep& s) { return s.name; })
      .property("seconds", "s", "Run time", [](const MethodStep& s) { return s.seconds; })
      .property("counts", "", "How many of what", [](const MethodStep& s) {
        std::map<std::string, double> all;
        for (const auto& [what, count] : s.counts) all[what] = static_cast<double>(count);
        return all;
      })
      .tostring([](const MethodStep& s) { return s.name + ": " + quantity(s.seconds, "s") + (s.counts.empty() ? "" : ", ") + counts_text(s); });
}

}  // namespace tendril::lua
