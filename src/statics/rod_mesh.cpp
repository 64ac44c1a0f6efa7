#include "statics/rod_mesh.h"

#include <algorithm>
#include <cmath>

namespace tendril {
namespace {

/// `as_cut`: sliding sections where they were when the number of segments was chosen.
std::vector<double> breaks_of(const RodProblem& problem, const std::vector<double>& joined, bool as_cut) {
  const Rod& rod = problem.rod;
  std::vector<double> breaks = {0, rod.length};
  for (const Hold& hold : problem.holds) breaks.push_back(as_cut && hold.cut_at >= 0 ? hold.cut_at : hold.at);
  for (const PointLoad& load : problem.loads) breaks.push_back(load.at);
  for (const PoseSpring& spring : problem.springs) breaks.push_back(spring.at);
  for (const RodPart& part : rod.parts) breaks.push_back(part.upto);
  breaks.insert(breaks.end(), joined.begin(), joined.end());
  // Vertices that a sliding section met, or passed, would change how many there are: what lies between its stops moves with it.
  const bool slides = std::any_of(problem.holds.begin(), problem.holds.end(), [](const Hold& hold) { return hold.slide; });
  if (!slides) breaks.insert(breaks.end(), rod.shape_breaks.begin(), rod.shape_breaks.end());
  for (double& place : breaks) place = std::clamp(place, 0.0, rod.length);
  std::sort(breaks.begin(), breaks.end());
  // Places closer than this are one place: a shorter segment would only spoil the conditioning.
  const double same = 1e-9 * rod.length;
  std::vector<double> distinct = {0};
  for (const double place : breaks)
    if (place > distinct.back() + same) distinct.push_back(place);
  distinct.back() = rod.length;
  return distinct;
}

int vertex_at(const std::vector<double>& s, double place) {
  const auto above = std::lower_bound(s.begin(), s.end(), place);
  if (above == s.begin()) return 0;
  if (above == s.end()) return static_cast<int>(s.size()) - 1;
  const auto below = above - 1;
  return static_cast<int>((place - *below < *above - place ? below : above) - s.begin());
}

}  // namespace

RodMesh cut_into_segments(const RodProblem& problem, int segments, int refinement, const std::vector<double>& joined) {
  const Rod& rod = problem.rod;
  const std::vector<double> breaks = breaks_of(problem, joined, false);
  std::vector<double> as_cut = breaks_of(problem, joined, true);
  if (as_cut.size() != breaks.size()) as_cut = breaks;
  RodMesh mesh;
  mesh.s.reserve((segments + breaks.size()) * refinement);
  mesh.s.push_back(0);
  for (std::size_t k = 1; k < breaks.size(); ++k) {
    const double from = breaks[k - 1], to = breaks[k];
    const int count =
        refinement * std::max(1, static_cast<int>(std::lround(segments * (as_cut[k] - as_cut[k - 1]) / rod.length)));
    for (int i = 1; i <= count; ++i) mesh.s.push_back(i == count ? to : from + (to - from) * i / count);
  }
  mesh.segments.resize(mesh.s.size() - 1);
  Frame before = rod.shape ? rod.shape(0) : Frame{};
  for (std::size_t i = 0; i + 1 < mesh.s.size(); ++i) {
    MeshSegment& segment = mesh.segments[i];
    segment.start = mesh.s[i];
    segment.length = mesh.s[i + 1] - mesh.s[i];
    segment.section = rod.section_at(0.5 * (mesh.s[i] + mesh.s[i + 1]));
    segment.reference.at = {0, 0, segment.length};
    segment.to_middle = Quat::Identity();
    if (rod.shape) {
      const Frame after = rod.shape(mesh.s[i + 1]);
      segment.reference = before.inverse() * after;
      segment.to_middle = before.rotation.conjugate() * rod.shape(mesh.s[i] + 0.5 * segment.length).rotation;
      before = after;
    }
  }
  for (const Hold& hold : problem.holds) mesh.hold_vertex.push_back(vertex_at(mesh.s, hold.at));
  for (const PointLoad& load : problem.loads) mesh.load_vertex.push_back(vertex_at(mesh.s, load.at));
  for (const PoseSpring& spring : problem.springs) mesh.spring_vertex.push_back(vertex_at(mesh.s, spring.at));
  for (const double place : joined) mesh.joint_vertex.push_back(vertex_at(mesh.s, place));
  return mesh;
}

}  // namespace tendril
