// Line editing by libedit: keys, history search, completion and pasted blocks.
#include <histedit.h>
#include <langinfo.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "shell/history.h"
#include "shell/interrupts.h"
#include "shell/key_input.h"
#include "shell/line_reader.h"

namespace tendril::shell {
namespace {

std::atomic<bool> terminal_changed{false};  // another size, or back in the foreground

void on_terminal_signal(int) { terminal_changed.store(true); }

/// Wide characters are shown only in a UTF-8 locale.
void use_utf8() {
  std::setlocale(LC_CTYPE, "");
  if (std::strcmp(nl_langinfo(CODESET), "UTF-8") != 0) std::setlocale(LC_CTYPE, "C.UTF-8");
}

std::string common_start(const std::vector<std::string>& names) {
  std::string start = names.front();
  for (const std::string& name : names) {
    const auto end = std::mismatch(start.begin(), start.end(), name.begin(), name.end()).first;
    start.erase(end, start.end());
  }
  return start;
}

std::string in_columns(const std::vector<std::string>& names) {
  std::size_t widest = 0;
  for (const std::string& name : names) widest = std::max(widest, name.size() + 2);
  winsize size{};
  const bool known = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  const std::size_t columns = std::max<std::size_t>(1, (known ? size.ws_col : 80) / widest);
  const std::size_t rows = (names.size() + columns - 1) / columns;
  std::string text;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t i = row; i < names.size(); i += rows)
      text += i + rows < names.size() ? names[i] + std::string(widest - names[i].size(), ' ') : names[i];
    text += '\n';
  }
  return text;
}

class LineEditor : public LineReader {
 public:
  LineEditor(Completer completer, const std::string& history_file)
      : completer_(std::move(completer)), input_(STDIN_FILENO, [this] { follow_terminal(); }), kept_(history_file) {
    use_utf8();
    editor_ = el_init("tendril", stdin, stdout, stderr);
    history_ = history_init();
    HistEvent event;
    ::history(history_, &event, H_SETSIZE, static_cast<int>(2 * History::most_lines));
    for (const std::string& line : kept_.lines()) ::history(history_, &event, H_ENTER, line.c_str());
    configure();
    watch_terminal();
  }

  ~LineEditor() override {
    std::signal(SIGWINCH, SIG_DFL);
    std::signal(SIGCONT, SIG_DFL);
    el_end(editor_);
    history_end(history_);
  }

  Line read(const char* prompt) override {
    prompt_ = prompt;
    outcome_ = KeyInput::Got::character;
    el_set(editor_, EL_PREP_TERM, 1);  // before the prompt is seen: a key typed at once is not the terminal's own
    bracketed_paste(true);
    int count = 0;
    const char* text = el_gets(editor_, &count);
    bracketed_paste(false);
    if (!text || count <= 0) {
      std::fputc('\n', stdout);
      std::fflush(stdout);
      if (outcome_ != KeyInput::Got::interrupted) return {Line::Kind::end, {}};
      el_reset(editor_);
      return {Line::Kind::interrupted, {}};
    }
    Line line{Line::Kind::text, std::string(text, static_cast<std::size_t>(count))};
    if (!line.text.empty() && line.text.back() == '\n') line.text.pop_back();
    if (const std::string block = input_.take_block(); !block.empty()) {
      echo(block);
      line.text += "\n" + block;
    }
    return line;
  }

  void remember(const std::string& line) override {
    if (line.find_first_not_of(" \t") == std::string::npos) return;
    const bool repeated = !kept_.lines().empty() && kept_.lines().back() == line;
    kept_.add(line);
    HistEvent event;
    if (!repeated) ::history(history_, &event, H_ENTER, line.c_str());
  }

 private:
  static LineEditor& of(EditLine* editor) {
    void* self = nullptr;
    el_get(editor, EL_CLIENTDATA, &self);
    return *static_cast<LineEditor*>(self);
  }

  static char* prompt_of(EditLine* editor) { return const_cast<char*>(of(editor).prompt_.c_str()); }

