#include "view/chart.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "base/write_file.h"
#include "view/chart_script.h"

extern char** environ;

namespace tendril {
namespace {

[[noreturn]] void refuse(const std::string& why) { throw UsageError("chart: " + why); }

bool ends_in(const std::string& path, const std::string& wanted) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == wanted;
}

/// gnuplot fed by a pipe, its words collected. No shell stands between.
class Gnuplot {
 public:
  Gnuplot() {
    int in[2], out[2];
    if (pipe2(in, O_CLOEXEC) != 0) refuse(std::string("no pipe to gnuplot: ") + std::strerror(errno));
    if (pipe2(out, O_CLOEXEC) != 0) {
      const int why = errno;
      close(in[0]), close(in[1]);
      refuse(std::string("no pipe to gnuplot: ") + std::strerror(why));
    }
    to_ = in[1], from_ = out[0];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in[0], 0);
    posix_spawn_file_actions_adddup2(&actions, out[1], 1);
    posix_spawn_file_actions_adddup2(&actions, out[1], 2);
    // A group of its own: Ctrl-C reaches tendril alone, which then ends its child.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    char name[] = "gnuplot", quiet[] = "-d";  // -d: no settings of the user's own
    char* arguments[] = {name, quiet, nullptr};
    const int failed = posix_spawnp(&child_, name, &actions, &attributes, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    close(in[0]), close(out[1]);
    if (failed) {
      close(to_), close(from_);
      refuse(failed == ENOENT ? "gnuplot is missing (package gnuplot-nox)"
                              : std::string("gnuplot cannot be started: ") + std::strerror(failed));
    }
    fcntl(to_, F_SETFL, O_NONBLOCK);
  }
  ~Gnuplot() {
    if (to_ >= 0) close(to_);
    close(from_);
    if (child_ > 0) kill(child_, SIGKILL), waitpid(child_, nullptr, 0);
  }
  Gnuplot(const Gnuplot&) = delete;
  Gnuplot& operator=(const Gnuplot&) = delete;

  /// Feeds the script and waits. Nothing: done. A status: the context stopped it.
  std::optional<Status> run(const std::string& script, const RunContext& context) {
    std::size_t fed = 0;
    char buffer[4096];
    for (;;) {
      if (const auto stop = context.stop()) return stop;
      pollfd wait[2] = {{from_, POLLIN, 0}, {to_, POLLOUT, 0}};
      if (poll(wait, to_ >= 0 ? 2 : 1, 50) < 0 && errno != EINTR)
        refuse(std::string("lost gnuplot: ") + std::strerror(errno));
      if (to_ >= 0 && wait[1].revents) feed(script, fed);
      if (wait[0].revents) {
        const ssize_t got = read(from_, buffer, sizeof buffer);
        if (got <= 0) break;
        if (said_.size() < 4000) said_.append(buffer, static_cast<std::size_t>(got));
      }
    }
    int state = 0;
    waitpid(child_, &state, 0);
    child_ = -1;
    good_ = WIFEXITED(state) && WEXITSTATUS(state) == 0;
    return std::nullopt;
  }

  bool good() const { return good_; }
  const std::string& said() const { return said_; }

 private:
  void feed(const std::string& script, std::size_t& fed) {
    // A gnuplot that has died makes write fail; its signal must not end the shell.
    sigset_t broken, before;
    sigemptyset(&broken);
    sigaddset(&broken, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &broken, &before);
    const ssize_t wrote = write(to_, script.data() + fed, script.size() - fed);
    const bool lost = wrote < 0 && errno == EPIPE;
    if (lost) {
      const timespec now{0, 0};
      sigtimedwait(&broken, nullptr, &now);
    }
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    if (wrote > 0) fed += static_cast<std::size_t>(wrote);
    if (fed == script.size() || lost) close(to_), to_ = -1;
  }

