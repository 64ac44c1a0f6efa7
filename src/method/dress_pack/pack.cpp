#include "method/dress_pack/pack.h"

#include <set>

#include "base/error.h"
#include "base/number_text.h"

namespace tendril::dress_pack {
namespace {

std::string called(std::size_t k) { return "dress pack: attachment " + std::to_string(k); }

void check_one(const PackProblem& pack, std::size_t k) {
  const Attachment& a = pack.attachments[k];
  if (a.rod < 0 || a.rod >= static_cast<int>(pack.rods.size()))
    throw UsageError(called(k) + " names rod " + std::to_string(a.rod) + " of " + std::to_string(pack.rods.size()));
  const std::vector<Hold>& holds = pack.rods[a.rod].holds;
  if (a.hold < 0 || a.hold >= static_cast<int>(holds.size()))
    throw UsageError(called(k) + " names hold " + std::to_string(a.hold) + " of " + std::to_string(holds.size()));
  const int links = static_cast<int>(pack.robot->links().size());
  if (a.link < 0 || a.link >= links)
    throw UsageError(called(k) + " names link " + std::to_string(a.link) + " of " + std::to_string(links));
  if (!all_finite(a.in_link.at) || !all_finite(a.in_link.rotation.coeffs()))
    throw UsageError(called(k) + " has numbers that are not finite");
  if (std::abs(a.in_link.rotation.norm() - 1) > 1e-9)
    throw UsageError(called(k) + ": its rotation has the norm " + std::to_string(a.in_link.rotation.norm()) + ", expected 1");
}

void check_bodies(const PackProblem& pack) {
  Surroundings tried;
  const int links = static_cast<int>(pack.robot->links().size());
  for (std::size_t k = 0; k < pack.bodies.size(); ++k) {
    tried.add(pack.bodies[k].body);
    const int link = pack.bodies[k].link;
    if (link < -1 || link >= links)
      throw UsageError("dress pack: body " + std::to_string(k) + " is on link " + std::to_string(link) + " of " + std::to_string(links) +
                       "; expected -1 for a fixed one");
  }
}

}  // namespace

std::string PackProblem::rod_name(int rod) const {
  return rod < static_cast<int>(names.size()) ? names[rod] : "rod " + std::to_string(rod + 1);
}

std::string PackProblem::attachment_name(int attachment) const {
  const Attachment& a = attachments[attachment];
  const double at = rods[a.rod].holds[a.hold].at, length = rods[a.rod].rod.length;
  const std::string place = at == 0 ? "start" : at == length ? "finish" : number_text(at);
  return rod_name(a.rod) + "." + place;
}

void PackProblem::check() const {
  if (!robot) throw UsageError("dress pack: no robot");
  if (rods.empty()) throw UsageError("dress pack: no rods");
  if (attachments.empty()) throw UsageError("dress pack: nothing is attached to " + robot->name());
  if (!all_finite(base.at) || !all_finite(base.rotation.coeffs()) || std::abs(base.rotation.norm() - 1) > 1e-9)
    throw UsageError("dress pack: the robot's base has no proper frame");
  std::set<std::pair<int, int>> taken;
  for (std::size_t k = 0; k < attachments.size(); ++k) {
    check_one(*this, k);
    if (!taken.insert({attachments[k].rod, attachments[k].hold}).second)
      throw UsageError(called(k) + ": hold " + std::to_string(attachments[k].hold) + " of rod " + std::to_string(attachments[k].rod) +
                       " is attached already");
  }
  for (std::size_t k = 0; k < rods.size(); ++k) {
    rods[k].check();
    if (rods[k].surroundings)
      throw UsageError("dress pack: " + rod_name(static_cast<int>(k)) + " has surroundings of its own; expected none: give the pack its bodies");
    for (const PointLoad& load : rods[k].loads)
      if (!load.moment.isZero(0))
        throw UsageError("dress pack: rod " + std::to_string(k) + " carries a dead moment, expected forces alone");
  }
  check_bodies(*this);
}

void PackProblem::poses(const JointVector& q, std::vector<Frame>& out) const {
  const std::vector<Frame> links = robot->link_frames({q.data(), static_cast<std::size_t>(q.size())});
  out.resize(attachments.size());
  for (std::size_t k = 0; k < attachments.size(); ++k) {
    out[k] = base * (links[attachments[k].link] * attachments[k].in_link);
    out[k].rotation.normalize();
  }
}

std::vector<Frame> PackProblem::poses(const JointVector& q) const {
  std::vector<Frame> out;
  poses(q, out);
  return out;
}

void PackProblem::jacobian(const JointVector& q, Eigen::MatrixXd& out) const {
  const std::span<const double> values(q.data(), static_cast<std::size_t>(q.size()));
  Jacobian of_link(6, robot->size());
  out.resize(6 * static_cast<int>(attachments.size()), robot->size());
  for (std::size_t k = 0; k < attachments.size(); ++k) {
    const Attachment& a = attachments[k];
    const Frame link = robot->jacobian(a.link, values, of_link);
    const Mat3 turn = (base.rotation * link.rotation).toRotationMatrix();
    const Mat3 own = a.in_link.rotation.conjugate().toRotationMatrix(), arm = cross_matrix(a.in_link.at);
    for (int j = 0; j < robot->size(); ++j) {
      const Vec3 v = of_link.block<3, 1>(0, j), w = of_link.block<3, 1>(3, j);
      out.block<3, 1>(6 * static_cast<int>(k), j) = turn * (v - arm * w);
      out.block<3, 1>(6 * static_cast<int>(k) + 3, j) = own * w;
    }
  }
}

void PackProblem::place(const std::vector<Frame>& poses, SystemProblem& system) const {
  for (std::size_t k = 0; k < attachments.size(); ++k)
    system.rods[attachments[k].rod].holds[attachments[k].hold].frame = poses[k];
}

SystemProblem PackProblem::system_at(const JointVector& q) const {
  SystemProblem system{rods, {}};
  place(poses(q), system);
  return system;
}

bool PackProblem::slides() const {
  for (const RodProblem& rod : rods)
    for (const Hold& hold : rod.holds)
      if (hold.slide) return true;
  return false;
}

}  // namespace tendril::dress_pack
