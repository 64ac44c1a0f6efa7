#include "method/envelope/share.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "base/units.h"

namespace tendril::envelope {
namespace {

constexpr int score_pairs = 16;  // each stands for two opposite directions

Vec3 score_direction(int k) {
  const double height = (k + 0.5) / score_pairs, radius = std::sqrt(1 - height * height);
  const double angle = units::pi * (3 - std::sqrt(5.0)) * k;
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

/// Raises the scores by what one node shows in one direction.
void score(const PointArrays& places, int count, const Vec3& direction, double least, std::vector<float>& along,
           float* scores) {
  const Eigen::Vector3f d = direction.cast<float>();
  along.resize(count);
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) along[i] = d.x() * places.x[i] + d.y() * places.y[i] + d.z() * places.z[i];
  for (int i = 0; i < count; ++i) sum += along[i];
  const double mean = sum / count;
  for (int i = 0; i < count; ++i) squares += (along[i] - mean) * (along[i] - mean);
  const double deviation = std::sqrt(squares / count);
  if (!(deviation > least)) return;
  const float middle = static_cast<float>(mean), scale = static_cast<float>(1 / deviation);
  for (int i = 0; i < count; ++i) scores[i] = std::max(scores[i], scale * std::abs(along[i] - middle));
}

}  // namespace

std::vector<float> outcome_scores(const EnvelopeOutcomes& outcomes, const RunContext& context) {
  double thinnest = INFINITY;
  for (const EnvelopeRod& rod : outcomes.rods())
    for (const double radius : rod.radii) thinnest = std::min(thinnest, radius);
  const int workers = std::max(1, std::min(thread_count(context.threads), outcomes.nodes() / 8));
  std::vector<std::vector<float>> found(workers, std::vector<float>(outcomes.size(), 0.0f));
  std::atomic<int> next = 0;
  run_workers(workers, [&](int worker) {
    std::vector<float> along;
    for (int node; (node = next++) < outcomes.nodes() && !context.stop();)
      for (int k = 0; k < score_pairs; ++k)
        score(outcomes.places(node), outcomes.place_count(node), score_direction(k), 1e-4 * thinnest, along,
              found[worker].data());
  });
  for (int w = 1; w < workers; ++w)
    for (int i = 0; i < outcomes.size(); ++i) found[0][i] = std::max(found[0][i], found[w][i]);
  return found[0];
}

std::vector<int> most_usual(const std::vector<float>& scores, double share) {
  std::vector<int> order(scores.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return scores[a] != scores[b] ? scores[a] < scores[b] : a < b; });
  // A share that is a whole number of outcomes but for rounding means that number.
  const double wanted = std::ceil(share * static_cast<double>(scores.size()) - 1e-6);
  order.resize(std::clamp<std::size_t>(static_cast<std::size_t>(wanted), 1, scores.size()));
  std::sort(order.begin(), order.end());
  return order;
}

}  // namespace tendril::envelope
