// Strain, bend radius, clearance and hands of an installation over its time.
#pragma once

#include <string>

#include "method/assembly/options.h"
#include "view/chart.h"

namespace tendril {

/// One below the other: the worst of all rods in each state that was kept. Throws UsageError where nothing was played.
ChartSheet assembly_chart(const assembly::Result& result, const std::string& title);

}  // namespace tendril
