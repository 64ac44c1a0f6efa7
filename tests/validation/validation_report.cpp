#include "validation/validation_report.h"

#include <cstdio>
#include <cstring>

#include "validation/expected_errors.h"
#include "validation/floor_contact.h"
#include "validation/reference.h"

namespace tendril::validation {
namespace {

constexpr const char* head =
    "# Errors against reference solutions\n\n"
    "Written by `build/validation_table report`. References: the continuous equations solved by multiple shooting with two\n"
    "formulations, and closed forms (see reference.h). Line: the largest distance of the centre line at ten stations, over the\n"
    "length. Force: the largest error of a support's force, or moment over length, over the largest of them. Estimate: what\n"
    "`error = true` says of the line, over the length; a dash where it says that it is not valid. N: segments.\n\n"
    "Inextensible references are compared with a rod of EA L^2/EI = 1e10; its forces are good to about 1e-5. Dead\n"
    "moments (rollup_1turn) have no energy: \"unstable\" is then said of the symmetric part alone.\n\n"
    "| case | equilibrium | N | SE(3): line | force | estimate | staggered: line | force | estimate |\n"
    "|---|---|---|---|---|---|---|---|---|\n";

/// The mesh that the tests bound the errors at; the localized helices and boundary layers need finer ones.
int segments_of(const char* name) {
  for (const ExpectedErrors& expected : expected_errors())
    if (std::strcmp(expected.name, name) == 0) return expected.segments;
  if (std::strncmp(name, "localized", 9) == 0) return 320;
  return std::strstr(name, "1e10") ? 640 : 40;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", value);
  return text;
}

std::string cells(const Errors& errors, const Equilibrium& e, double length) {
  if (!e.ok()) return std::string(" | ") + name_of(e.status) + " | - | -";
  const bool valid = e.error && e.error->valid;
  return " | " + number(errors.line) + " | " + number(errors.reaction) + " | " +
         (valid ? number(e.error->value / length) : "-") + (e.stable ? "" : " (unstable)");
}

std::string row(const Reference& reference) {
  const int segments = segments_of(reference.name);
  std::string text = std::string("| ") + reference.name + " | " + reference.label + " | " + std::to_string(segments);
  for (const Method* method : {&se3, &staggered}) {
    const Equilibrium e = solve_reference(reference, *method, segments, true);
    text += cells(errors_of(reference, e), e, reference.rod.length);
  }
  return text + " |\n";
}

std::string tree_row() {
  std::string text = "| tree_harness | three hoses in a branch point | 40 each";
  for (const Method* method : {&se3, &staggered}) {
    const SystemEquilibrium found = solve(tree_problem(40), method->options(true));
    const TreeErrors errors = tree_errors(found);
    Equilibrium worst = found.rods[0];
    for (const Equilibrium& rod : found.rods)
      if (rod.error && worst.error && rod.error->value > worst.error->value) worst.error = rod.error;
    text += cells({errors.line, errors.reaction, errors.energy}, worst, 0.4);
  }
  return text + " |\n";
}

std::string contact_rows() {
  std::string text =
      "\n## Contact with a rigid floor\n\n"
      "SE(3). Force: of the clamp for the hose, of the floor for the tips.\n\n"
      "| case | N | line | force | deepest penetration over the radius |\n|---|---|---|---|---|\n";
  for (const int segments : {40, 80, 160}) {
    const FloorProblem problem = hose_on_floor(segments);
    const FloorErrors errors = hose_on_floor_errors(solve(problem.rod));
    text += "| contact_floor_kirchhoff: hose lying down | " + std::to_string(segments) + " | " + number(errors.line) + " | " +
            number(errors.force) + " | " + number(errors.deepest) + " |\n";
  }
  for (const TipOnFloor& tip : tips_on_floor) {
    const FloorProblem problem = tip_on_floor(tip, 2, 40);
    const Equilibrium e = solve(problem.rod);
    const TipErrors errors = tip_on_floor_errors(tip, 2, e);
    char name[80];
    std::snprintf(name, sizeof name, "contact_tip_on_floor: %.1f L below, twice the force", tip.depth);
    text += std::string("| ") + name + " | 40 | " + number(errors.place) + " | " + number(errors.floor_force) + " | " +
            number(e.deepest_penetration / 0.005) + " |\n";
  }
  return text;
}

}  // namespace

std::string validation_report() {
  std::string text = head;
  for (const Reference* reference : all_references()) text += row(*reference);
  text += tree_row() + contact_rows();
  return text +
         "\nBuckling loads with shear and compression, critical twists under tension and where the clamped elastica leaves its\n"
         "plane (euler_buckling_loads, twisted_clamped_critical) are bracketed by the signs of the pivots in\n"
         "test_instability.cpp.\n";
}

}  // namespace tendril::validation
