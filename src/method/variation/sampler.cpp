#include "method/variation/sampler.h"

#include <algorithm>
#include <bit>

#include "base/error.h"
#include "method/variation/random_stream.h"
#include "method/variation/sobol.h"

namespace tendril::variation {
const char* name_of(Sampling sampling) {
  switch (sampling) {
    case Sampling::random: return "random";
    case Sampling::sobol: return "sobol";
    case Sampling::latin: return "latin";
  }
  return "";
}

/// Swap or not (Hoang, Morris and Rogaway, CRYPTO 2012): in every round the places are paired at random, and each pair is swapped
/// or not.
std::uint32_t shuffled(std::uint32_t index, std::uint32_t count, std::uint64_t seed) {
  const int rounds = 4 * std::bit_width(count) + 8;
  for (int round = 0; round < rounds; ++round) {
    const std::uint32_t sum = static_cast<std::uint32_t>((random_bits(seed, round, count) >> 32) * count >> 32);
    const std::uint32_t partner = sum >= index ? sum - index : sum + (count - index);
    if (random_bits(seed, round, std::uint64_t{1} << 32 | std::max(index, partner)) >> 63) index = partner;
  }
  return index;
}

Sampler::Sampler(Sampling sampling, std::uint64_t seed, int dimensions, int outcomes, int replicates)
    : sampling_(sampling), seed_(seed), outcomes_(outcomes), replicates_(replicates) {
  if (sampling == Sampling::random) return;
  if (sampling == Sampling::sobol && dimensions > sobol_dimensions)
    throw UsageError("method.variation: Sobol' points have at most " + std::to_string(sobol_dimensions) + " dimensions, got " +
                     std::to_string(dimensions) + "; use sampling = \"latin\" or \"random\"");
  if (replicates < 1 || replicates > outcomes / 2)
    throw UsageError("method.variation: got " + std::to_string(replicates) + " replicates of " + std::to_string(outcomes) +
                     " outcomes, expected 1 to " + std::to_string(outcomes / 2));
}

double Sampler::latin(int replicate, int point, int dimension) const {
  const std::uint64_t own = random_bits(seed_, replicate, dimension);
  const std::uint32_t count = (outcomes_ - replicate + replicates_ - 1) / replicates_;
  return (shuffled(point, count, own) + open_unit(mixed(own ^ mixed(point)))) / count;
}

double Sampler::at(int outcome, int dimension) const {
  if (sampling_ == Sampling::random) return open_unit(random_bits(seed_, outcome, dimension));
  const int replicate = outcome % replicates_, point = outcome / replicates_;
  if (sampling_ == Sampling::latin) return latin(replicate, point, dimension);
  const std::uint32_t x = owen_scrambled(sobol_bits(point, dimension), random_bits(seed_, replicate, dimension));
  return (x + 0.5) * 0x1p-32;
}

}  // namespace tendril::variation
