#include <catch2/catch.hpp>

#include <cstdlib>

#include "base/load_module.h"
#include "base/processes.h"

using namespace tendril;
using Catch::Matchers::Contains;

TEST_CASE("a module that is not there says where it was looked for", "[module]") {
  const ModuleEntry none = load_module("tendril_nothing.so", "entry");
  CHECK(none.address == nullptr);
  CHECK_THAT(none.problem, Contains("modules/tendril_nothing.so' is missing") && Contains("TENDRIL_MODULES"));
  CHECK_THROWS_WITH(module_entry("study", "tendril_nothing.so", "entry"), Contains("study: the module '"));
}

TEST_CASE("a module without the entry is none of this program", "[module]") {
  const ModuleEntry wrong = load_module("tendril_threads.so", "tendril_no_such_entry");
  CHECK(wrong.address == nullptr);
  CHECK_THAT(wrong.problem, Contains("is not a module of this program: it has no tendril_no_such_entry"));
  CHECK(load_module("tendril_threads.so", "tendril_run_workers").address != nullptr);
}

TEST_CASE("without a launcher there is one process", "[processes]") {
  CHECK(process_count() == 1);
  CHECK(process_rank() == 0);
  CHECK(is_first_process());
  CHECK(gathered("abc") == std::vector<std::string>{"abc"});
}
