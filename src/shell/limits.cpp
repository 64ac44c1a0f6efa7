#include "shell/limits.h"

#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

#include "base/error.h"
#include "shell/interrupts.h"

namespace tendril::shell {
namespace {

constexpr long grace = 2;  // s

// The shadow memory of a sanitizer counts as data, terabytes of it.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool has_shadow_memory = true;
#elif defined(__has_feature)
constexpr bool has_shadow_memory = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer);
#else
constexpr bool has_shadow_memory = false;
#endif

// A signal handler has no other way to its data.
std::atomic<bool> is_over{false};
char over_text[64];

itimerval once(double seconds) {
  const double whole = std::floor(seconds);
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(whole);
  timer.it_value.tv_usec = std::max<suseconds_t>(static_cast<suseconds_t>(1e6 * (seconds - whole)), whole > 0 ? 0 : 1);
  return timer;
}

void say(const char* text) { [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text, std::strlen(text)); }

void on_alarm(int) {
  if (is_over.exchange(true)) {
    say("tendril: ");
    say(over_text);
    say("\n");
    ::_exit(out_of_time);
  }
  Interrupts::strike();
  const itimerval timer{{0, 0}, {grace, 0}};
  ::setitimer(ITIMER_REAL, &timer, nullptr);
}

[[noreturn]] void end_with_words() {
  try {
    if (const auto failure = std::current_exception()) std::rethrow_exception(failure);
    say("tendril: ended by itself\n");
  } catch (const std::bad_alloc&) {
    say("tendril: not enough memory\n");
  } catch (const std::exception& error) {
    say("tendril: ");
    say(error.what());
    say("\n");
  } catch (...) {
    say("tendril: ended by an unknown exception\n");
  }
  ::_exit(1);
}

}  // namespace

std::size_t parse_size(const std::string& text, const std::string& who) {
  char* unit = nullptr;
  const double number = std::strtod(text.c_str(), &unit);
  const std::string known = "kmgt";
  const auto power = *unit ? known.find(static_cast<char>(std::tolower(static_cast<unsigned char>(*unit)))) : std::string::npos;
  const bool wrong = unit == text.c_str() || !(number >= 0 && number < 1e15) || (*unit && (power == std::string::npos || unit[1]));
  if (wrong) throw UsageError(who + ": got '" + text + "', expected a size such as 512M or 8G");
  return static_cast<std::size_t>(std::min(1e18, *unit ? number * double(1ull << (10 * (power + 1))) : number));
}

double parse_seconds(const std::string& text, const std::string& who) {
  char* end = nullptr;
  const double seconds = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end || !(seconds > 0 && seconds <= 1e8))
    throw UsageError(who + ": got '" + text + "', expected seconds, more than 0 and at most 1e8");
  return seconds;
}

std::size_t usual_memory_limit() {
  const double machine = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  return static_cast<std::size_t>(std::min(8.0 * (1ull << 30), machine > 0 ? 0.75 * machine : 8.0 * (1ull << 30)));
}

void limit_memory(std::size_t bytes) {
  std::set_terminate(end_with_words);
  if (has_shadow_memory) return;
  rlimit bound{};
  ::getrlimit(RLIMIT_DATA, &bound);
  bound.rlim_cur = std::min<rlim_t>(bytes, bound.rlim_max);
  bound.rlim_max = bound.rlim_cur;
  if (::setrlimit(RLIMIT_DATA, &bound) != 0) throw UsageError(std::string("the memory cannot be limited: ") + std::strerror(errno));
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
}

void limit_time(double seconds) {
  std::snprintf(over_text, sizeof over_text, "the time limit of %.6g s is reached", seconds);
  struct sigaction action {};
  action.sa_handler = on_alarm;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGALRM, &action, nullptr);
  const itimerval timer = once(seconds);
  ::setitimer(ITIMER_REAL, &timer, nullptr);
}

bool time_is_over() { return is_over.load(); }

const char* time_limit_text() { return over_text; }

}  // namespace tendril::shell
