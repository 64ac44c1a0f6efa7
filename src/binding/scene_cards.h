// How scenes, rods and equilibria print.
#pragma once

#include <string>

#include "binding/scene_classes.h"

namespace tendril::lua {

std::string describe_section(const Section& section);
std::string describe_rod(const Rod& rod);
std::string describe_placed(const PlacedRod& rod);
std::string describe_scene(const Scene& scene);

std::string describe_equilibrium(const SceneEquilibrium& equilibrium, bool unicode);  ///< `unicode`: block characters may be used
std::string describe_solved_rod(const SolvedRodHandle& rod);
std::string describe_energy(const Energy& energy);
std::string describe_clearance(const ClearanceValue& clearance);
std::string describe_error(const ErrorValue& error);
std::string describe_contact(const ContactHandle& contact);

}  // namespace tendril::lua
