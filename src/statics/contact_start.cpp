#include "statics/contact_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/units.h"
#include "statics/contact_detour.h"
#include "statics/first_guess.h"
#include "statics/network_guess.h"

namespace tendril {

namespace {

/// How the held spans of a guess differ from the usual ones: share of the slack that is let out, and turn of the bulge
/// about the chord (degrees).
struct SpanVariant {
  double slack, turn;
};
constexpr std::array<SpanVariant, 18> span_variants{
    // What hangs comes before what stands: a rod that arches over something would stay there.
    {{1, 0},    {1, 45},   {1, -45},  {1, 90},    {1, -90}, {0.7, 0},   {0.4, 0},   {0.15, 0},   {0.4, 90},
     {0.4, -90}, {1, 135}, {1, -135}, {1, 180},   {0.4, 180}, {0, 0},   {0.15, 90}, {0.15, -90}, {0.15, 180}}};

constexpr int most_detours = 4;  // one after the other

/// How free ends differ: curled by so much in all (degrees), away from gravity turned by `turn` about the tangent.
struct TailVariant {
  double curl, turn;
};
constexpr std::array<TailVariant, 12> tail_variants{{{60, 0},
                                                     {120, 0},
                                                     {60, 90},
                                                     {60, -90},
                                                     {180, 0},
                                                     {120, 90},
                                                     {120, -90},
                                                     {270, 0},
                                                     {60, 180},
                                                     {270, 90},
                                                     {270, -90},
                                                     {120, 180}}};

/// The straight way from held place to held place: the shortest that the rod could be.
struct Chord {
  double length = 0;  ///< m, summed over the spans
  double held = 0;    ///< m of rod between the first and the last held place
  Vec3 along = Vec3::Zero();
};

Chord chord_of(const RodProblem& problem) {
  std::vector<std::pair<double, Vec3>> places;
  for (const Hold& hold : problem.holds)
    if (hold.position) places.push_back({hold.at, hold.frame.at});
  std::sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Chord chord;
  for (std::size_t k = 1; k < places.size(); ++k) chord.length += (places[k].second - places[k - 1].second).norm();
  if (places.size() < 2) return chord;
  chord.held = places.back().first - places.front().first;
  const Vec3 way = places.back().second - places.front().second;
  if (way.norm() > 0) chord.along = way.normalized();
  return chord;
}

std::vector<Frame> guess(RodProblem problem, RodMesh mesh, const Chord& chord, const SpanVariant& variant) {
  problem.rod.shape = nullptr;  // a preformed rod is guessed as if straight once its own shape is in the way
  if (variant.turn != 0) {
    // Without gravity the bulge has no preferred side to be turned from.
    const Vec3 down = problem.gravity.isZero(0) ? Vec3(chord.along.unitOrthogonal()) : problem.gravity;
    problem.gravity = Eigen::AngleAxisd(variant.turn * units::deg, chord.along) * down;
  }
  if (variant.slack < 1) {
    const double shortest = std::min(1.0, chord.length / chord.held);
    const double share = shortest + (1 - shortest) * variant.slack * variant.slack;
    for (double& s : mesh.s) s *= share;
  }
  return first_guess(problem, mesh);
}

/// Rotation of one step of a curl: about the axis that leads the tangent of `frame` towards `side`.
Vec3 curl_axis(const Frame& frame, const Vec3& up, double turn, double sign) {
  const Vec3 tangent = sign * frame.d3();
  Vec3 side = up - tangent * tangent.dot(up);
  if (side.norm() < 1e-3) side = frame.d1();
  side = Eigen::AngleAxisd(turn * units::deg, tangent) * side.normalized();
  return sign * (frame.rotation.conjugate() * tangent.cross(side));
}

/// Replaces the free ends of a guess by arcs.
void curl_tails(const RodProblem& problem, const RodMesh& mesh, const TailVariant& variant, std::vector<Frame>& frames) {
  const auto [first, last] = std::minmax_element(mesh.hold_vertex.begin(), mesh.hold_vertex.end());
  const Vec3 up = problem.gravity.isZero(0) ? Vec3::UnitZ() : Vec3(-problem.gravity.normalized());
  const int n = mesh.vertices();
  if (*last < n - 1) {
    const double angle = variant.curl * units::deg / (mesh.s[n - 1] - mesh.s[*last]);
    const Vec3 axis = curl_axis(frames[*last], up, variant.turn, 1);
    for (int i = *last; i + 1 < n; ++i) {
      const Vec3 half = 0.5 * angle * mesh.segments[i].length * axis;
      const Frame turned{Vec3::Zero(), exp_rotation(half)};
      frames[i + 1] = frames[i] * turned * mesh.segments[i].reference * turned;
    }
  }
  if (*first > 0) {
    const double angle = variant.curl * units::deg / (mesh.s[*first] - mesh.s[0]);
    const Vec3 axis = curl_axis(frames[*first], up, variant.turn, -1);
    for (int i = *first - 1; i >= 0; --i) {
      const Vec3 half = -0.5 * angle * mesh.segments[i].length * axis;
      const Frame turned{Vec3::Zero(), exp_rotation(-half)};
      frames[i] = frames[i + 1] * turned * mesh.segments[i].reference.inverse() * turned;
    }
  }
}

/// The best guess so far of one rod of a network.
class Search {
 public:
  Search(const RodNetwork& network, NetworkGuess& guess, int rod, ContactTerms& terms, ContactStart& out)
      : network_(network), guess_(guess), rod_(rod), terms_(terms), out_(out), fewest_(crossings_of(guess.rods[rod])) {}

