#include "method/dress_pack/unmet.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "base/number_text.h"
#include "base/units.h"

namespace tendril::dress_pack {
namespace {

constexpr double kept = 1e-3;           // of a limit
constexpr double clearance_kept = 1e-5; // m
constexpr double as_bad = 0.99;         // of how far the worst value is beyond its limit: an end of the path that is no better

std::string millimetres(double metres) { return number_text(std::round(1e5 * metres) / 100) + " mm"; }

/// One kind of limit on one hold or rod over the motion.
struct Watched {
  Unmet::What what;
  std::string where;
  double demanded;
  bool least;  ///< the value may not be below it; else not above
  std::function<double(const PackStep&)> value;
};

bool breaks(const Watched& watched, double value) {
  if (watched.what == Unmet::What::clearance || watched.what == Unmet::What::robot_clearance) return value < watched.demanded - clearance_kept;
  return watched.least ? value < watched.demanded * (1 - kept) : value > watched.demanded * (1 + kept);
}

std::string text_of(const Unmet& u) {
  const std::string when = " at t = " + number_text(std::round(1e4 * u.t) / 1e4) + (u.at_end ? ", an end of the path" : "");
  switch (u.what) {
    case Unmet::What::tension: return "a force of " + number_text(std::round(10 * u.value) / 10) + " N on '" + u.where + "'" + when + ", at most " + number_text(u.demanded) + " N asked for";
    case Unmet::What::twist: return "'" + u.where + "' is twisted by " + number_text(u.value / units::deg) + " deg/m" + when + ", at most " + number_text(u.demanded / units::deg) + " asked for";
    case Unmet::What::bend_radius: return "'" + u.where + "' is bent to a radius of " + millimetres(u.value) + when + ", at least " + millimetres(u.demanded) + " asked for";
    case Unmet::What::clearance: return "a clearance of '" + u.where + "' of " + millimetres(u.value) + when + ", " + millimetres(u.demanded) + " asked for";
    case Unmet::What::robot_clearance: break;
  }
  return "a clearance of the robot of " + millimetres(u.value) + when + ", " + millimetres(u.demanded) + " asked for";
}

void look(const PackMotion& motion, const Watched& watched, std::vector<Unmet>& out) {
  Unmet found{watched.what, 0, watched.demanded, 0, 0, 0, watched.where, false, {}};
  bool any = false;
  for (const PackStep& step : motion.steps) {
    const double value = watched.value(step);
    if (!breaks(watched, value)) continue;
    if (!any) found.from = step.t;
    found.to = step.t;
    if (!any || (watched.least ? value < found.value : value > found.value)) found.value = value, found.t = step.t;
    any = true;
  }
  if (!any) return;
  for (const PackStep* end : {&motion.steps.front(), &motion.steps.back()}) {
    const double value = watched.value(*end);
    if (end->t > 0 && end->t < 1) continue;  // the motion went no farther
    if (!breaks(watched, value) || std::abs(value - watched.demanded) < as_bad * std::abs(found.value - watched.demanded)) continue;
    found.at_end = true;
    found.t = end->t;
    found.value = value;
    break;
  }
  found.text = text_of(found);
  out.push_back(std::move(found));
}

std::vector<Watched> watched_by(const PackProblem& pack, const Limits& limits) {
  using What = Unmet::What;
  std::vector<Watched> all;
  for (std::size_t k = 0; k < pack.attachments.size() && std::isfinite(limits.max_tension); ++k)
    all.push_back({What::tension, pack.attachment_name(static_cast<int>(k)), limits.max_tension, false,
                   [k](const PackStep& step) { return step.ends[k].force.norm(); }});
  for (std::size_t k = 0; k < pack.rods.size(); ++k) {
    const std::string name = pack.rod_name(static_cast<int>(k));
    if (std::isfinite(limits.max_twist)) all.push_back({What::twist, name, limits.max_twist, false, [k](const PackStep& step) { return step.rods[k].twist; }});
    if (limits.min_bend_radius > 0)
      all.push_back({What::bend_radius, name, limits.min_bend_radius, true, [k](const PackStep& step) { return step.rods[k].bend_radius; }});
    if (limits.clearance >= 0) all.push_back({What::clearance, name, limits.clearance, true, [k](const PackStep& step) { return step.rods[k].clearance; }});
  }
  if (limits.robot_clearance >= 0)
    all.push_back({What::robot_clearance, pack.robot->name(), limits.robot_clearance, true, [](const PackStep& step) { return step.robot.clearance; }});
  return all;
}

}  // namespace

const char* name_of(Unmet::What what) {
  switch (what) {
    case Unmet::What::tension: return "tension";
    case Unmet::What::twist: return "twist";
    case Unmet::What::bend_radius: return "bend_radius";
    case Unmet::What::clearance: return "clearance";
    case Unmet::What::robot_clearance: break;
  }
  return "robot_clearance";
}

void Limits::check() const {
  const auto refuse = [](const std::string& what, double value, const char* expected) {
    throw UsageError("dress pack: " + what + " of " + number_text(value) + ", expected " + expected);
  };
  if (!(max_tension > 0)) refuse("a largest tension", max_tension, "more than 0 N");
  if (!(max_twist > 0)) refuse("a largest twist", max_twist, "more than 0 rad/m");
  if (!(min_bend_radius >= 0) || std::isinf(min_bend_radius)) refuse("a smallest bend radius", min_bend_radius, "at least 0 m");
  for (const double gap : {clearance, robot_clearance})
    if (!std::isfinite(gap)) refuse("a clearance", gap, "a number (m)");
}

std::vector<Unmet> unmet_of(const PackProblem& pack, const PackMotion& motion, const Limits& limits) {
  std::vector<Unmet> out;
  for (const Watched& watched : watched_by(pack, limits)) look(motion, watched, out);
  const auto excess = [](const Unmet& u) { return std::abs(u.value - u.demanded) / std::max(std::abs(u.demanded), 1e-9); };
  std::stable_sort(out.begin(), out.end(), [&](const Unmet& a, const Unmet& b) {
    return a.what != b.what ? a.what < b.what : excess(a) > excess(b);
  });
  return out;
}

}  // namespace tendril::dress_pack
