// The tolerance envelope of a study (thesis 3.3).
#pragma once

#include "method/envelope/envelope.h"
#include "method/variation/study.h"

namespace tendril::variation {

struct StudyEnvelope {
  Envelope envelope;
  int failed = 0;      ///< outcomes without an equilibrium: the envelope cannot contain them
  int jumped = 0;      ///< contained, though in another equilibrium than the nominal one's continuation
  double seconds_for_outcomes = 0;
};

/// Solves the outcomes of the study again, streaming them into an envelope; statuses as in Envelope. Throws UsageError where no
/// outcome has an equilibrium, and as EnvelopeBuilder does.
StudyEnvelope envelope_of(const Study& study, const EnvelopeOptions& options, EnvelopeBuilder& builder, const RunContext& context = {});

}  // namespace tendril::variation
