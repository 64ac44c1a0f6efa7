#include "unit/binding/probe.h"

#include <new>

using namespace tendril::lua;
using tendril::UsageError;
using tendril::Vec3;

namespace {

Schema options() {
  return {
      option<double>("outer", "m", "Outer diameter").required().above(0),
      option<double>("share", "", "A share").at_least(0).at_most(1).preset(0.5),
      option<double>("cold", "K", "Below a bound").below(300),
      option<int>("count", "", "How many").at_least(1).preset(40),
      option<bool>("fine", "", "Finely").preset(false),
      option<std::string>("kind", "", "How it holds").one_of({"fixed", "swivel", "slide"}).preset("fixed"),
      option<std::variant<double, std::array<double, 2>>>("EI", "N m^2", "Bending stiffness"),
      option<std::vector<Vec3>>("points", "m", "Where"),
      option<std::map<std::string, double>>("weights", "", "By name"),
      option<Probe>("probe", "", "Another one"),
      option<Function>("measure", "", "What to measure"),
  };
}

std::string summary(const Options& o) {
  std::string text = std::to_string(o.get<double>("outer")) + " " + std::to_string(o.get<double>("share")) + " " +
                     std::to_string(o.get<int>("count")) + " " + (o.get<bool>("fine") ? "fine" : "coarse") + " " +
                     o.get<std::string>("kind");
  if (const auto EI = o.maybe<std::variant<double, std::array<double, 2>>>("EI"))
    text += EI->index() == 0 ? " EI " + std::to_string(std::get<0>(*EI)) : " EI2 " + std::to_string(std::get<1>(*EI)[1]);
  if (const Probe* probe = o.find<Probe>("probe")) text += " " + probe->name;
  if (o.has("points")) text += " points " + std::to_string(o.get<std::vector<Vec3>>("points").size());
  if (o.has("weights"))
    for (const auto& [name, weight] : o.get<std::map<std::string, double>>("weights")) text += " " + name + std::to_string(int(weight));
  return text;
}

}  // namespace

void bind_probe(lua_State* L) {
  Class<Probe>(L, "A probe")
      .property("name", "", "Its name", [](const Probe& p) { return p.name; })
      .property("frames", "", "Some places", [](const Probe&) { return std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}; })
      .method("renamed", {.takes = {"name"}, .does = "A copy."}, [](const Probe& p, const std::string& name) {
        Probe copy = p;
        copy.name = name;
        return copy;
      })
      .method("rename", {.takes = {"name"}, .does = "Changes it."}, [](Probe& p, const std::string& name) { p.name = name; })
      .method("self", {.does = "The same object."}, [](std::shared_ptr<Probe> p) { return p; })
      .list([](const Probe& p) { return p.values.size(); }, [](const Probe& p, std::size_t i) { return p.values[i]; })
      .members([](const Probe&) { return std::vector<std::string>{"gap"}; },
               [](const Probe&, const std::string& name) {
                 return name == "gap" ? std::optional<double>(0.25) : std::nullopt;
               })
      .tostring([](const Probe& p) { return "probe " + p.name; });

  Module(L, "probe", "For tests")
      .function("new", {.takes = {"name"}, .does = "A new one."}, [](const std::string& name) { return Probe(name); })
      .function("options", {.options = options(), .does = "Shows its options."}, summary)
      .function("list", {.options = Schema{option<double>("scale", "", "Factor").preset(1)}.with_list(
                             Value<Probe>::kind(), "probe", "The probes"),
                         .does = "Takes probes."},
                [](lua_State* state, const Options& o) {
                  double sum = 0;
                  for (const Any entry : o.list<Any>()) sum += entry.index > 0;
                  (void)state;
                  return sum * o.get<double>("scale");
                })
      .function("maybe", {.takes = {"n"}, .does = "An optional number."},
                [](std::optional<double> n) { return n ? std::optional<double>(*n * 2) : std::nullopt; })
      .function("call", {.takes = {"run", "n"}, .does = "Calls back."},
                [](lua_State* state, const Function& run, double n) { return run.call<double>(state, "probe.call", n, Vec3(1, 2, 3)); })
      .function("wrong_name", {.options = options(), .does = "A mistake in a binding."},
                [](const Options& o) { return o.get<double>("outre"); })
      .function("wrong_type", {.options = options(), .does = "A mistake in a binding."},
                [](const Options& o) { return o.get<int>("outer"); })
      .function("absent", {.options = options(), .does = "A mistake in a binding."},
                [](const Options& o) { return o.get<double>("cold"); })
      .function("usage", {.does = "Fails."}, [] { throw UsageError("probe.usage: no"); })
      .function("memory", {.does = "Fails."}, [] { throw std::bad_alloc(); })
      .function("surprise", {.does = "Fails."}, [] { throw std::out_of_range("surprise"); });
}
