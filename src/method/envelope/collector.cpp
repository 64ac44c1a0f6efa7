#include "method/envelope/collector.h"

#include <algorithm>

namespace tendril {
namespace {

constexpr int block = 512;  // outcomes that wait: enough for whole SIMD lanes, little beside what is kept

std::vector<double> frames_of(const SolvedRod& rod) {
  std::vector<double> frames;
  const Equilibrium& eq = rod.equilibrium;
  frames.reserve(7 * eq.points.size());
  for (std::size_t v = 0; v < eq.points.size(); ++v) {
    const Vec3& p = eq.points[v];
    const Quat& q = eq.rotations[v];
    frames.insert(frames.end(), {p.x(), p.y(), p.z(), q.w(), q.x(), q.y(), q.z()});
  }
  return frames;
}

std::vector<EnvelopeRod> rods_of(const SceneEquilibrium& nominal, double voxel) {
  std::vector<EnvelopeRod> rods;
  for (const SolvedRod& solved : nominal.rods) {
    EnvelopeRod& rod = rods.emplace_back();
    const std::vector<double>& s = solved.equilibrium.s;
    for (std::size_t i = 0; i + 1 < s.size(); ++i)
      rod.radii.push_back(solved.problem.rod.section_at(0.5 * (s[i] + s[i + 1])).radius());
    rod.pieces = arc_pieces(frames_of(solved), voxel / 20);
  }
  return rods;
}

}  // namespace

EnvelopeCollector::EnvelopeCollector(const SceneEquilibrium& nominal, double voxel, EnvelopeOutcomes::Keep keep)
    : outcomes_(rods_of(nominal, voxel), keep), waiting_(nominal.rods.size()) {}

Status EnvelopeCollector::add(std::span<const std::span<const double>> frames, const RunContext& context) {
  for (std::size_t k = 0; k < waiting_.size(); ++k) waiting_[k].insert(waiting_[k].end(), frames[k].begin(), frames[k].end());
  return ++count_ < block ? Status::solved : finish(context);
}

Status EnvelopeCollector::add(const SceneEquilibrium& outcome, const RunContext& context) {
  std::vector<std::vector<double>> frames;
  for (const SolvedRod& rod : outcome.rods) frames.push_back(frames_of(rod));
  const std::vector<std::span<const double>> views(frames.begin(), frames.end());
  return add(views, context);
}

Status EnvelopeCollector::finish(const RunContext& context) {
  if (count_ == 0) return Status::solved;
  const Status status = outcomes_.add_frames(count_, [&](int outcome, int rod) {
    const std::size_t width = waiting_[rod].size() / count_;
    return std::span<const double>(waiting_[rod]).subspan(outcome * width, width);
  }, context);
  for (std::vector<double>& frames : waiting_) frames.clear();
  count_ = 0;
  return status;
}

EnvelopeOutcomes swept_space(std::span<const std::shared_ptr<SceneEquilibrium>> states, double voxel, const RunContext& context, Status& status) {
  const std::size_t ways = std::max<std::size_t>(1, states.size() - 1), rods = states.front()->rods.size();
  std::vector<EnvelopeRod> pieces;
  std::vector<std::vector<double>> frames;  // by state and rod
  for (const auto& state : states)
    for (const SolvedRod& rod : state->rods) frames.push_back(frames_of(rod));
  for (std::size_t way = 0; way < ways; ++way)
    for (EnvelopeRod& rod : rods_of(*states[way], voxel)) pieces.push_back(std::move(rod));
  EnvelopeOutcomes outcomes(std::move(pieces));
  // Two outcomes: where each way begins, and where it ends.
  status = outcomes.add_frames(2, [&](int outcome, int piece) {
    const std::size_t way = piece / rods, state = std::min(way + outcome, states.size() - 1);
    return std::span<const double>(frames[state * rods + piece % rods]);
  }, context);
  return outcomes;
}

}  // namespace tendril
