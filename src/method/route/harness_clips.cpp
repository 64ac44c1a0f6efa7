#include "method/route/harness_clips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "method/route/clip_places.h"

namespace tendril::routing {

namespace {

constexpr double same = 1e-6;             // slacks that differ by less
constexpr double certified = 1e-5;  // m

/// Which places of a harness lie between the same clips.
class Cells {
 public:
  Cells(const HarnessResult& harness, std::vector<HarnessClip> clips) : clips_(std::move(clips)) {
    std::vector<int> at_junction(harness.junctions.size(), -1);
    const auto join = [&](const HarnessEnd& end, int piece) {
      if (!end.junction) return;
      int& known = at_junction[end.number];
      if (known < 0) known = piece;
      else same_[root(piece)] = root(known);
    };
    std::size_t clip = 0;
    for (int b = 0; b < static_cast<int>(harness.branches.size()); ++b) {
      first_.push_back(static_cast<int>(same_.size()));
      begin_.push_back(clip);
      same_.push_back(static_cast<int>(same_.size()));
      for (; clip < clips_.size() && clips_[clip].branch == b; ++clip) same_.push_back(static_cast<int>(same_.size()));
      join(harness.branches[b].from, first_.back());
      join(harness.branches[b].to, static_cast<int>(same_.size()) - 1);
    }
    begin_.push_back(clips_.size());
  }
  int at(int branch, double s) const {
    int piece = first_[branch];
    for (std::size_t c = begin_[branch]; c < begin_[branch + 1] && clips_[c].at < s; ++c) ++piece;
    return root(piece);
  }
  /// Before and after a clip, by its number.
  std::array<int, 2> beside(std::size_t clip) const {
    const int b = clips_[clip].branch, piece = first_[b] + static_cast<int>(clip - begin_[b]);
    return {root(piece), root(piece + 1)};
  }
  int pieces() const { return static_cast<int>(same_.size()); }

 private:
  int root(int piece) const {
    while (same_[piece] != piece) piece = same_[piece];
    return piece;
  }
  std::vector<HarnessClip> clips_;
  std::vector<int> first_, same_;
  std::vector<std::size_t> begin_;
};

class Choice {
 public:
  Choice(const Scene& scene, const HarnessSurroundings& around, const HarnessResult& harness, const std::vector<HarnessClip>& places,
         double least, const RunContext& context)
      : scene_(scene), around_(around), harness_(harness), places_(places), least_(least), context_(context), as_routed_(design_as_routed(harness)) {}

  HarnessClips run(int most) {
    std::vector<int> all(places_.size());
    std::iota(all.begin(), all.end(), 0);
    if (auto first = looked_at(all, nullptr)) now_ = std::move(*first);
    else return ended(Status::stalled);
    needed_.assign(places_.size(), false);
    while (!context_.stop() && leave_out_some()) {}
    while (!context_.stop() && one_for_two()) {}
    const int enough = static_cast<int>(now_.chosen.size());
    while (!context_.stop() && static_cast<int>(now_.chosen.size()) > most && leave_out_least()) {}
    HarnessClips out = ended(Status::solved);
    out.enough = enough;
    return out;
  }

 private:
  /// The harness with some clips, at rest.
  struct Look {
    std::vector<int> chosen;                 ///< numbers of places, rising
    std::shared_ptr<const SceneEquilibrium> equilibrium;
    std::vector<HarnessModel::Place> missed; ///< where slacks are below the least
  };

  std::vector<HarnessClip> clips_of(const std::vector<int>& chosen) const {
    std::vector<HarnessClip> clips;
    for (const int k : chosen) clips.push_back(places_[k]);
    return clips;
  }
  std::optional<Look> looked_at(std::vector<int> chosen, const Look* from) {
    HarnessDesign design = as_routed_;
    design.clips = clips_of(chosen);
    const HarnessVariables variables(scene_, harness_, design);
    HarnessModel model(around_, harness_, variables, context_);
    if (from) model.begin_from(from->equilibrium);
    ++equilibria_;
    if (!model.evaluate(model.start()).valid) return std::nullopt;
    if (!from) missed_with_all_ = model.candidate().value.violation;
    return Look{std::move(chosen), model.candidate().equilibrium, model.tight_places(model.candidate(), least_)};
  }
  HarnessClips ended(Status status) const {
    HarnessClips out;
    out.status = context_.stop().value_or(status);
    out.clips = clips_of(now_.chosen);
    out.enough = static_cast<int>(out.clips.size());
    out.equilibrium = now_.equilibrium;
    out.missed_with_all = missed_with_all_;
    out.equilibria = equilibria_;
    return out;
  }

