#include "shell/doctor.h"

#include <sys/sysinfo.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include <lua.hpp>

#include "base/error.h"
#include "base/installation.h"
#include "base/instruction_sets.h"
#include "base/load_module.h"
#include "shell/history.h"
#include "shell/init_file.h"
#include "shell/picture_query.h"
#include "statics/batch_kernel.h"

namespace fs = std::filesystem;

namespace tendril::shell {
namespace {

class Examination {
 public:
  void group(std::string name) { group_ = std::move(name); }
  void good(std::string name, std::string value) { findings.push_back({group_, std::move(name), std::move(value), false}); }
  void broken(std::string name, std::string value) { findings.push_back({group_, std::move(name), std::move(value), true}); }

  std::vector<Finding> findings;

 private:
  std::string group_;
};

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// What `command` prints first; "" when it cannot be run or fails.
std::string answer_of(const char* command) {
  std::FILE* pipe = ::popen(command, "r");
  if (!pipe) return {};
  char buffer[256];
  const std::string text = std::fgets(buffer, sizeof buffer, pipe) ? first_line(buffer) : "";
  return ::pclose(pipe) == 0 ? text : "";
}

std::string gigabytes(double bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f GiB", bytes / double(1ull << 30));
  return text;
}

void look_at_program(Examination& e) {
  e.group("program");
  e.good("tendril", std::string(TENDRIL_VERSION) + " in " + program_folder());
  e.good("Lua", LUA_RELEASE);
#if defined(__clang__)
  e.good("compiled by", "clang " __clang_version__);
#else
  e.good("compiled by", "g++ " __VERSION__);
#endif
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name"))
      if (const auto colon = line.find(": "); colon != std::string::npos) return line.substr(colon + 2);
  return "unknown";
}

void look_at_machine(Examination& e) {
  e.group("machine");
  e.good("processor", processor_name());
#if defined(__x86_64__)
  std::string features;
  const auto feature = [&](const char* name, bool has) { features += (features.empty() ? "" : ", ") + std::string(has ? "" : "no ") + name; };
  feature("AVX2", __builtin_cpu_supports("avx2"));
  feature("FMA", __builtin_cpu_supports("fma"));
  feature("AVX-512", runs_x86_64_v4());
  e.good("instructions", features);
#endif
  const BatchKernel& kernel = best_batch_kernel();
  e.good("batch kernel", std::string(kernel.name) + ", " + std::to_string(kernel.lanes) + " outcomes at a time");
  e.good("threads", std::to_string(std::thread::hardware_concurrency()));
  struct sysinfo memory {};
  if (::sysinfo(&memory) == 0)
    e.good("memory", gigabytes(double(memory.totalram) * memory.mem_unit) + ", " + gigabytes(double(memory.freeram) * memory.mem_unit) + " unused");
}

void look_at_folder(Examination& e, const char* name, Part part, const char* file) {
  std::error_code error;
  const std::string folder = part_folder(part);
  if (!folder.empty() && fs::exists(fs::path(folder) / file, error)) e.good(name, folder);
  else e.broken(name, "missing: " + part_places(part, file));
}

void look_at_folders(Examination& e) {
  e.group("folders");
  look_at_folder(e, "Lua modules", Part::lua, "meta/tendril.lua");
  look_at_folder(e, "models", Part::assets, "six_axis/six_axis.urdf");
  look_at_folder(e, "modules", Part::modules, "");
  const std::string history = history_path();
  e.good("history", history.empty() ? "not kept: there is no HOME" : history);
  std::error_code error;
  const std::string init = init_path();
  e.good("init file", init.empty() || !fs::exists(init, error) ? "none" + (init.empty() ? "" : " (" + init + ")") : init);
}

struct Module {
  const char* file;
  const char* what_for;
  bool needed;  ///< else the program may be built without it
};

constexpr Module modules[] = {
    {"tendril_render.so", "pictures", true},        {"tendril_import.so", "glTF, COLLADA, 3MF", true},
    {"tendril_collide.so", "robots' links", true},  {"tendril_threads.so", "threads", true},
    {"tendril_store.so", "stored studies", true},   {"tendril_search.so", "search without gradients", true},
    {"tendril_ipopt.so", "direct dress packs", true}, {"tendril_processes.so", "several processes", false},
};

void look_at_module(Examination& e, const std::string& file, const char* what_for, bool needed) {
  const ModuleEntry entry = load_module(file.c_str(), module_about);
  if (!entry.address) {
    const bool absent = entry.problem.find("is missing") != std::string::npos;
    return absent && !needed ? e.good(what_for, "not built (optional)") : e.broken(what_for, entry.problem);
  }
  const std::string about = reinterpret_cast<const char* (*)()>(entry.address)();
  if (about.starts_with("broken: ")) e.broken(what_for, file + ": " + about.substr(8));
  else e.good(what_for, first_line(about) + "  (" + file + ")");
}

void look_at_modules(Examination& e) {
  e.group("modules");
  for (const Module& module : modules) look_at_module(e, module.file, module.what_for, module.needed);
  // Others that lie there, such as of a later version.
  std::error_code error;
  std::vector<std::string> others;
  for (const auto& entry : fs::directory_iterator(part_folder(Part::modules), error)) {
    const std::string file = entry.path().filename().string();
    const bool known = std::any_of(std::begin(modules), std::end(modules), [&](const Module& m) { return file == m.file; });
    if (entry.path().extension() == ".so" && !known) others.push_back(file);
  }
  std::sort(others.begin(), others.end());
  for (const std::string& file : others) look_at_module(e, file, file.c_str(), true);
}

void look_at_programs(Examination& e) {
  e.group("programs and fonts");
  const std::string version = answer_of("gnuplot --version 2>/dev/null");
  const bool draws = !version.empty() && std::system("gnuplot -d -e 'set terminal pngcairo' >/dev/null 2>&1") == 0;
  if (version.empty()) e.broken("charts", "gnuplot is missing (package gnuplot-nox)");
  else if (!draws) e.broken("charts", version + " has no terminal pngcairo (package gnuplot-nox)");
  else e.good("charts", version);
  std::error_code error;
  const char* named = std::getenv("TENDRIL_FONTS");
  const std::string fonts = named && *named ? named : "/usr/share/fonts/truetype/dejavu";
  for (const char* file : {"DejaVuSans.ttf", "DejaVuSans-Bold.ttf"}) {
    const std::string path = fonts + "/" + file;
    if (fs::is_regular_file(path, error)) e.good("font", path);
    else e.broken("font", path + " is missing (package fonts-dejavu-core)");
  }
  const std::string launcher = answer_of("mpirun --version 2>/dev/null");
  e.good("mpirun", launcher.empty() ? "not there (only for studies on several machines)" : launcher);
}

std::string pictures_of(const Terminal& terminal) {
  try {
    const PictureTerminal shows = PictureQuery().look(terminal);
    return shows.protocol == PictureProtocol::none ? "no: " + shows.why : std::string("by ") + name_of(shows.protocol);
  } catch (const UsageError& error) {
    return error.what();
  }
}

void look_at_terminal(Examination& e, const Terminal& terminal) {
  e.group("terminal");
  const char* type = std::getenv("TERM");
  e.good("TERM", type && *type ? type : "not set");
  e.good("editing", terminal.can_edit() ? "yes" : "no: input and output are not both a terminal that understands escapes");
  e.good("colours", terminal.colour ? "yes" : "no");
  e.good("UTF-8", terminal.unicode ? "yes" : "no");
  e.good("pictures", pictures_of(terminal));
}

}  // namespace

std::vector<Finding> examine(const Terminal& terminal) {
  Examination e;
  look_at_program(e);
  look_at_machine(e);
  look_at_folders(e);
  look_at_modules(e);
  look_at_programs(e);
  look_at_terminal(e, terminal);
  return e.findings;
}

std::string report_text(const std::vector<Finding>& findings) {
  std::size_t widest = 0;
  for (const Finding& finding : findings) widest = std::max(widest, finding.name.size());
  std::string text, group;
  std::size_t broken = 0;
  for (const Finding& finding : findings) {
    if (finding.group != group) text += (text.empty() ? "" : "\n") + (group = finding.group) + "\n";
    text += (finding.broken ? "x " : "  ") + finding.name + std::string(widest - finding.name.size() + 2, ' ') + finding.value + "\n";
    broken += finding.broken;
  }
  if (broken == 0) return text + "\nEverything that is needed is there.\n";
  return text + "\n" + std::to_string(broken) + (broken == 1 ? " thing is" : " things are") + " missing or broken (marked x).\n";
}

}  // namespace tendril::shell
