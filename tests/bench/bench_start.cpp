// Start of the program: `tendril -e 'print(1)'`, from spawn to exit. The binary is the one beside this benchmark.
#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <filesystem>
#include <string>

extern char** environ;

namespace {

struct Run {
  double seconds = 0;
  double processor = 0;  ///< s of one core, user and system: what a busy machine does not change much
  double resident = 0;  ///< MB, the largest; never below this small benchmark's own, which a spawned process starts from
  bool ok = false;
};

Run run(const std::string& program, std::initializer_list<const char*> arguments) {
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const char* a : arguments) argv.push_back(const_cast<char*>(a));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);

  Run out;
  const auto start = std::chrono::steady_clock::now();
  pid_t child = 0;
  int status = 0;
  rusage usage{};
  if (posix_spawn(&child, program.c_str(), &files, nullptr, argv.data(), environ) == 0 &&
      wait4(child, &status, 0, &usage) == child)
    out.ok = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto in_seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  out.processor = in_seconds(usage.ru_utime) + in_seconds(usage.ru_stime);
  out.resident = static_cast<double>(usage.ru_maxrss) / 1024;
  posix_spawn_file_actions_destroy(&files);
  return out;
}

void start(benchmark::State& state, std::initializer_list<const char*> arguments) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "tendril";
  double fastest = 1e9, processor = 1e9, resident = 0;
  for (auto _ : state) {
    const Run r = run(program, arguments);
    if (!r.ok) {
      state.SkipWithError(("could not run " + program).c_str());
      return;
    }
    state.SetIterationTime(r.seconds);
    fastest = std::min(fastest, r.seconds);
    processor = std::min(processor, r.processor);
    resident = std::max(resident, r.resident);
  }
  state.counters["fastest_ms"] = 1e3 * fastest;
  state.counters["processor_ms"] = 1e3 * processor;
  state.counters["resident_MB"] = resident;
}

}  // namespace

BENCHMARK_CAPTURE(start, print, {"-e", "print(1)"})->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(start, version, {"--version"})->UseManualTime()->Unit(benchmark::kMillisecond);
