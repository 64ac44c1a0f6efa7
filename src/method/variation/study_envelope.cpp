#include "method/variation/study_envelope.h"

#include <chrono>

#include "base/error.h"
#include "method/envelope/collector.h"

namespace tendril::variation {

StudyEnvelope envelope_of(const Study& study, const EnvelopeOptions& options, EnvelopeBuilder& builder, const RunContext& context) {
  const auto start = std::chrono::steady_clock::now();
  StudyEnvelope out;
  const bool all = options.share < 1;
  EnvelopeCollector collector(study.nominal(), options.voxel, all ? EnvelopeOutcomes::Keep::all : EnvelopeOutcomes::Keep::hull);
  Status status = Status::solved;
  const Outcomes outcomes = study.run(0, study.options().outcomes, [&](const OutcomeView& outcome) {
    if (outcome.status != OutcomeStatus::failed && status == Status::solved) status = collector.add(outcome.frames, context);
  }, context);
  if (status == Status::solved) status = collector.finish(context);
  if (outcomes.count(OutcomeStatus::unsolved) > 0) status = context.stop().value_or(Status::cancelled);
  out.failed = outcomes.count(OutcomeStatus::failed);
  out.jumped = outcomes.count(OutcomeStatus::jumped);
  out.seconds_for_outcomes = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  out.envelope.status = status;
  if (status != Status::solved) return out;
  if (collector.outcomes().size() == 0)
    throw UsageError("variation:envelope: none of the " + std::to_string(outcomes.size()) + " outcomes has an equilibrium");
  builder.build(collector.outcomes(), options, context, out.envelope);
  return out;
}

}  // namespace tendril::variation
