#include "process.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

namespace cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto patience = std::chrono::seconds(60);  // far beyond any honest answer on a busy machine

int milliseconds_until(Clock::time_point end) {
  return static_cast<int>(std::max<long>(0, std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count()));
}

[[noreturn]] void become_tendril(const std::vector<std::string>& arguments, const Environment& environment) {
  ::setenv("HOME", "/nonexistent", 1);
  for (const char* name : {"XDG_STATE_HOME", "XDG_CONFIG_HOME", "TENDRIL_LUA", "TENDRIL_MEMORY", "TENDRIL_PICTURES", "NO_COLOR"}) ::unsetenv(name);
  for (const auto& [name, value] : environment) {
    if (value.empty()) ::unsetenv(name.c_str());
    else ::setenv(name.c_str(), value.c_str(), 1);
  }
  std::vector<char*> argv{const_cast<char*>("tendril")};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  ::signal(SIGINT, SIG_DFL);
  ::execv(TENDRIL_BINARY, argv.data());
  ::_exit(127);
}

int exit_code(int status) { return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status); }

/// The program with pipes on its three streams.
class Piped {
 public:
  Piped(const std::vector<std::string>& arguments, const Environment& environment) {
    int in[2], out[2], err[2];
    REQUIRE((::pipe2(in, O_CLOEXEC) == 0 && ::pipe2(out, O_CLOEXEC) == 0 && ::pipe2(err, O_CLOEXEC) == 0));
    child_ = ::fork();
    REQUIRE(child_ >= 0);
    if (child_ == 0) {
      ::dup2(in[0], STDIN_FILENO);
      ::dup2(out[1], STDOUT_FILENO);
      ::dup2(err[1], STDERR_FILENO);
      become_tendril(arguments, environment);
    }
    ::close(in[0]);
    ::close(out[1]);
    ::close(err[1]);
    in_ = in[1];
    out_ = out[0];
    err_ = err[0];
  }

  ~Piped() {
    for (const int file : {in_, out_, err_})
      if (file >= 0) ::close(file);
  }

  void write(const std::string& input) {
    ::signal(SIGPIPE, SIG_IGN);
    std::size_t sent = 0;
    while (sent < input.size()) {
      const ssize_t count = ::write(in_, input.data() + sent, input.size() - sent);
      if (count <= 0) break;
      sent += static_cast<std::size_t>(count);
    }
    ::close(in_);
    in_ = -1;
  }

  void signal_when_ready(int signal, std::chrono::milliseconds after) {
    read_until([this] { return outcome_.out.find("ready\n") != std::string::npos; });
    std::this_thread::sleep_for(after);
    ::kill(child_, signal);
  }

  Outcome finish() {
    read_until([] { return false; });
    int status = 0;
    ::waitpid(child_, &status, 0);
    outcome_.code = exit_code(status);
    return outcome_;
  }

 private:
  template <class Enough>
  void read_until(Enough enough) {
    const auto end = Clock::now() + patience;
    while (!enough() && (out_ >= 0 || err_ >= 0)) {
      pollfd files[2] = {{out_, POLLIN, 0}, {err_, POLLIN, 0}};
      const int ready = ::poll(files, 2, milliseconds_until(end));
      if (ready == 0) {
        ::kill(child_, SIGKILL);
        FAIL("no end after a minute; standard output so far: " << outcome_.out << "\nstandard error: " << outcome_.err);
      }
      if (files[0].revents) take(out_, outcome_.out);
      if (files[1].revents) take(err_, outcome_.err);
    }
  }

  static void take(int& file, std::string& into) {
    char buffer[4096];
    const ssize_t count = ::read(file, buffer, sizeof buffer);
    if (count > 0) {
      into.append(buffer, static_cast<std::size_t>(count));
      return;
    }
    ::close(file);
    file = -1;
  }

  pid_t child_ = -1;
  int in_ = -1, out_ = -1, err_ = -1;
  Outcome outcome_;
};

}  // namespace

Outcome run(const std::vector<std::string>& arguments, const std::string& input, const Environment& environment) {
  Piped program(arguments, environment);
  program.write(input);
  return program.finish();
}

Outcome run_and_signal(const std::vector<std::string>& arguments, int signal, std::chrono::milliseconds after) {
  Piped program(arguments, {});
  program.signal_when_ready(signal, after);
  return program.finish();
}

Outcome run_and_interrupt(const std::vector<std::string>& arguments, std::chrono::milliseconds after) {
  return run_and_signal(arguments, SIGINT, after);
}

TerminalSession::TerminalSession(const std::vector<std::string>& arguments, const Environment& environment) {
  winsize size{};
  size.ws_col = 100;
  size.ws_row = 40;
  child_ = ::forkpty(&terminal_, nullptr, nullptr, &size);
  if (child_ < 0) FAIL("no pseudo-terminal on this machine");  // ctest then counts the program as skipped
  if (child_ == 0) {
    Environment all = environment;
    all.emplace("TERM", "xterm");
    all.emplace("LC_ALL", "C.UTF-8");
    become_tendril(arguments, all);
  }
}

TerminalSession::~TerminalSession() {
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  ::close(terminal_);
}

void TerminalSession::type(const std::string& keys) {
  REQUIRE(::write(terminal_, keys.data(), keys.size()) == static_cast<ssize_t>(keys.size()));
}

bool TerminalSession::read_some(int timeout_ms) {
  pollfd file{terminal_, POLLIN, 0};
  if (::poll(&file, 1, timeout_ms) <= 0) return false;
  char buffer[4096];
  const ssize_t count = ::read(terminal_, buffer, sizeof buffer);
  if (count <= 0) return false;
  all_.append(buffer, static_cast<std::size_t>(count));
  return true;
}

std::string TerminalSession::wait_for(const std::string& text) {
  const auto end = Clock::now() + patience;
  for (;;) {
    const auto found = all_.find(text, seen_);
    if (found != std::string::npos) {
      const std::string part = all_.substr(seen_, found + text.size() - seen_);
      seen_ = found + text.size();
      return part;
    }
    const bool alive = read_some(milliseconds_until(end));
    if (!alive) FAIL("waited for '" << text << "', got: " << all_.substr(seen_) << "\nwhole session: " << all_);
  }
}

int TerminalSession::finish() {
  const auto end = Clock::now() + patience;
  while (read_some(milliseconds_until(end))) {
  }
  int status = 0;
  if (Clock::now() >= end) ::kill(child_, SIGKILL);
  ::waitpid(child_, &status, 0);
  child_ = -1;
  return exit_code(status);
}

Folder::Folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "tendril_test_XXXXXX").string();
  REQUIRE(::mkdtemp(pattern.data()) != nullptr);
  path_ = pattern;
}

Folder::~Folder() {
  std::error_code error;
  std::filesystem::remove_all(path_, error);
}

std::string Folder::file(const std::string& name, const std::string& content) const {
  const std::filesystem::path path = std::filesystem::path(path_) / name;
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << content;
  return path.string();
}

}  // namespace cli
