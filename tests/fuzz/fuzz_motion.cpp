// Motions sampled elsewhere: times that rise, frames that are frames, also between the samples.
#include <cmath>

#include "fuzz_target.h"
#include "scene/sampled_motion.h"

using namespace tendril;

namespace {

void expect_frame(const Frame& frame) {
  fuzz::expect(frame.at.allFinite() && std::abs(frame.rotation.norm() - 1) < 1e-6, "frames are finite and their rotations unit");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  SampledMotion motion;
  if (!fuzz::accepts("input", [&] { motion = parse_motion(fuzz::text_of(data, size), 1e-3, "input"); })) return 0;
  fuzz::expect(!motion.times.empty() && motion.times.size() == motion.frames.size(), "there is a frame for each time");
  for (std::size_t i = 0; i < motion.times.size(); ++i) {
    fuzz::expect(std::isfinite(motion.times[i]) && (i == 0 || motion.times[i] > motion.times[i - 1]), "times rise");
    expect_frame(motion.frames[i]);
    expect_frame(motion.at(motion.times[i]));
    if (i > 0) expect_frame(motion.at(motion.times[i - 1] + 0.5 * (motion.times[i] - motion.times[i - 1])));
  }
  return 0;
}
