// Three hoses that meet in one rigid branch point, clamped at their far ends, under gravity.
// Numbers of an independent shooting method, good to about ten digits; see reference.h.
#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "validation/reference.h"

namespace tendril::validation {
namespace {

/// Centre lines at s = 0.1 L, 0.2 L, ... L of each rod.
constexpr double stations[3][10][3] = {
    {{0.03974795913149, -0.0005345290516155, -0.004129133084109},
     {0.07858117827952, -0.001912703093154, -0.01366416361367},
     {0.1167597502288, -0.003873452715435, -0.02551661750387},
     {0.1548593420669, -0.006209857392489, -0.03755423280266},
     {0.1933392874883, -0.008734688344752, -0.04825302017392},
     {0.2324153105554, -0.01125184034226, -0.05648579845296},
     {0.2720507848575, -0.01353664402325, -0.0614272917236},
     {0.311999527816, -0.01532207887171, -0.06252654031742},
     {0.3518755418335, -0.01628627749695, -0.05950669559714},
     {0.391234044021, -0.01603531539134, -0.05236614543435}},
    {{0.4205830327598, 0.0106235234992, -0.04838384813933},
     {0.4420105245641, 0.04426323977066, -0.04553672388337},
     {0.4580699238815, 0.08081801269679, -0.04258352034606},
     {0.4711854658231, 0.1184682224523, -0.03875412178255},
     {0.4833307017242, 0.1562960520422, -0.03364651305841},
     {0.4963003632326, 0.193629219332, -0.02714490734917},
     {0.5120824454253, 0.2296047169218, -0.01942111989218},
     {0.5331679815106, 0.2625423010066, -0.01107794257362},
     {0.5623273426148, 0.2886506033076, -0.003573523642655},
     {0.6, 0.3, 0}},
    {{0.4203870213768, -0.04043443945171, -0.04032606482526},
     {0.4419643472755, -0.07114375092222, -0.02648861604206},
     {0.4585041638879, -0.1043381892414, -0.01137939835914},
     {0.4722509500988, -0.1382717561863, 0.004885368233395},
     {0.4849630483162, -0.1720766345128, 0.02223642904514},
     {0.4982216523363, -0.2051837241352, 0.04049817135066},
     {0.5138397946964, -0.2369472800075, 0.05924906813051},
     {0.5342731322753, -0.2661046821509, 0.07750647225133},
     {0.5626159768235, -0.2895483485489, 0.09289695251888},
     {0.6, -0.3, 0.1}},
};
/// What the clamps do to the rods: force and moment of each.
constexpr double clamps[3][2][3] = {
    {{-0.2962617096582, 0.03470378006278, 0.395965717026}, {0.001055516578561, -0.03077410237684, 0.00372680353759}},
    {{0.1110557246913, 0.8312422685582, 0.3647204041436}, {0.001020749975307, 0.02771366517931, -0.08376858292496}},
    {{0.1852059849669, -0.8659460486209, 0.7038338960655}, {0.00130783329266, 0.05433671108483, 0.07861896934235}},
};
constexpr double junction[3] = {0.391234044021, -0.01603531539134, -0.05236614543435};
constexpr double junction_rotation[4] = {0.5857575614169, 0.4003418457455, 0.4750488441345, 0.5205219317901};
constexpr double bend = 0.09313246286654, twist = 0.0002279142217338, stretch = 0.0005205164258353, shear = 0.0004384997606317, gravity = -0.02187768688703;

Vec3 vec(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

}  // namespace

SystemProblem tree_problem(int segments) {
  const Section section = Section::round(0.012, 0, Material::from_poisson(5e6, 0.5, 1100));
  const Quat clamp(0.5, 0.5, 0.5, 0.5);
  SystemProblem problem;
  problem.rods.assign(3, {});
  for (RodProblem& rod : problem.rods) {
    rod.rod = Rod::uniform(0.4, section, segments);
    rod.gravity = {0, 0, -9.81};
  }
  problem.rods[0].holds = {{0, {Vec3::Zero(), clamp}}};
  problem.rods[1].holds = {{0.4, {{0.6, 0.3, 0}, clamp}}};
  problem.rods[2].holds = {{0.4, {{0.6, -0.3, 0.1}, clamp}}};
  BranchPoint branch;
  branch.frame = {{0.4, 0, 0}, clamp};
  branch.sections = {{0, 0.4, {}},
                     {1, 0, {Vec3::Zero(), exp_rotation(30 * units::deg * Vec3::UnitY())}},
                     {2, 0, {Vec3::Zero(), exp_rotation(-30 * units::deg * Vec3::UnitY())}}};
  problem.branches = {branch};
  return problem;
}

TreeErrors tree_errors(const SystemEquilibrium& found) {
  constexpr double length = 0.4;
  TreeErrors errors;
  double largest = 0;
  Energy energy;
  for (int k = 0; k < 3; ++k) {
    const Equilibrium& rod = found.rods[k];
    const std::size_t stride = (rod.points.size() - 1) / 10;
    for (int i = 0; i < 10; ++i)
      errors.line = std::max(errors.line, (rod.points[stride * (i + 1)] - vec(stations[k][i])).norm() / length);
    const Vec3 force = vec(clamps[k][0]), moment = vec(clamps[k][1]);
    largest = std::max({largest, force.norm(), moment.norm() / length});
    errors.reaction = std::max({errors.reaction, (rod.reactions[0].force - force).norm(),
                                (rod.reactions[0].moment - moment).norm() / length});
    energy.bend += rod.energy.bend;
    energy.twist += rod.energy.twist;
    energy.stretch += rod.energy.stretch;
    energy.shear += rod.energy.shear;
    energy.gravity += rod.energy.gravity;
  }
  errors.reaction /= largest;
  errors.energy = std::max({std::abs(energy.bend - bend), std::abs(energy.twist - twist), std::abs(energy.stretch - stretch),
                            std::abs(energy.shear - shear), std::abs(energy.gravity - gravity)}) /
                  (bend + twist + stretch + shear);
  const Quat wanted(junction_rotation[0], junction_rotation[1], junction_rotation[2], junction_rotation[3]);
  errors.branch = (found.branches[0].at - vec(junction)).norm() / length;
  errors.branch_turn = found.branches[0].rotation.angularDistance(wanted.normalized());
  return errors;
}

}  // namespace tendril::validation
