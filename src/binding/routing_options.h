// The options that both routing methods take: ends, size, what the surroundings and the bending tools demand.
#pragma once

#include <map>
#include <string>

#include "binding/lua_class.h"
#include "method/free_space/free_space.h"
#include "method/pcc/pcc_demands.h"

namespace tendril::lua {

/// from, to, outer, section, min_bend_radius, min_straight, end_straight, clearance, free_ends, keep_in, keep_out, preference,
/// preference_range.
Schema routing_schema();

/// Of those: clearance, free_ends, keep_in, keep_out, preference, preference_range.
Schema surroundings_schema();
/// What they say, but for free_ends; the object's radius stays as it is.
void read_surroundings(const Options& o, routing::SpaceDemands& demands);

/// What a table {length =, clearance =} says of both.
struct CostWeights {
  double length = 1, clearance = 0;
};
CostWeights cost_weights(const Options& o, const std::map<std::string, double>& given);

/// What those options say.
routing::Ends routing_ends(const Options& o);
routing::SpaceDemands space_demands(const Options& o);
routing::PccDemands pcc_demands(const Options& o);

/// The section, where one was given.
std::optional<Section> routed_section(const Options& o);

}  // namespace tendril::lua
