// Runs the real program: with pipes, or as a person at a terminal would.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace cli {

/// Variables set (or, when empty, removed) for the program on top of this process's own.
using Environment = std::map<std::string, std::string>;

struct Outcome {
  std::string out, err;
  int code = -1;  ///< exit code; 128 + signal when a signal ended it
};

/// Runs `tendril arguments...` to its end with `input` on standard input.
Outcome run(const std::vector<std::string>& arguments, const std::string& input = "", const Environment& environment = {});

/// Starts the program, sends it a signal `after` it has printed a line "ready", and waits for its end.
Outcome run_and_signal(const std::vector<std::string>& arguments, int signal, std::chrono::milliseconds after);

/// The same with SIGINT.
Outcome run_and_interrupt(const std::vector<std::string>& arguments, std::chrono::milliseconds after = {});

/// The program on a terminal of its own, 100 columns wide.
class TerminalSession {
 public:
  explicit TerminalSession(const std::vector<std::string>& arguments, const Environment& environment = {});
  ~TerminalSession();
  TerminalSession(const TerminalSession&) = delete;
  TerminalSession& operator=(const TerminalSession&) = delete;

  void type(const std::string& keys);

  /// Waits until the output since the last wait contains `text`; returns that output, or fails the test.
  std::string wait_for(const std::string& text);

  /// Everything the program wrote so far.
  const std::string& transcript() const { return all_; }

  /// Waits for the end of the program: its exit code.
  int finish();

 private:
  bool read_some(int timeout_ms);

  pid_t child_ = -1;
  int terminal_ = -1;
  std::string all_;
  std::size_t seen_ = 0;
};

/// A folder that is removed with everything in it.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// Writes a file and returns its path.
  std::string file(const std::string& name, const std::string& content) const;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace cli