  static int next_character(EditLine* editor, wchar_t* character) {
    LineEditor& self = of(editor);
    self.outcome_ = self.input_.next(*character);
    if (self.outcome_ == KeyInput::Got::character) return 1;
    errno = self.outcome_ == KeyInput::Got::interrupted ? EINTR : 0;
    return self.outcome_ == KeyInput::Got::end ? 0 : -1;
  }

  static unsigned char complete_key(EditLine* editor, int) { return of(editor).complete(); }

  void configure() {
    el_set(editor_, EL_CLIENTDATA, this);
    el_set(editor_, EL_PROMPT, &prompt_of);
    el_set(editor_, EL_EDITOR, "emacs");
    el_set(editor_, EL_SIGNAL, 0);  // signals are the session's
    el_set(editor_, EL_HIST, ::history, history_);
    el_set(editor_, EL_GETCFN, &next_character);
    el_set(editor_, EL_ADDFN, "tendril-complete", "complete names", &complete_key);
    static constexpr const char* keys[][2] = {
        {"^I", "tendril-complete"},     {"^R", "em-inc-search-prev"},  {"\\e[3~", "ed-delete-next-char"},
        {"\\e[H", "ed-move-to-beg"},     {"\\e[F", "ed-move-to-end"},   {"\\e[1~", "ed-move-to-beg"},
        {"\\e[4~", "ed-move-to-end"},    {"\\eOH", "ed-move-to-beg"},   {"\\eOF", "ed-move-to-end"},
        {"\\e[1;5C", "em-next-word"},    {"\\e[1;5D", "ed-prev-word"},  {"^W", "ed-delete-prev-word"}};
    for (const auto& [key, action] : keys) el_set(editor_, EL_BIND, key, action, nullptr);
    el_source(editor_, nullptr);  // the user's ~/.editrc has the last word
  }

  void watch_terminal() {
    struct sigaction action {};
    action.sa_handler = on_terminal_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = 0;
    sigaction(SIGWINCH, &action, nullptr);
    sigaction(SIGCONT, &action, nullptr);
  }

  void follow_terminal() {
    if (!terminal_changed.exchange(false)) return;
    el_set(editor_, EL_PREP_TERM, 1);
    el_resize(editor_);
    el_set(editor_, EL_REFRESH);
  }

  static void bracketed_paste(bool on) {
    std::fputs(on ? "\033[?2004h" : "\033[?2004l", stdout);
    std::fflush(stdout);
  }

  static void echo(const std::string& block) {
    std::string shown = ">> ";
    for (const char c : block) {
      const bool printable = static_cast<unsigned char>(c) >= 32 && c != 127;
      if (c == '\n') shown += "\n>> ";
      else shown += c == '\t' || printable ? c : '?';
    }
    std::printf("%s\n", shown.c_str());
    std::fflush(stdout);
  }

  unsigned char complete() {
    const LineInfo* line = el_line(editor_);
    const std::string before(line->buffer, line->cursor);
    const Completion found = completer_(before);
    if (found.candidates.empty()) return CC_REFRESH_BEEP;
    const std::string start = common_start(found.candidates);
    if (start.size() > found.typed) {
      el_insertstr(editor_, start.c_str() + found.typed);
      return CC_REFRESH;
    }
    if (found.candidates.size() == 1) return CC_REFRESH_BEEP;
    std::printf("\n%s", in_columns(found.candidates).c_str());
    std::fflush(stdout);
    return CC_REDISPLAY;
  }

  Completer completer_;
  KeyInput input_;
  History kept_;
  EditLine* editor_ = nullptr;
  ::History* history_ = nullptr;
  std::string prompt_;
  KeyInput::Got outcome_ = KeyInput::Got::character;
};

}  // namespace

std::unique_ptr<LineReader> make_line_editor(Completer completer, const std::string& history_file) {
  return std::make_unique<LineEditor>(std::move(completer), history_file);
}

}  // namespace tendril::shell
