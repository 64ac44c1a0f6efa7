#include "shell/key_input.h"

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <utility>

#include "shell/interrupts.h"

namespace tendril::shell {
namespace {

constexpr unsigned char escape = 0x1b;
constexpr int patience_ms = 50;  // between the bytes of one escape sequence

/// Waits for input with SIGINT let through only while waiting: one that comes earlier is seen by the check of the flag.
int wait_for_input(int file, int timeout_ms) {
  sigset_t only_interrupt, before;
  sigemptyset(&only_interrupt);
  sigaddset(&only_interrupt, SIGINT);
  sigprocmask(SIG_BLOCK, &only_interrupt, &before);
  int ready = -1;
  if (Interrupts::flag()) {
    errno = EINTR;
  } else {
    pollfd watched{file, POLLIN, 0};
    const timespec limit{timeout_ms / 1000, (timeout_ms % 1000) * 1'000'000L};
    ready = ::ppoll(&watched, 1, timeout_ms < 0 ? nullptr : &limit, &before);
  }
  const int reason = errno;
  sigprocmask(SIG_SETMASK, &before, nullptr);
  errno = reason;
  return ready;
}

int continuation_bytes(unsigned char lead) {
  if (lead >= 0xF0 && lead < 0xF8) return 3;
  if (lead >= 0xE0) return lead < 0xF0 ? 2 : -1;
  return lead >= 0xC2 ? 1 : -1;
}

std::string normal_newlines(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') continue;
    result += text[i] == '\r' ? '\n' : text[i];
  }
  return result;
}

}  // namespace

KeyInput::Got KeyInput::byte(unsigned char& b, int timeout_ms) {
  if (!waiting_.empty()) {
    b = waiting_.front();
    waiting_.pop_front();
    return Got::character;
  }
  for (;;) {
    const int ready = wait_for_input(file_, timeout_ms);
    if (ready == 0) return Got::end;
    if (ready > 0) {
      const ssize_t count = ::read(file_, &b, 1);
      if (count == 1) return Got::character;
      if (count == 0 || errno != EINTR) return Got::end;
    } else if (errno != EINTR) {
      return Got::end;
    }
    if (Interrupts::flag()) return Got::interrupted;
    if (on_signal_) on_signal_();
  }
}

/// True when the next bytes are `sequence`, which are then consumed; else they stay.
bool KeyInput::follows(const char* sequence) {
  std::string seen;
  for (const char* expected = sequence; *expected; ++expected) {
    unsigned char b = 0;
    const bool got = byte(b, patience_ms) == Got::character;
    if (got) seen += static_cast<char>(b);
    if (!got || b != static_cast<unsigned char>(*expected)) {
      waiting_.insert(waiting_.begin(), seen.begin(), seen.end());
      return false;
    }
  }
  return true;
}

KeyInput::Got KeyInput::read_paste() {
  static const std::string end = "\033[201~";
  std::string pasted;
  while (!pasted.ends_with(end)) {
    unsigned char b = 0;
    if (const Got got = byte(b); got != Got::character) return got;
    pasted += static_cast<char>(b);
  }
  pasted.resize(pasted.size() - end.size());
  deliver(normal_newlines(pasted));
  return Got::character;
}

void KeyInput::deliver(const std::string& pasted) {
  const auto first = pasted.find('\n'), last = pasted.rfind('\n');
  std::string typed = pasted;
  if (first != last) {
    if (!block_.empty()) block_ += '\n';
    block_ += pasted.substr(first + 1, last - first - 1);
    typed = pasted.substr(0, first) + pasted.substr(last);
  }
  std::string keys;
  for (const char c : typed) {
    if (c == '\t') keys += "  ";
    else if (c == '\n' || (static_cast<unsigned char>(c) >= 32 && c != 127)) keys += c;
  }
  waiting_.insert(waiting_.begin(), keys.begin(), keys.end());
}

std::string KeyInput::take_block() { return std::exchange(block_, {}); }

KeyInput::Got KeyInput::next(wchar_t& character) {
  unsigned char lead = 0;
  for (;;) {
    if (const Got got = byte(lead); got != Got::character) return got;
    if (lead != escape || !follows("[200~")) break;
    if (const Got got = read_paste(); got != Got::character) return got;
  }
  character = lead;
  if (lead < 0x80) return Got::character;
  int more = continuation_bytes(lead);
  if (more < 0) {
    character = 0xFFFD;
    return Got::character;
  }
  wchar_t code = lead & (0x3F >> more);
  for (; more > 0; --more) {
    unsigned char b = 0;
    if (const Got got = byte(b, patience_ms); got != Got::character || (b & 0xC0) != 0x80) {
      if (got == Got::character) waiting_.push_front(b);
      character = 0xFFFD;
      return Got::character;
    }
    code = (code << 6) | (b & 0x3F);
  }
  character = code;
  return Got::character;
}

}  // namespace tendril::shell
