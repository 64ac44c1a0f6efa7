#include <catch2/catch.hpp>

#include "shell/progress.h"

TEST_CASE("how long a person waits") {
  using tendril::shell::duration_text;
  const auto [seconds, text] = GENERATE(table<double, std::string>({{-1, "0 s"}, {0.4, "0 s"}, {0.6, "1 s"}, {59.4, "59 s"}, {59.6, "1 min 0 s"},
                                                                    {125, "2 min 5 s"}, {3599, "59 min 59 s"}, {4320, "1 h 12 min"},
                                                                    {1e6, "277 h 46 min"}, {1e300, "277777 h 46 min"}}));
  CHECK(duration_text(seconds) == text);
}
