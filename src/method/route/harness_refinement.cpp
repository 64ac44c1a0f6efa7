#include "method/route/harness_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/number_text.h"
#include "base/units.h"
#include "method/route/harness_clips.h"
#include "method/route/harness_model.h"
#include "method/route/harness_scene.h"

namespace tendril::routing {

namespace {

constexpr double feasible = 5e-6;   // violations below the model's margins
constexpr double tolerance = 1e-6;  // of the cost
constexpr int most_evaluations = 100, most_in_contact = 30;
// Of the model's violation: one that misses more lies against surfaces or behind them, where no contact held it back.
constexpr double hopeless = 0.5;

// Slacks that clips are to leave along the route: first those that lengths may well make up for, then more of them.
constexpr std::array<double, 3> slacks_of_clips = {-3e-3, 0.03, 0.1};

// Shares: where more than this is missed with clips everywhere, lengths do not make up for it; another route may.
constexpr double by_lengths = 0.03;

class HarnessRefinement {
 public:
  HarnessRefinement(const Scene& scene, HarnessResult& harness, const RunContext& context)
      : scene_(scene), best_(harness), context_(context), around_(scene, harness) {}

  bool run(bool clips_first) {
    best_.design = design_as_routed(best_);
    if (clips_first) add_clips();
    if (!best_.equilibrium) {
      settle(scene_, best_, context_);
      adjust(best_.design, nullptr);
    }
    if (!clips_first && best_.options.max_clips > 0 && missed_at_rest(best_) > 0 && !context_.stop()) add_clips();
    return !hopeless_ || !best_.design.clips.empty();
  }

 private:
  void say(const std::string& what) { best_.refinement += (best_.refinement.empty() ? "" : "; ") + what; }

  /// Takes what becomes of a design where it misses less, or costs less, than the best one.
  void adjust(const HarnessDesign& design, const std::shared_ptr<const SceneEquilibrium>& from) {
    const HarnessVariables variables(scene_, best_, design);
    HarnessModel model(around_, best_, variables, context_);
    if (from) model.begin_from(from);
    HarnessResult other = best_;
    Eigen::VectorXd x = model.start();
    for (;;) {
      DescentOptions descent;
      descent.tolerance = tolerance;
      descent.feasible = feasible;
      descent.max_evaluations = model.touches_all() ? most_in_contact : most_evaluations;
      const DescentOutcome outcome = descend(model, x, descent, context_);
      hopeless_ = outcome.value.valid && outcome.value.violation > hopeless;
      if (!outcome.value.valid || hopeless_) break;
      x = outcome.x;
      other.design = model.design(x);
      settle(scene_, other, context_, model.accepted().equilibrium.get());
      offer(other);
      // What exerts no force on a harness that keeps clear of it does on one that only nearly does.
      if (outcome.value.violation > feasible || missed_at_rest(other) == 0 || model.touches_all() || context_.stop()) break;
      model.touch_all();
    }
    best_.equilibria += model.evaluations();
  }
  void offer(const HarnessResult& other) {
    const double before = missed_at_rest(best_), after = missed_at_rest(other);
    if (after > before || (after == before && settled_cost(other) > settled_cost(best_))) return;
    const int equilibria = best_.equilibria;
    const std::string said = best_.refinement;
    best_ = other;
    best_.equilibria = equilibria;
    best_.refinement = said;
  }
  double settled_cost(const HarnessResult& harness) const {
    double sum = 0;
    for (std::size_t b = 0; b < harness.branches.size(); ++b) sum += harness.branches[b].factor * harness.design.lengths[b];
    return sum;
  }

  void add_clips() {
    const int most = best_.options.max_clips;
    const std::vector<HarnessClip> places = harness_clip_places(around_, best_);
    if (places.empty())
      return say("nothing that takes clips is within " + number_text(best_.options.clip_reach / units::mm) + " mm of the route");
    int enough = 0;
    for (const double least : slacks_of_clips) {
      if (context_.stop() || missed_at_rest(best_) == 0) break;
      const HarnessClips choice = fewest_harness_clips(scene_, around_, best_, places, most, least, context_);
      best_.equilibria += choice.equilibria;
      if (!choice.equilibrium) return say("with clips no equilibrium was found");
      enough = std::max(enough, choice.enough);
      clip(choice);
      if (choice.missed_with_all > by_lengths) break;
    }
    if (enough > most && missed_at_rest(best_) > 0)
      say("of " + std::to_string(enough) + " clips that would help only " + std::to_string(most) + " are allowed");
  }
  void clip(const HarnessClips& choice) {
    HarnessResult clipped = best_;
    clipped.design = design_as_routed(best_);
    clipped.design.clips = choice.clips;
    settle(scene_, clipped, context_, choice.equilibrium.get());
    const HarnessDesign design = clipped.design;
    offer(clipped);
    if (choice.missed_with_all <= by_lengths && !context_.stop()) adjust(design, choice.equilibrium);
  }

  const Scene& scene_;
  HarnessResult& best_;
  const RunContext& context_;
  HarnessSurroundings around_;
  bool hopeless_ = false;
};

}  // namespace

double missed_at_rest(const HarnessResult& harness) {
  if (!harness.equilibrium || !harness.equilibrium->ok()) return std::numeric_limits<double>::infinity();
  return harness.missed_share;
}

bool refine(const Scene& scene, HarnessResult& harness, bool clips_first, const RunContext& context) {
  return HarnessRefinement(scene, harness, context).run(clips_first);
}

}  // namespace tendril::routing
