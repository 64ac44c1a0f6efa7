// envelope: the space that rods need over all outcomes of a study, or all times of a motion.
#include "binding/bind_envelope.h"

#include "binding/bind_mesh.h"
#include "binding/card.h"
#include "binding/examples.h"
#include "binding/method_options.h"
#include "binding/scene_classes.h"
#include "binding/variation_classes.h"
#include "method/envelope/collector.h"
#include "method/variation/study_envelope.h"

namespace tendril::lua {

/// How an envelope was made.
struct EnvelopeReport {
  Envelope made;  ///< without its mesh
  int failed = 0, jumped = 0;
  double seconds_for_outcomes = 0;
};

template <> inline constexpr const char* class_name<EnvelopeReport> = "envelope_report";

namespace {

Schema envelope_schema(bool of_study) {
  Schema schema{
      option<double>("resolution", "m", "Grid step; at most the thinnest rod's radius").above(0).preset(2e-3),
      option<double>("share", "", "Of the outcomes that it contains entirely; 1: all of them").above(0).at_most(1).preset(1),
      option<double>("memory", "bytes", "That it may take: more is refused").above(0).preset(2e9),
  };
  if (of_study)
    schema = schema + Schema{option<bool>("uniform", "", "Every variable uniform over its tolerance, for the space that may be needed "
                                                         "within the tolerances; false: spread as in the study").preset(true),
                             option<int>("outcomes", "", "How many; default: as many as the study's").at_least(1).at_most(1e7)};
  return schema + Schema{option<int>("threads", "", "At most; default: all that the machine has").at_least(1).at_most(4096)} + timeout_schema();
}

EnvelopeOptions envelope_options(const Options& o) {
  return {o.get<double>("resolution"), o.get<double>("share"), o.get<double>("memory")};
}

RunContext envelope_context(lua_State* L, const Options& o) {
  RunContext context = run_context(L, o);
  context.threads = o.maybe<int>("threads").value_or(0);
  return context;
}

/// Pushes the mesh (nil where there is none) and the report.
Pushed push_envelope(lua_State* L, EnvelopeReport report) {
  Mesh mesh = std::move(report.made.mesh);
  report.made.mesh = {};
  mesh.name = "envelope";
  if (report.made.status == Status::solved) Value<MeshValue>::push(L, make_mesh_value(std::move(mesh)));
  else lua_pushnil(L);
  Value<EnvelopeReport>::push(L, std::move(report));
  return {2};
}

Pushed study_envelope(lua_State* L, EnvelopeBuilder& builder, const VariationHandle& v, const Options& o) {
  RunContext context = envelope_context(L, o);
  const variation::Study& study = *v.result->study;
  context.seed = study.seed();
  variation::Options options = study.options();
  options.uniform = options.uniform || o.get<bool>("uniform");
  options.outcomes = o.maybe<int>("outcomes").value_or(options.outcomes);
  options.measures.clear();
  options.measured = false;
  options.effects = 0;
  // Nothing but the frames is wanted: a study of its own, from the same nominal equilibrium.
  const variation::Study sampled(study.nominal(), options, context);
  variation::StudyEnvelope made = variation::envelope_of(sampled, envelope_options(o), builder, context);
  return push_envelope(L, {std::move(made.envelope), made.failed, made.jumped, made.seconds_for_outcomes});
}

Pushed motion_envelope(lua_State* L, EnvelopeBuilder& builder, const SceneMotion& motion, const Options& o) {
  if (motion.equilibria.empty()) throw UsageError("motion:envelope: the motion has no equilibria");
  const RunContext context = envelope_context(L, o);
  const EnvelopeOptions options = envelope_options(o);
  EnvelopeReport report;
  if (options.share < 1) {
    EnvelopeCollector collector(*motion.equilibria.front(), options.voxel, EnvelopeOutcomes::Keep::all);
    for (const auto& equilibrium : motion.equilibria) report.made.status = collector.add(*equilibrium, context);
    report.made.status = collector.finish(context);
    if (report.made.status == Status::solved) builder.build(collector.outcomes(), options, context, report.made);
  } else {
    const EnvelopeOutcomes swept = swept_space(motion.equilibria, options.voxel, context, report.made.status);
    if (report.made.status == Status::solved) builder.build(swept, options, context, report.made);
    if (report.made.status == Status::solved) report.made.outcomes = static_cast<int>(motion.equilibria.size());
  }
  return push_envelope(L, std::move(report));
}

std::string describe_report(const EnvelopeReport& r) {
  Card card("envelope");
  card.row("status", name_of(r.made.status));
  card.row("volume", quantity(1e3 * r.made.volume, "dm^3"));
  card.row("outcomes", std::to_string(r.made.outcomes),
           r.failed > 0 ? std::to_string(r.failed) + " failed are not in it" : r.made.left_out.empty() ? "" : std::to_string(r.made.left_out.size()) + " left out");
  card.row("grid step", r.made.voxel, "m", "margin " + quantity(r.made.margin, "m") + ", bulge between chords " + quantity(r.made.sagitta, "m"));
  card.row("time", r.made.seconds, "s", "and " + quantity(r.seconds_for_outcomes, "s") + " for the outcomes");
  return card.text();
}

}  // namespace

void add_envelope_to(Class<VariationHandle>& variation, const std::shared_ptr<EnvelopeBuilder>& builder) {
  variation.method("envelope",
                   {.options = envelope_schema(true), .returns = "mesh, envelope_report",
                    .does = "A watertight mesh that contains the rods in every outcome (or a share of the outcomes), and how it was made.",
                    .example = with_hose("local v = method.variation(s, {vary = {[\"hose.length\"] = 0.02}, outcomes = 50})\n"
                                         "local mesh, about = v:envelope{resolution = 5e-3}\nprint(mesh.watertight, about.outcomes)  --> true\t50")},
                   [builder](lua_State* L, const VariationHandle& v, const Options& o) { return study_envelope(L, *builder, v, o); });
}

void add_envelope_to(Class<SceneMotion>& motion, const std::shared_ptr<EnvelopeBuilder>& builder) {
  motion.method("envelope",
                {.options = envelope_schema(false), .returns = "mesh, envelope_report",
                 .does = "A watertight mesh that contains the rods at the times that the motion kept and on straight ways between them, and how it was made.",
                 .example = with_hose("local m = s:motion{steps = 4, holds = {[\"hose.finish\"] = function(t)\n"
                                      "  return frame{at = {0.9, 0.1 * t, 0}, along = {1, 0, 0}} end}}\n"
                                      "print(m:envelope{resolution = 5e-3}.watertight)  --> true")},
                [builder](lua_State* L, const SceneMotion& m, const Options& o) { return motion_envelope(L, *builder, m, o); });
}

void bind_envelope(lua_State* L) {
  Class<EnvelopeReport>(L, "How an envelope was made")
      .property("ok", "", "There is a mesh", [](const EnvelopeReport& r) { return r.made.status == Status::solved; })
      .property("status", "", "How it ended", [](const EnvelopeReport& r) { return name_of(r.made.status); })
      .property("volume", "m^3", "Within the envelope", [](const EnvelopeReport& r) { return r.made.volume; })
      .property("resolution", "m", "Grid step", [](const EnvelopeReport& r) { return r.made.voxel; })
      .property("margin", "m", "Added to the radii so that the grid loses nothing", [](const EnvelopeReport& r) { return r.made.margin; })
      .property("sagitta", "m", "Added for the centre line's bulge from its chords", [](const EnvelopeReport& r) { return r.made.sagitta; })
      .property("outcomes", "", "Contained", [](const EnvelopeReport& r) { return r.made.outcomes; })
      .property("left_out", "", "How many were left out for the share", [](const EnvelopeReport& r) { return r.made.left_out.size(); })
      .property("failed", "", "Outcomes without an equilibrium: not contained", [](const EnvelopeReport& r) { return r.failed; })
      .property("jumped", "", "Contained, in another equilibrium than the nominal one's continuation", [](const EnvelopeReport& r) { return r.jumped; })
      .property("seconds", "s", "For the envelope", [](const EnvelopeReport& r) { return r.made.seconds; })
      .property("seconds_for_outcomes", "s", "For solving them", [](const EnvelopeReport& r) { return r.seconds_for_outcomes; })
      .property("steps", "s", "Seconds of each step, by name",
                [](const EnvelopeReport& r) {
                  std::map<std::string, double> seconds;
                  for (const Envelope::Step& step : r.made.steps) seconds[step.name] += step.seconds;
                  return seconds;
                })
      .tostring(describe_report);
}

}  // namespace tendril::lua
