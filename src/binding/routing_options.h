// The options that both routing methods take: ends, size, what the surroundings and the bending tools demand.
#pragma once

#include "binding/lua_class.h"
#include "method/free_space/free_space.h"
#include "method/pcc/pcc_demands.h"

namespace tendril::lua {

/// from, to, outer, section, min_bend_radius, min_straight, end_straight, clearance, free_ends, keep_in, keep_out, preference,
/// preference_range.
Schema routing_schema();

/// What those options say. `who` asks: "method.preform".
routing::Ends routing_ends(const Options& o);
routing::SpaceDemands space_demands(const Options& o);
routing::PccDemands pcc_demands(const Options& o);

/// The section, where one was given.
std::optional<Section> routed_section(const Options& o);

}  // namespace tendril::lua
