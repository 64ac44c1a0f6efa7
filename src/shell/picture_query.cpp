#include "shell/picture_query.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "base/error.h"

namespace tendril::shell {
namespace {

constexpr const char* who_can = " (kitty, Ghostty, Konsole, iTerm2, WezTerm and terminals with sixels do)";

std::string variable(const char* value) { return value ? value : ""; }

/// What TENDRIL_PICTURES asks for, if anything.
std::optional<PictureProtocol> asked_for() {
  const std::string wanted = variable(std::getenv("TENDRIL_PICTURES"));
  if (wanted.empty()) return std::nullopt;
  if (wanted == "kitty") return PictureProtocol::kitty;
  if (wanted == "iterm") return PictureProtocol::iterm;
  if (wanted == "sixel") return PictureProtocol::sixel;
  if (wanted == "none") return PictureProtocol::none;
  throw UsageError("TENDRIL_PICTURES: got '" + wanted + "', expected kitty, iterm, sixel or none");
}

/// By the names that terminals give themselves. Within tmux or screen they are those of the terminal outside, which is not
/// reached by what is printed here.
PictureProtocol by_environment() {
  const std::string type = variable(std::getenv("TERM")), program = variable(std::getenv("TERM_PROGRAM"));
  if (std::getenv("TMUX") || std::getenv("STY") || type.starts_with("screen") || type.starts_with("tmux")) return PictureProtocol::none;
  const bool kitty = type.find("kitty") != std::string::npos || type.find("ghostty") != std::string::npos || program == "ghostty" ||
                     std::getenv("KITTY_WINDOW_ID") || std::getenv("KONSOLE_VERSION");
  if (kitty) return PictureProtocol::kitty;
  const bool iterm = program == "iTerm.app" || program == "WezTerm" || variable(std::getenv("LC_TERMINAL")) == "iTerm2";
  return iterm ? PictureProtocol::iterm : PictureProtocol::none;
}

/// The terminal without line editing and echo while this lives.
class RawInput {
 public:
  RawInput() {
    changed_ = ::tcgetpgrp(STDIN_FILENO) == ::getpgrp() && ::tcgetattr(STDIN_FILENO, &before_) == 0;
    if (!changed_) return;
    termios raw = before_;
    raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    raw.c_cc[VMIN] = 0;
    raw.c_cc[VTIME] = 0;
    changed_ = ::tcsetattr(STDIN_FILENO, TCSADRAIN, &raw) == 0;
  }
  ~RawInput() {
    if (changed_) ::tcsetattr(STDIN_FILENO, TCSADRAIN, &before_);
  }
  RawInput(const RawInput&) = delete;
  RawInput& operator=(const RawInput&) = delete;

  bool ok() const { return changed_; }

 private:
  termios before_{};
  bool changed_ = false;
};

/// Its cells' size and its attributes, in this order: whatever it leaves out, the attributes end the answer.
PictureAnswer ask_terminal() {
  const RawInput raw;
  if (!raw.ok()) return {};
  std::fputs("\033[16t\033[c", stdout);
  std::fflush(stdout);
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::milliseconds(500);
  std::string text;
  PictureAnswer answer;
  while (!(answer = picture_answer(text)).complete) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (left <= 0 || ::poll(&input, 1, static_cast<int>(left)) <= 0) break;
    char c = 0;  // one at a time: what was typed behind the answer stays
    if (::read(STDIN_FILENO, &c, 1) != 1) break;
    text += c;
  }
  return answer;
}

}  // namespace

PictureAnswer picture_answer(const std::string& text) {
  PictureAnswer answer;
  for (auto at = text.find("\033["); at != std::string::npos; at = text.find("\033[", at + 1)) {
    const auto end = text.find_first_not_of("0123456789;?", at + 2);
    if (end == std::string::npos) break;
    const std::string inside = text.substr(at + 2, end - at - 2);
    if (text[end] == 'c' && inside.starts_with('?')) {
      answer.complete = true;
      const std::string list = inside.substr(1) + ";";
      answer.sixels = list.find(";4;") != std::string::npos;  // the first number is the terminal's class
    } else if (text[end] == 't') {
      int height = 0, width = 0;
      const bool read = std::sscanf(inside.c_str(), "6;%4d;%4d", &height, &width) == 2;
      if (read && height > 0 && width > 0) answer.cell_height = height, answer.cell_width = width;
    }
  }
  return answer;
}

PictureQuery::Found PictureQuery::find(const Terminal& terminal) {
  if (!terminal.output || terminal.dumb) return {PictureProtocol::none, 0, 0, "standard output is no terminal that shows pictures"};
  const std::optional<PictureProtocol> asked = asked_for();
  if (asked == PictureProtocol::none) return {PictureProtocol::none, 0, 0, "TENDRIL_PICTURES is none"};
  if (asked) return {*asked, 0, 0, {}};
  if (const PictureProtocol named = by_environment(); named != PictureProtocol::none) return {named, 0, 0, {}};
  const PictureAnswer answer = terminal.input ? ask_terminal() : PictureAnswer{};
  if (answer.sixels) return {PictureProtocol::sixel, answer.cell_width, answer.cell_height, {}};
  return {PictureProtocol::none, 0, 0, std::string("this terminal shows no pictures") + who_can};
}

PictureTerminal PictureQuery::look(const Terminal& terminal) {
  if (!found_) found_ = find(terminal);
  PictureTerminal now;
  now.protocol = found_->protocol;
  now.why = found_->why;
  winsize size{};
  if (::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 0) {
    now.columns = size.ws_col;
    now.rows = size.ws_row;
    if (size.ws_xpixel >= size.ws_col && size.ws_ypixel >= size.ws_row) {
      now.cell_width = size.ws_xpixel / size.ws_col;
      now.cell_height = size.ws_ypixel / size.ws_row;
    }
  }
  if (found_->cell_width > 0) {
    now.cell_width = found_->cell_width;
    now.cell_height = found_->cell_height;
  }
  return now;
}

}  // namespace tendril::shell