  /// By cell what the worst slack lacks, 0 where nothing is missed.
  std::vector<double> worst(const Look& look, const Cells& cells) const {
    std::vector<double> out(cells.pieces(), 0.0);
    for (const HarnessModel::Place& place : look.missed) {
      double& least = out[cells.at(place.branch, place.s)];
      least = std::min(least, place.slack - least_);
    }
    return out;
  }
  static std::vector<int> without(const std::vector<int>& chosen, const std::vector<int>& gone) {
    std::vector<int> rest;
    std::set_difference(chosen.begin(), chosen.end(), gone.begin(), gone.end(), std::back_inserter(rest));
    return rest;
  }

  /// Positions in now_.chosen of clips that may go, no two at one cell, those that bear least first taken.
  std::vector<int> dispensable(const Cells& cells) const {
    std::vector<std::pair<double, int>> by_force;
    for (std::size_t c = 0; c < now_.chosen.size(); ++c) {
      const HarnessClip& clip = places_[now_.chosen[c]];
      if (needed_[now_.chosen[c]]) continue;
      by_force.push_back({now_.equilibrium->reaction(now_.equilibrium->rods[clip.branch], clip.at).force.norm(), static_cast<int>(c)});
    }
    std::sort(by_force.begin(), by_force.end());
    std::vector<bool> taken(cells.pieces(), false);
    std::vector<int> out;
    for (const auto& [force, c] : by_force) {
      const auto [before, after] = cells.beside(c);
      if (taken[before] || taken[after]) continue;
      taken[before] = taken[after] = true;
      out.push_back(c);
    }
    return out;
  }

  /// False: all that are left are needed.
  bool leave_out_some() {
    const Cells cells(harness_, clips_of(now_.chosen));
    std::vector<int> tried = dispensable(cells);
    if (tried.empty()) return false;
    const std::vector<double> before = worst(now_, cells);
    for (; !tried.empty() && !context_.stop(); tried.resize(tried.size() / 2)) {
      std::vector<int> gone;
      for (const int c : tried) gone.push_back(now_.chosen[c]);
      std::sort(gone.begin(), gone.end());
      std::optional<Look> trial = looked_at(without(now_.chosen, gone), &now_);
      if (!trial && tried.size() == 1) needed_[gone.front()] = true;
      if (!trial) continue;
      const Cells merged(harness_, clips_of(trial->chosen));
      const std::vector<double> after = worst(*trial, merged);
      std::vector<int> fine, bad;
      for (const int c : tried) {
        const HarnessClip& clip = places_[now_.chosen[c]];
        const auto [a, b] = cells.beside(c);
        const bool keeps = after[merged.at(clip.branch, clip.at)] >= std::min(before[a], before[b]) - same;
        (keeps ? fine : bad).push_back(now_.chosen[c]);
      }
      for (const int k : bad) needed_[k] = true;
      if (fine.empty()) return true;
      std::sort(fine.begin(), fine.end());
      if (!bad.empty()) trial = looked_at(without(now_.chosen, fine), &now_);
      if (trial) now_ = std::move(*trial);
      else
        for (const int k : fine) needed_[k] = true;
      return true;
    }
    return true;
  }

