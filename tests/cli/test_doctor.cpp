// tendril doctor: what it finds, what it misses, and that a script of its name still runs.
#include <catch2/catch.hpp>
#include <filesystem>

#include "process.h"

using cli::Folder;
using cli::Outcome;
using cli::run;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace fs = std::filesystem;

namespace {

/// Modules, models and fonts as they are, in a folder of links from which some can be taken away.
std::string linked(const Folder& folder, const std::string& name, const std::string& without) {
  const fs::path from = fs::path(TENDRIL_BINARY).parent_path() / name, to = fs::path(folder.path()) / name;
  fs::create_directories(to);
  for (const auto& entry : fs::directory_iterator(from))
    if (entry.path().filename() != without) fs::create_symlink(entry.path(), to / entry.path().filename());
  return to.string();
}

}  // namespace

TEST_CASE("doctor names versions, every module and what the processor can do, and finds nothing broken") {
  const Outcome o = run({"doctor"});
  INFO(o.out);
  CHECK(o.code == 0);
  CHECK(o.err.empty());
  CHECK_THAT(o.out, StartsWith("program\n  tendril ") && Contains("Lua 5.4") && Contains("batch kernel") && Contains("OpenGL ") &&
                        Contains("assimp ") && Contains("FCL ") && Contains("NLopt ") && Contains("SQLite ") && Contains("Ipopt ") &&
                        Contains("oneTBB ") && Contains("gnuplot ") && Contains("DejaVuSans-Bold.ttf") &&
                        Contains("Everything that is needed is there."));
  CHECK(o.out.find("\nx ") == std::string::npos);
  for (const auto& entry : fs::directory_iterator(fs::path(TENDRIL_BINARY).parent_path() / "modules")) {
    if (entry.path().extension() != ".so") continue;
    const std::string file = entry.path().filename().string();
    INFO(file);
    CHECK_THAT(o.out, Contains("(" + file + ")"));
    CHECK(o.out.find("\n  " + file) == std::string::npos);  // a module has a purpose, not just a name
  }
}

TEST_CASE("doctor marks what is missing or broken and ends with 1") {
  const Folder folder;
  const Outcome fonts = run({"doctor"}, "", {{"TENDRIL_FONTS", "/nonexistent"}});
  CHECK(fonts.code == 1);
  CHECK_THAT(fonts.out, Contains("\nx font") && Contains("/nonexistent/DejaVuSans.ttf is missing (package fonts-dejavu-core)") &&
                            Contains("2 things are missing or broken"));

  const Outcome one = run({"doctor"}, "", {{"TENDRIL_MODULES", linked(folder, "modules", "tendril_store.so")}});
  CHECK(one.code == 1);
  CHECK_THAT(one.out, Contains("x stored studies") && Contains("tendril_store.so' is missing") && Contains("1 thing is missing"));

  fs::create_directories(folder.path() + "/bad");
  folder.file("bad/tendril_search.so", "no module");
  const Outcome bad = run({"doctor"}, "", {{"TENDRIL_MODULES", folder.path() + "/bad"}});
  CHECK(bad.code == 1);
  CHECK_THAT(bad.out, Contains("tendril_search.so' cannot be loaded: "));

  const Outcome models = run({"doctor"}, "", {{"TENDRIL_ASSETS", folder.path()}});
  CHECK(models.code == 1);
  CHECK_THAT(models.out, Contains("x models") && Contains(folder.path() + "/six_axis/six_axis.urdf"));

  const Outcome no_gnuplot = run({"doctor"}, "", {{"PATH", "/nonexistent"}});
  CHECK(no_gnuplot.code == 1);
  CHECK_THAT(no_gnuplot.out, Contains("gnuplot is missing (package gnuplot-nox)"));
}

TEST_CASE("several processes are optional") {
  const Folder folder;
  const Outcome o = run({"doctor"}, "", {{"TENDRIL_MODULES", linked(folder, "modules", "tendril_processes.so")}});
  CHECK(o.code == 0);
  CHECK_THAT(o.out, Contains("several processes         not built (optional)"));
}

TEST_CASE("a script called doctor runs by its path") {
  const Folder folder;
  CHECK(run({folder.file("doctor", "print('patient', ...)"), "x"}).out == "patient\tx\n");
  const Outcome o = run({"doctor", "x"});
  CHECK(o.code == 2);
  CHECK_THAT(o.err, StartsWith("tendril: 'tendril doctor' takes nothing more; a script of that name runs as ./doctor\n"));
}
