// Outcomes as bytes, on their way from process to process.
#pragma once

#include <string>
#include <vector>

#include "method/variation/study.h"

namespace tendril::variation {

std::string bytes_of(const Outcomes& outcomes);
/// Of the same study. Throws UsageError for bytes that are not those of outcomes.
Outcomes rows_of(const std::string& bytes, const Study& study);

/// Several messages in one, and back.
void append_part(const std::string& part, std::string& whole);
std::vector<std::string> parts_of(const std::string& whole);

}  // namespace tendril::variation
