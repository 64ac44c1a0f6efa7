#include <catch2/catch.hpp>

#include <vector>

#include "base/huge_pages.h"

using namespace tendril;

TEST_CASE("asking for large pages changes nothing that is stored", "[huge_pages]") {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1000}, std::size_t{3} << 20}) {
    std::vector<int> numbers;
    numbers.reserve(count);
    prefer_huge_pages(numbers.data(), count * sizeof(int));
    for (std::size_t i = 0; i < count; ++i) numbers.push_back(static_cast<int>(i));
    prefer_huge_pages(numbers.data(), count * sizeof(int));
    bool same = true;
    for (std::size_t i = 0; i < count; ++i) same = same && numbers[i] == static_cast<int>(i);
    CHECK(same);
  }
  prefer_huge_pages(nullptr, 0);
}
