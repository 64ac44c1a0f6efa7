// Large blocks of memory without a page fault for every 4 kB.
#pragma once

#include <cstddef>

namespace tendril {

/// Asks the system to give a block that has not been touched yet in large pages: the first use of tens of megabytes then
/// costs a fault for every 2 MB. Blocks below 4 MB, and systems that know no such request, stay as they are.
void prefer_huge_pages(const void* block, std::size_t bytes);

}  // namespace tendril
