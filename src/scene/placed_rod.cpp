#include "scene/placed_rod.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"

namespace tendril {
namespace {

constexpr double same_place = 1e-9;  // of the length: two holds nearer than this are at one place
constexpr double same_angle = 1e-9;  // rad

std::string vector(const Vec3& v) { return "{" + number_text(v.x()) + ", " + number_text(v.y()) + ", " + number_text(v.z()) + "}"; }

double angle_between(const Quat& a, const Quat& b) { return log_rotation(a.conjugate() * b).norm(); }

}  // namespace

PlacedRod::PlacedRod(std::string name, Rod rod, const std::optional<Frame>& from, const std::optional<Frame>& to)
    : name_(std::move(name)), rod_(std::move(rod)) {
  if (name_.empty()) throw UsageError("scene:rod: the name is empty, expected a word");
  rod_.check();
  if (from) hold({0, *from});
  if (to) hold({rod_.length, *to});
}

double PlacedRod::place(std::string_view end) const {
  if (end == "start") return 0;
  if (end == "finish") return rod_.length;
  throw UsageError("rod '" + name_ + "': unknown place '" + std::string(end) +
                   "', expected \"start\", \"finish\" or an arc length in m");
}

std::string PlacedRod::describe(double at) const {
  if (at <= 0) return "its start";
  if (at >= rod_.length) return "its finish";
  return number_text(at) + " m";
}

void PlacedRod::check_place(const char* who, double at) const {
  if (!std::isfinite(at) || at < 0 || at > rod_.length)
    throw UsageError(std::string(who) + ": the place on '" + name_ + "' is " + number_text(at) + " m, expected 0 to " +
                     number_text(rod_.length) + " m (its length)");
}

std::vector<Hold>::iterator PlacedRod::find(double at) {
  return std::find_if(holds_.begin(), holds_.end(),
                      [&](const Hold& h) { return std::abs(h.at - at) <= same_place * rod_.length; });
}

const Hold* PlacedRod::hold_at(double at) const {
  const auto found = const_cast<PlacedRod*>(this)->find(at);
  return found == holds_.end() ? nullptr : &*found;
}

void PlacedRod::check_hold(const Hold& wanted) const {
  check_place("placed_rod:hold", wanted.at);
  if (!all_finite(wanted.frame.at) || !all_finite(wanted.frame.rotation.coeffs()))
    throw UsageError("placed_rod:hold: the frame for '" + name_ + "' at " + describe(wanted.at) + " has numbers that are not finite");
  if (!std::isfinite(wanted.turns)) throw UsageError("placed_rod:hold: 'turns' is not a finite number");
  if (!wanted.position && !wanted.orientation)
    throw UsageError("placed_rod:hold: neither position nor orientation of '" + name_ + "' at " + describe(wanted.at) +
                     " is held; use release to remove a hold");
  if (wanted.slide && (wanted.at <= same_place * rod_.length || wanted.at >= (1 - same_place) * rod_.length))
    throw UsageError("placed_rod:clip: '" + name_ + "' cannot slide through a clip at " + describe(wanted.at) +
                     "; give the arc length inside the rod where the search shall begin");
}

void PlacedRod::hold(const Hold& wanted) {
  check_hold(wanted);
  if (const Attachment* attached = attachment_at(wanted.at))
    throw UsageError("placed_rod:hold: '" + name_ + "' is attached to '" + attached->robot + "' at " + describe(wanted.at) +
                     "; release it there first");
  const auto old = find(wanted.at);
  if (old == holds_.end()) {
    holds_.push_back(wanted);
    return;
  }
  if (old->position && wanted.position && (old->frame.at - wanted.frame.at).norm() > same_place * rod_.length)
    throw UsageError("placed_rod:hold: contradictory holds: '" + name_ + "' is already held at " + describe(wanted.at) +
                     " in position " + vector(old->frame.at) + ", got " + vector(wanted.frame.at) +
                     "; release it there first");
  const double turn = angle_between(old->frame.rotation, wanted.frame.rotation);
  if (old->orientation && wanted.orientation && turn > same_angle)
    throw UsageError("placed_rod:hold: contradictory holds: '" + name_ + "' is already held at " + describe(wanted.at) +
                     " in an orientation that differs by " + number_text(turn / units::deg) +
                     " degrees; release it there first");
  Hold merged = wanted;
  const bool complementary = old->position != wanted.position && old->orientation != wanted.orientation;
  if (complementary) {
    merged.position = merged.orientation = true;
    if (old->position) merged.frame.at = old->frame.at;
    if (old->orientation) {
      merged.frame.rotation = old->frame.rotation;
      merged.turns = old->turns;
    }
  }
  *old = merged;
}

void PlacedRod::release(double at) {
  check_place("placed_rod:release", at);
  const auto found = find(at);
  if (found == holds_.end()) throw UsageError("placed_rod:release: '" + name_ + "' is not held at " + describe(at));
  holds_.erase(found);
  std::erase_if(attachments_, [&](const Attachment& a) { return std::abs(a.at - at) <= same_place * rod_.length; });
}

void PlacedRod::attach(const Attachment& attachment, const Frame& frame) {
  const Hold hold{attachment.at, frame, attachment.position, attachment.orientation, attachment.turns, attachment.slide};
  check_hold(hold);
  if (const Attachment* there = attachment_at(attachment.at))
    throw UsageError("scene:attach: '" + name_ + "' is attached to '" + there->robot + "' at " + describe(there->at) +
                     " already; release it there first");
  if (hold_at(attachment.at))
    throw UsageError("scene:attach: '" + name_ + "' is held at " + describe(attachment.at) + " already; release it there first");
  holds_.push_back(hold);
  attachments_.push_back(attachment);
}

const Attachment* PlacedRod::attachment_at(double at) const {
  for (const Attachment& a : attachments_)
    if (std::abs(a.at - at) <= same_place * rod_.length) return &a;
  return nullptr;
}

void PlacedRod::follow(const std::string& robot, const std::function<Frame(int link)>& link_frame) {
  for (const Attachment& a : attachments_) {
    if (a.robot != robot) continue;
    Frame& frame = find(a.at)->frame;
    frame = link_frame(a.link) * a.in_link;
    frame.rotation.normalize();
  }
}

void PlacedRod::load(const PointLoad& load) {
  check_place("placed_rod:load", load.at);
  if (!all_finite(load.force)) throw UsageError("placed_rod:load: 'force' must be finite numbers in N");
  if (!all_finite(load.moment)) throw UsageError("placed_rod:load: 'moment' must be finite numbers in N m");
  loads_.push_back(load);
}

}  // namespace tendril