  bool done() const { return fewest_ == 0; }
  const std::vector<Frame>& best() const { return guess_.rods[rod_]; }

  /// Where the frames first cross a surface.
  std::optional<CrossingPlace> first_crossing(const std::vector<Frame>& frames) {
    crossings_of(frames);
    const ContactSet& set = terms_.set();
    for (const int i : terms_.guard().crossings())
      if (const auto hit = set.field_after(i).ray(set.positions()[i], set.positions()[i + 1]))
        return CrossingPlace{set.points()[i].s, hit->point, hit->normal};
    return std::nullopt;
  }

  /// Keeps, of all ways around what `base` crosses first, the one with the fewest crossings left; of several, that which
  /// suits the length best.
  bool consider_detours(const std::vector<Frame>& base, const RodMesh& mesh) {
    const auto crossing = first_crossing(base);
    if (!crossing) return false;
    const CrossedShape shape{base, mesh.s, mesh.hold_vertex, terms_.set().points().front().radius};
    const std::vector<Frame>* best = nullptr;
    const auto ways = detours(shape, *crossing, terms_.set().field());
    double misfit = std::numeric_limits<double>::infinity();
    for (const std::vector<Frame>& way : ways) {
      const int crossings = crossings_of(way);
      const double by = std::abs(length_of(way) - mesh.s.back());
      if (crossings > fewest_ || (crossings == fewest_ && by >= misfit)) continue;
      best = &way;
      fewest_ = crossings;
      misfit = by;
    }
    if (best) guess_.rods[rod_] = *best;
    return best != nullptr;
  }
  int fewest() const { return fewest_; }

  /// Keeps the frames when they cross less.
  bool consider(const std::vector<Frame>& frames) {
    const int crossings = crossings_of(frames);
    if (crossings >= fewest_) return false;
    guess_.rods[rod_] = frames;
    fewest_ = crossings;
    return true;
  }

 private:
  int crossings_of(const std::vector<Frame>& frames) {
    ++out_.tried;
    std::vector<Frame> before = frames;
    guess_.rods[rod_].swap(before);
    terms_.stand_at(network_.state_from(guess_.rods, guess_.branches));
    guess_.rods[rod_].swap(before);
    return static_cast<int>(terms_.guard().crossings().size());
  }

  const RodNetwork& network_;
  NetworkGuess& guess_;
  int rod_;
  ContactTerms& terms_;
  ContactStart& out_;
  int fewest_;
};

/// Around one thing after the other.
void lead_around(const RodMesh& mesh, Search& search) {
  for (int k = 0; k < most_detours && !search.done(); ++k)
    if (!search.consider_detours(search.best(), mesh)) return;
}

void clear_rod(const RodProblem& problem, const RodMesh& mesh, const std::vector<Frame>& usual, Search& search) {
  if (search.done() || mesh.hold_vertex.empty()) return;
  const Chord chord = chord_of(problem);
  const bool spans_vary = chord.held > 0 && !chord.along.isZero(0);
  std::vector<Frame> frames = usual;
  for (std::size_t k = 1; spans_vary && k < span_variants.size() && !search.done(); ++k) {
    std::vector<Frame> other = guess(problem, mesh, chord, span_variants[k]);
    if (search.consider(other)) frames = std::move(other);
  }
  const auto [first, last] = std::minmax_element(mesh.hold_vertex.begin(), mesh.hold_vertex.end());
  const bool tails = *first > 0 || *last < mesh.vertices() - 1;
  for (std::size_t k = 0; tails && k < tail_variants.size() && !search.done(); ++k) {
    std::vector<Frame> other = frames;
    curl_tails(problem, mesh, tail_variants[k], other);
    search.consider(other);
  }
  // The less a rod sags the more length is left for a way around.
  if (!search.done()) search.consider_detours(usual, mesh);
  for (const SpanVariant& variant : {SpanVariant{0.4, 0}, SpanVariant{0, 0}})
    if (spans_vary && !search.done()) search.consider_detours(guess(problem, mesh, chord, variant), mesh);
  lead_around(mesh, search);
}

/// The frames of a state, by rod and branch point.
NetworkGuess guess_of(const RodNetwork& network, const RodState& state) {
  NetworkGuess guess;
  for (int k = 0; k < network.rods(); ++k) guess.rods.push_back(network.rod(k).frames_of(network.of_rod(k, state)));
  for (std::size_t b = 0; b < network.problem().branches.size(); ++b)
    guess.branches.push_back(network.branch_frame(static_cast<int>(b), state));
  return guess;
}

}  // namespace

ContactStart clear_start(const RodNetwork& network, ContactNetwork& contact, const RodState* near) {
  ContactStart out;
  NetworkGuess guess = near ? guess_of(network, *near) : network_guess(network);
  for (const ContactNetwork::Rod& rod : contact.rods()) {
    RodProblem problem = network.rod(rod.index).problem();
    RodMesh mesh = network.rod(rod.index).mesh();
    hold_at_branches(network, guess, rod.index, problem, mesh);
    const std::vector<Frame> usual = guess.rods[rod.index];
    Search search(network, guess, rod.index, *rod.terms, out);
    if (near) lead_around(mesh, search);
    clear_rod(problem, mesh, usual, search);
    out.crossings += search.fewest();
  }
  out.state = network.state_from(guess.rods, guess.branches);
  return out;
}

}  // namespace tendril
