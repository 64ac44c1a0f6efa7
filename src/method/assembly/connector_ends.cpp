#include "method/assembly/connector_ends.h"

#include <algorithm>
#include <cmath>

#include "base/nearest_name.h"
#include "base/number_text.h"
#include "base/units.h"

namespace tendril::assembly {

namespace {

// Connectors may overlap surfaces by this much of the radius: what touches them rubs along.
constexpr double connector_slack = 0.05;
// A wedge's forces across the rod balance but for this share; along the rod they exceed what bends it to so many radii.
constexpr double unbalanced = 0.5, tight_bend = 10;

/// Stiffnesses like those of a solid of that size, so that it is next to rigid; the mass stays.
Section thickened(Section section, double radius) {
  const double growth = radius / section.radius(), area = growth * growth;
  section.outer *= growth;
  for (double* stiffness : {&section.EA, &section.GA1, &section.GA2}) *stiffness *= area;
  for (double* stiffness : {&section.EI1, &section.EI2, &section.GJ}) *stiffness *= area * area;
  return section;
}

/// Replaces what lies between two arc lengths.
void replace_part(Rod& rod, double from, double to, const Section& section) {
  std::vector<RodPart> parts;
  double begin = 0;
  for (const RodPart& part : rod.parts) {
    if (std::min(part.upto, from) > begin) parts.push_back({std::min(part.upto, from), part.section});
    if (begin <= from && from < part.upto) parts.push_back({to, section});
    if (part.upto > to) parts.push_back(part);
    begin = part.upto;
  }
  rod.parts = std::move(parts);
}

/// The rod with an end part as thick as asked for. It thickens along a cone, so that it slides through what a shoulder would catch on.
/// Returns how much of the rod is thicker now, m.
double thicken_end(Rod& rod, bool at_start, double length, double radius) {
  const Section thin = rod.section_at(at_start ? 0 : rod.length);
  const double more = radius - thin.radius(), cone = 1.5 * more;
  const int steps = std::clamp(static_cast<int>(std::ceil(more / (0.2 * thin.radius()))), 1, 8);
  length = std::min(length, 0.3 * rod.length);
  const double all = std::min(0.45 * rod.length, length + cone);
  for (int i = 0; i < steps; ++i) {
    // From the cone's tip on: outer pieces are replaced by what is thicker.
    const double reach = std::min(0.45 * rod.length, length + cone * (1 - double(i) / steps));
    const Section section = thickened(thin, thin.radius() + more * (i + 1) / steps);
    if (at_start) replace_part(rod, 0, reach, section);
    else replace_part(rod, rod.length - reach, rod.length, section);
  }
  return all;
}

/// Contacts on the last `part` metres of a rod.
struct Grasp {
  Vec3 across = Vec3::Zero();  ///< N, sum of what acts across the rod
  double pressed = 0;          ///< N, sum of the sizes of that
  double along = 0;            ///< N, towards the end
  double hardest = 0;          ///< N
  const ContactForce* contact = nullptr;  ///< the hardest
};

Grasp grasp_of(const Equilibrium& rod, bool at_start, double part) {
  Grasp grasp;
  for (const ContactForce& contact : rod.contacts) {
    if ((at_start ? contact.s : rod.s.back() - contact.s) > part) continue;
    const Vec3 axis = (at_start ? -1.0 : 1.0) * rod.frame_at(contact.s).d3();
    const double along = contact.force.dot(axis);
    const Vec3 across = contact.force - along * axis;
    grasp.across += across;
    grasp.pressed += across.norm();
    grasp.along += along;
    if (contact.force.norm() <= grasp.hardest) continue;
    grasp.hardest = contact.force.norm();
    grasp.contact = &contact;
  }
  return grasp;
}

}  // namespace

std::string wedged(const InstalledSystem& installed, const SystemEquilibrium& state) {
  if (!installed.surroundings) return {};
  double weight = 0;
  for (const RodProblem& rod : installed.free.rods) weight += rod.rod.mass() * installed.gravity().norm();
  for (std::size_t i = 0; i < installed.connectors.size(); ++i) {
    const ConnectorBody& body = installed.connectors[i];
    const Rod& design = installed.free.rods[body.rod()].rod;
    const double part = installed.thickened[i];
    const Section& thin = design.section_at(body.at_start() ? part : design.length - part);
    const double bend = tight_bend * thin.radius(), most = weight + std::min(thin.EI1, thin.EI2) / (bend * bend);
    const Grasp grasp = grasp_of(state.rods[body.rod()], body.at_start(), part);
    if (grasp.along <= most || grasp.across.norm() > unbalanced * grasp.pressed) continue;
    const auto mm = [](double metres) { return number_text(metres / units::mm); };
    const Vec3& at = grasp.contact->point;
    return "connector '" + body.name() + "' is wedged in " + installed.surroundings->name(grasp.contact->obstacle) + " at (" + mm(at.x()) +
           ", " + mm(at.y()) + ", " + mm(at.z()) + ") mm";
  }
  return {};
}

void add_connectors(InstalledSystem& installed, const std::vector<Connector>& connectors, const SystemEquilibrium& routed) {
  for (const Connector& connector : connectors) {
    if (connector.name.empty()) throw UsageError("assembly: a connector without a name");
    const auto rod = std::find(installed.rods.begin(), installed.rods.end(), connector.rod);
    if (rod == installed.rods.end())
      throw UsageError("assembly: connector '" + connector.name + "': unknown " + unknown_name(connector.rod, "rods", installed.rods));
    for (const ConnectorBody& other : installed.connectors)
      if (other.name() == connector.name) throw UsageError("assembly: two connectors are named '" + connector.name + "'");
    const int number = static_cast<int>(rod - installed.rods.begin());
    ConnectorBody body(connector, number, connector_slack * installed.radius);
    if (installed.surroundings) body.plugged_in(*installed.surroundings, body.pose(routed));
    // As wide as its corners, but no wider than there is room where it is routed.
    const Equilibrium& shape = routed.rods[number];
    Rod& design = installed.free.rods[number].rod;
    double wide = body.wide();
    for (std::size_t i = 0; i < shape.s.size() && installed.surroundings; ++i)
      if ((connector.at_start ? shape.s[i] : design.length - shape.s[i]) <= body.behind())
        wide = std::min(wide, installed.surroundings->closest(shape.points[i], wide).distance);
    const double thin = design.section_at(connector.at_start ? 0 : design.length).radius();
    const bool guides = wide > 1.05 * thin && body.behind() > 0;
    installed.thickened.push_back(guides ? thicken_end(design, connector.at_start, body.behind(), wide) : body.behind());
    installed.connectors.push_back(std::move(body));
  }
}

}  // namespace tendril::assembly
