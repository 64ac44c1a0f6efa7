// Variation simulation (thesis 2.3.2 and 3.3, Paper C): the equilibrium of a scene for many outcomes of its design variables.
//
// Every outcome is made from the nominal design and starts from its equilibrium, moved by the first-order change; rods that share
// SIMD lanes where batches know how (statics/batch.h). Near obstacles an outcome is first solved without contact; where it keeps
// clear of them, and so does the way from the nominal equilibrium, that is its equilibrium; else it is solved again with contact.
//
// Jumps. An outcome whose rods are farther from the first-order prediction than a quarter of the predicted move plus 2 % of the
// length, and from the second-order one (by way of the equilibrium half way) too, is followed from the nominal design in small
// steps: it counts as jumped where the rods snap on the way, else what the way leads to is its equilibrium.
//
// The same study, seed and outcome give the same bits whatever the number of threads, and whichever part of the outcomes is run.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/run_context.h"
#include "method/variation/contributors.h"
#include "method/variation/options.h"
#include "method/variation/outcomes.h"
#include "method/variation/statistics.h"
#include "scene/scene.h"

namespace tendril::variation {

/// One outcome as it passes by, in order. Views are valid during the call.
struct OutcomeView {
  int outcome = 0;
  OutcomeStatus status = OutcomeStatus::unsolved;
  std::span<const double> variables, measures, effects;
  std::string_view message;
  /// By rod of the scene: frames of its vertices, position (m) and quaternion w, x, y, z, seven numbers a vertex; empty where
  /// the outcome failed.
  std::span<const std::span<const double>> frames;
};
using OnOutcome = std::function<void(const OutcomeView&)>;

/// A study with everything checked and resolved, and the nominal equilibrium found.
class Study {
 public:
  /// Throws UsageError for names that do not exist (with the nearest), variables without anything that varies, contradictory
  /// ones, correlations that cannot be, tables of the wrong length, and a scene whose nominal equilibrium is not found or not
  /// stable.
  Study(const Scene& scene, Options options, const RunContext& context = {});
  /// About an equilibrium that is there already, solved and stable, with the options it was solved with.
  Study(const SceneEquilibrium& nominal, Options options, const RunContext& context = {});
  Study(Study&&) noexcept;
  ~Study();

  const Options& options() const;
  const SceneEquilibrium& nominal() const;
  const std::vector<Column>& variables() const;
  const std::vector<Column>& measures() const;
  const std::vector<std::string>& contributors() const;
  std::uint64_t seed() const;
  int effect_numbers() const;  ///< how many numbers of total effects a row has

  /// Solves outcomes first ... last - 1; parts of a study are put together by Outcomes::merged(). Stopped by the context it
  /// returns what is done, the rest unsolved; `on_outcome` is not called for those.
  Outcomes run(int first, int last, const OnOutcome& on_outcome = {}, const RunContext& context = {}) const;

  /// The variables of one outcome, without solving anything.
  std::vector<double> variables_of(int outcome) const;

  /// One outcome alone, as an equilibrium of the scene: what a measure's function was given. Its status tells failures.
  SceneEquilibrium equilibrium(int outcome, const RunContext& context = {}) const;

  /// Which variables are to blame for a measure's variance.
  Contributions contributions(const Outcomes& outcomes, int measure, const RunContext& context = {}) const;

  /// The measure's number. Throws UsageError with the nearest name.
  int measure(std::string_view name) const;
  Sample sample(const Outcomes& outcomes, int measure) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tendril::variation