  /// Between the neighbours of two clips the place nearest to their middle, in their stead. False: nowhere.
  bool one_for_two() {
    for (std::size_t c = 0; c + 1 < now_.chosen.size() && !context_.stop(); ++c) {
      const HarnessClip &one = places_[now_.chosen[c]], &two = places_[now_.chosen[c + 1]];
      if (one.branch != two.branch) continue;
      const bool first = c == 0 || places_[now_.chosen[c - 1]].branch != one.branch;
      const bool last = c + 2 == now_.chosen.size() || places_[now_.chosen[c + 2]].branch != one.branch;
      const double begin = first ? 0 : places_[now_.chosen[c - 1]].at;
      const double end = last ? harness_.branches[one.branch].length : places_[now_.chosen[c + 2]].at;
      int middle = -1;
      for (int k = 0; k < static_cast<int>(places_.size()); ++k)
        if (places_[k].branch == one.branch && places_[k].at > begin && places_[k].at < end &&
            (middle < 0 || std::abs(places_[k].at - 0.5 * (begin + end)) < std::abs(places_[middle].at - 0.5 * (begin + end))))
          middle = k;
      std::vector<int> chosen = without(now_.chosen, {now_.chosen[c], now_.chosen[c + 1]});
      chosen.insert(std::lower_bound(chosen.begin(), chosen.end(), middle), middle);
      std::optional<Look> trial = looked_at(std::move(chosen), &now_);
      if (!trial || share_missed(*trial) < share_missed(now_) - same) continue;
      now_ = std::move(*trial);
      return true;
    }
    return false;
  }
  /// The sum of the cells' worst slacks.
  double share_missed(const Look& look) const {
    const Cells cells(harness_, clips_of(look.chosen));
    const std::vector<double> by_cell = worst(look, cells);
    return std::accumulate(by_cell.begin(), by_cell.end(), 0.0);
  }

  /// More are there than allowed: the one goes without which least is missed. False: none can.
  bool leave_out_least() {
    std::optional<Look> best;
    for (const int k : now_.chosen) {
      if (context_.stop()) return false;
      std::optional<Look> trial = looked_at(without(now_.chosen, {k}), &now_);
      if (trial && (!best || share_missed(*trial) > share_missed(*best))) best = std::move(trial);
    }
    if (!best) return false;
    now_ = std::move(*best);
    return true;
  }

  const Scene& scene_;
  const HarnessSurroundings& around_;
  const HarnessResult& harness_;
  const std::vector<HarnessClip>& places_;
  double least_;
  const RunContext& context_;
  HarnessDesign as_routed_;
  Look now_;
  std::vector<bool> needed_;
  double missed_with_all_ = 0;
  int equilibria_ = 0;
};

}  // namespace

std::vector<HarnessClip> harness_clip_places(const HarnessSurroundings& around, const HarnessResult& harness) {
  const HarnessOptions& options = harness.options;
  const std::vector<PlacedObstacle>& obstacles = around.by_use.obstacles;
  // The route keeps its clearances, up to what its certificate leaves: not to be asked for once more.
  const double radius = options.section.radius() - certified, spacing = std::max(options.min_bend_radius, 6 * radius);
  Surroundings bare;
  for (PlacedObstacle obstacle : obstacles) {
    obstacle.body.clearance = 0;
    bare.add(obstacle.body);
  }
  const ClipSites sites{&bare, &obstacles, options.clip_reach};
  std::vector<HarnessClip> places;
  for (int b = 0; b < static_cast<int>(harness.branches.size()); ++b) {
    const Curve curve = harness.branches[b].points.curve();
    for (const Hold& hold : clip_places([&](double s) { return curve.at(s); }, curve.length(), radius, spacing, spacing, sites)) {
      std::pair<double, int> nearest{std::numeric_limits<double>::infinity(), -1};
      for (int k = 0; k < static_cast<int>(obstacles.size()); ++k) {
        const ClosestPoint closest = obstacles[k].clip ? bare.closest_on(k, hold.frame.at, options.clip_reach + 2 * radius) : ClosestPoint{};
        if (closest.obstacle >= 0 && obstacles[k].clip) nearest = std::min(nearest, {closest.distance, k});
      }
      places.push_back({b, hold.at, hold.at, hold.frame, nearest.second < 0 ? "" : obstacles[nearest.second].name, 0});
    }
  }
  return places;
}

HarnessClips fewest_harness_clips(const Scene& scene, const HarnessSurroundings& around, const HarnessResult& harness,
                        const std::vector<HarnessClip>& places, int most, double least, const RunContext& context) {
  return Choice(scene, around, harness, places, least, context).run(most);
}

}  // namespace tendril::routing
