#include "method/variation/fingerprint.h"

#include <cstdint>
#include <cstdio>

namespace tendril::variation {
namespace {

/// FNV-1a over everything that goes in, bit by bit.
class Digest {
 public:
  void add_bytes(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) value_ = (value_ ^ bytes[i]) * 1099511628211ull;
  }
  void add(double value) { add_bytes(&value, sizeof value); }
  void add(std::size_t value) { add_bytes(&value, sizeof value); }
  void add(int value) { add(static_cast<double>(value)); }
  void add(bool value) { add(static_cast<double>(value)); }
  void add(const Vec3& v) { add_bytes(v.data(), 3 * sizeof(double)); }
  void add(const Frame& frame) {
    add(frame.at);
    add_bytes(frame.rotation.coeffs().data(), 4 * sizeof(double));
  }
  void add(const std::string& text) { add_bytes(text.data(), text.size() + 1); }
  std::string text() const {
    char out[17];
    std::snprintf(out, sizeof out, "%016llx", static_cast<unsigned long long>(value_));
    return out;
  }

 private:
  std::uint64_t value_ = 14695981039346656037ull;
};

void add_rod(const RodProblem& problem, Digest& digest) {
  const Rod& rod = problem.rod;
  digest.add(rod.length);
  digest.add(rod.segments);
  for (const RodPart& part : rod.parts) {
    const Section& s = part.section;
    for (const double value : {part.upto, s.EA, s.GA1, s.GA2, s.EI1, s.EI2, s.GJ, s.mass, s.outer, s.inner}) digest.add(value);
  }
  constexpr int samples = 32;
  for (int i = 0; rod.shape && i <= samples; ++i) digest.add(rod.shape(rod.length * i / samples));
  for (const Hold& hold : problem.holds) {
    digest.add(hold.frame);
    for (const double value : {hold.at, double(hold.position), double(hold.orientation), hold.turns, double(hold.slide)}) digest.add(value);
  }
  for (const PointLoad& load : problem.loads) {
    digest.add(load.at);
    digest.add(load.force);
    digest.add(load.moment);
  }
  digest.add(problem.gravity);
}

void add_obstacle(const PlacedObstacle& obstacle, Digest& digest) {
  digest.add(obstacle.name);
  digest.add(obstacle.body.pose);
  if (const auto* surface = std::get_if<std::shared_ptr<const TriangleSurface>>(&obstacle.body.shape)) {
    const Mesh& mesh = (*surface)->mesh();
    digest.add_bytes(mesh.vertices.data(), mesh.vertices.size() * sizeof mesh.vertices.front());
    digest.add_bytes(mesh.triangles.data(), mesh.triangles.size() * sizeof mesh.triangles.front());
  } else {
    const Solid& solid = std::get<Solid>(obstacle.body.shape);
    digest.add(solid.index());
    const Eigen::AlignedBox3d box = box_of(solid);
    digest.add(Vec3(box.min()));
    digest.add(Vec3(box.max()));
  }
}

void add_variable(const Variable& v, Digest& digest) {
  digest.add(v.name);
  for (const std::optional<double>& value : {v.tolerance, v.ball, v.cone, v.twist, v.sigma}) digest.add(value.value_or(-1));
  digest.add(v.box.value_or(Vec3(-1, -1, -1)));
  digest.add(v.relative);
  digest.add(v.spread ? static_cast<int>(*v.spread) : -1);
  for (const double value : v.numbers) digest.add(value);
  for (const Frame& frame : v.frames) digest.add(frame);
}

}  // namespace

std::string fingerprint(const Study& study) {
  Digest digest;
  const Options& options = study.options();
  for (const SolvedSystem& system : study.nominal().systems) {
    for (const RodProblem& rod : system.problem.rods) add_rod(rod, digest);
    for (const BranchPoint& branch : system.problem.branches) {
      digest.add(branch.frame);
      for (const double value : {double(branch.position), double(branch.orientation)}) digest.add(value);
      for (const JoinedSection& section : branch.sections) {
        digest.add(section.rod);
        digest.add(section.at);
        digest.add(section.relative);
      }
    }
  }
  for (const SolvedRod& rod : study.nominal().rods) digest.add(rod.name);
  for (const PlacedObstacle& obstacle : study.nominal().obstacles) add_obstacle(obstacle, digest);
  for (const Variable& variable : options.vary) add_variable(variable, digest);
  for (const Group& group : options.groups) {
    for (const std::string& name : group.variables) digest.add(name);
    digest.add_bytes(group.correlation.data(), group.correlation.size() * sizeof(double));
  }
  for (const double value : {double(options.outcomes), double(options.replicates), double(options.uniform), double(options.effects),
                             double(options.solve.element), options.solve.tolerance})
    digest.add(value);
  return digest.text();
}

}  // namespace tendril::variation
