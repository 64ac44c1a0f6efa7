// Long studies: killed at any moment and started again, and divided among processes.
#include <catch2/catch.hpp>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>

#include "process.h"

using Catch::Matchers::Contains;

namespace {

/// A study of 400 outcomes with a slow measure; arguments: where the outcomes go, the file that keeps them (or "-"), and a
/// command to run in its midst.
const std::string study = R"(
local m = rod.material{young = 5e6, poisson = 0.4, density = 1100}
local s = scene.new{gravity = {0, 0, -9.81}}
s:rod("hose", rod.new{length = 1, segments = 12, section = rod.section{outer = 0.016, material = m}},
  {from = frame{at = {0, 0, 0}, along = {1, 0, 0}}, to = frame{at = {0.85, 0, 0.05}, along = {1, 0, 0}}})
io.write("ready\n") io.flush()
local v = method.variation(s, {
  vary = {["hose.length"] = 0.02, ["hose.to"] = {ball = 0.01, cone = 0.1}, ["hose.section.EI"] = {tolerance = 0.1, relative = true}},
  measure = {"hose.min_bend_radius", "hose.max_tension", sag = function(eq)
    local z = 0
    measured = (measured or 0) + 1
    if arg[3] and measured == 100 then os.execute(arg[3]) end
    for _ = 1, 800 do for _, p in ipairs(eq:rod("hose").points) do z = math.min(z, p.z) end end
    return z
  end},
  outcomes = 400, seed = 21, store = arg[2] ~= "-" and arg[2] or nil})
print(v.message)
v:save(arg[1])
)";

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("a study killed at random moments ends with the same bits as an unbroken one", "[store]") {
  const cli::Folder folder;
  const std::string script = folder.file("study.lua", study), unbroken = folder.path() + "/unbroken.csv",
                    broken = folder.path() + "/broken.csv", store = folder.path() + "/study.sqlite";
  REQUIRE(cli::run({script, unbroken, "-"}).code == 0);
  const unsigned seed = std::random_device()();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  int killed = 0;
  for (int attempt = 0; attempt < 12; ++attempt) {
    const std::chrono::milliseconds after(std::uniform_int_distribution<int>(20, 900)(random));
    const cli::Outcome o = cli::run_and_signal({script, broken, store}, SIGKILL, after);
    if (o.code == 0) break;
    REQUIRE(o.code == 128 + SIGKILL);
    ++killed;
  }
  CHECK(killed > 0);
  const cli::Outcome last = cli::run({script, broken, store});
  INFO(last.err);
  REQUIRE(last.code == 0);
  CHECK_THAT(last.out, Contains("400 outcomes"));
  CHECK(text_of(broken) == text_of(unbroken));
  CHECK_FALSE(text_of(unbroken).empty());
}

TEST_CASE("a store that another process works on is refused, and not harmed", "[store]") {
  const cli::Folder folder;
  const std::string script = folder.file("study.lua", study), store = folder.path() + "/study.sqlite", err = folder.path() + "/err.txt";
  const std::string other = "'" TENDRIL_BINARY "' '" + script + "' '" + folder.path() + "/b.csv' '" + store + "' 2> '" + err + "'";
  const cli::Outcome o = cli::run({script, folder.path() + "/a.csv", store, other});
  INFO(o.err);
  CHECK(o.code == 0);
  CHECK_THAT(text_of(err), Contains("study.sqlite") && Contains("locked; does another process work on it?"));
  CHECK(text_of(folder.path() + "/b.csv").empty());
  CHECK(cli::run({script, folder.path() + "/c.csv", store}).code == 0);
  CHECK(text_of(folder.path() + "/a.csv") == text_of(folder.path() + "/c.csv"));
}

TEST_CASE("a study divided among processes has the same bits, and one process prints", "[processes]") {
  if (std::system("command -v mpirun > /dev/null 2>&1") != 0 || !std::filesystem::exists(std::filesystem::path(TENDRIL_BINARY).parent_path() / "modules/tendril_processes.so")) {
    WARN("no MPI on this machine: skipped");
    return;
  }
  const cli::Folder folder;
  const std::string script = folder.file("study.lua", study), alone = folder.path() + "/alone.csv";
  REQUIRE(cli::run({script, alone, "-"}).code == 0);
  // Open MPI unloads its own parts before a leak sanitizer, where there is one, can tell whose the memory is.
  const auto by_processes = [&](int count, const std::string& csv, const std::string& store) {
    return "ASAN_OPTIONS=detect_leaks=0 mpirun --allow-run-as-root --oversubscribe -n " + std::to_string(count) + " '" TENDRIL_BINARY "' '" + script + "' '" + csv + "' '" +
           store + "' > '" + folder.path() + "/out.txt' 2> '" + folder.path() + "/err.txt'";
  };
  for (const int count : {2, 3, 4}) {
    const std::string csv = folder.path() + "/by" + std::to_string(count) + ".csv";
    const int code = std::system(by_processes(count, csv, "-").c_str());
    INFO(text_of(folder.path() + "/err.txt"));
    REQUIRE(code == 0);
    CHECK(text_of(csv) == text_of(alone));
    CHECK(text_of(folder.path() + "/out.txt") == "ready\n400 outcomes\n");
  }
  SECTION("with a file that is there in part") {
    const std::string store = folder.path() + "/study.sqlite", csv = folder.path() + "/stored.csv";
    cli::run_and_signal({script, csv, store}, SIGKILL, std::chrono::milliseconds(60));
    REQUIRE(std::system(by_processes(3, csv, store).c_str()) == 0);
    CHECK(text_of(csv) == text_of(alone));
  }
  SECTION("a failure in one of them ends all") {
    std::string failing = study;
    failing.replace(failing.find("return z"), 8, "error('no measure today')");
    folder.file("study.lua", failing);
    CHECK(std::system(by_processes(3, folder.path() + "/none.csv", "-").c_str()) != 0);
    CHECK_THAT(text_of(folder.path() + "/err.txt"), Contains("no measure today"));
  }
}