  pid_t child_ = -1;
  int to_ = -1, from_ = -1;
  std::string said_;
  bool good_ = false;
};

/// A file that goes away with its owner.
class Temporary {
 public:
  Temporary() {
    std::string name = (std::filesystem::temp_directory_path() / "tendril-chart-XXXXXX").string();
    file_ = mkostemp(name.data(), O_CLOEXEC);
    if (file_ < 0) refuse(std::string("no temporary file: ") + std::strerror(errno));
    path = name;
  }
  ~Temporary() {
    close(file_);
    unlink(path.c_str());
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  /// What was written to it, read without its name: the folder of temporary files may be closed to the program.
  std::string content() const {
    std::string bytes;
    char buffer[65536];
    for (ssize_t got; (got = pread(file_, buffer, sizeof buffer, static_cast<off_t>(bytes.size()))) != 0;) {
      if (got < 0 && errno == EINTR) continue;
      if (got < 0) refuse(std::string("cannot read what gnuplot drew: ") + std::strerror(errno));
      bytes.append(buffer, static_cast<std::size_t>(got));
    }
    return bytes;
  }

  std::string path;

 private:
  int file_ = -1;
};

void check_series(const Chart& chart, const ChartSeries& series) {
  const bool needs_x = chart.kind == ChartKind::lines || chart.kind == ChartKind::scatter;
  if (needs_x && series.x.size() != series.y.size())
    refuse("series '" + series.name + "': " + std::to_string(series.x.size()) + " x for " +
           std::to_string(series.y.size()) + " y");
  if (!needs_x && !series.x.empty())
    refuse("series '" + series.name + "': has x values, but bars and histograms take y only");
}

void check_size(int width, int height) {
  for (int size : {width, height})
    if (size < 64 || size > 8192)
      refuse("size " + std::to_string(width) + " x " + std::to_string(height) + " pixels, expected 64 ... 8192 each");
}

}  // namespace

void check_chart(const Chart& chart) {
  check_size(chart.width, chart.height);
  if (chart.series.empty()) refuse("nothing to show: no series");
  if (chart.series.size() > 12) refuse(std::to_string(chart.series.size()) + " series, expected 1 to 12");
  if (chart.bins < 0 || chart.bins > 10000)
    refuse(std::to_string(chart.bins) + " bins, expected 1 ... 10000, or 0 to choose");
  for (const ChartSeries& series : chart.series) check_series(chart, series);
  if (chart.kind == ChartKind::bars && !chart.categories.empty())
    for (const ChartSeries& series : chart.series)
      if (series.y.size() > chart.categories.size())
        refuse("series '" + series.name + "': " + std::to_string(series.y.size()) + " bars for " +
               std::to_string(chart.categories.size()) + " categories");
  for (const ChartReference& line : chart.references)
    if (!std::isfinite(line.at)) refuse("reference line '" + line.label + "' is at NaN or infinity");
}

void check_sheet(const ChartSheet& sheet) {
  check_size(sheet.width, sheet.height);
  if (sheet.charts.empty() || sheet.charts.size() > 40)
    refuse(std::to_string(sheet.charts.size()) + " charts on a sheet, expected 1 to 40");
  if (sheet.columns < 0 || sheet.columns > 40)
    refuse(std::to_string(sheet.columns) + " columns, expected 1 ... 40, or 0 to choose");
  for (const Chart& chart : sheet.charts) check_chart(chart);
}

namespace {

bool is_svg(const std::string& path) {
  const bool svg = ends_in(path, ".svg");
  if (!svg && !ends_in(path, ".png")) refuse("cannot write '" + path + "': expected a name that ends in .png or .svg");
  return svg;
}

/// Draws what `make_script` gives for a file's name.
template <class Make>
ChartReport save(const std::string& path, const RunContext& context, Make make_script) {
  const auto start = RunContext::Clock::now();
  const Temporary drawn;
  const ChartScript script = make_script(drawn.path);
  ChartReport report;
  report.drawn = script.drawn, report.dropped = script.dropped;
  Gnuplot gnuplot;
  if (const auto stop = gnuplot.run(script.text, context)) {
    report.status = *stop;
  } else {
    const std::string bytes = drawn.content();
    if (!gnuplot.good() || bytes.empty()) refuse("gnuplot failed: " + gnuplot.said());
    write_file(path, bytes);
  }
  report.seconds = std::chrono::duration<double>(RunContext::Clock::now() - start).count();
  return report;
}

void check_points(const ChartScript& script, const Chart& chart) {
  if (script.drawn == 0)
    refuse((chart.title.empty() ? "" : "'" + chart.title + "': ") + "nothing to show: none of " + std::to_string(script.dropped) +
           " points is finite" + (chart.log_x || chart.log_y ? " and positive on the log axes" : ""));
}

}  // namespace

ChartReport save_chart(const Chart& chart, const std::string& path, const RunContext& context) {
  const bool svg = is_svg(path);
  check_chart(chart);
  return save(path, context, [&](const std::string& output) {
    const ChartScript script = chart_script(chart, output, svg);
    check_points(script, chart);
    return script;
  });
}

ChartReport save_sheet(const ChartSheet& sheet, const std::string& path, const RunContext& context) {
  const bool svg = is_svg(path);
  check_sheet(sheet);
  for (const Chart& chart : sheet.charts) check_points(chart_script(chart, "", svg), chart);
  return save(path, context, [&](const std::string& output) { return sheet_script(sheet, output, svg); });
}

}  // namespace tendril
