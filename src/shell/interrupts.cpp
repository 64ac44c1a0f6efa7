#include "shell/interrupts.h"

#include <cerrno>
#include <csignal>
#include <ctime>

namespace tendril::shell {
namespace {

// A signal handler has no other way to its data.
std::atomic<bool> pending{false};
std::atomic<lua::Context*> target{nullptr};
std::atomic<int> presses{0};
std::atomic<long> first_press{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<lua::Context*>::is_always_lock_free);

long seconds_now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec;
}

void on_signal(int number) {
  const int saved = errno;
  pending.store(true);
  if (presses.fetch_add(1) == 0) first_press.store(seconds_now());
  if (presses.load() >= 3 && seconds_now() - first_press.load() >= 2) {
    std::signal(number, SIG_DFL);
    std::raise(number);
  }
  if (lua::Context* context = target.load()) lua::interrupt(*context);
  errno = saved;
}

}  // namespace

Interrupts::Interrupts(lua::Context& context) {
  context.cancel = &pending;
  target.store(&context);
  struct sigaction action {};
  action.sa_handler = on_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = 0;  // no SA_RESTART: a read that waits for input ends too
  sigaction(SIGINT, &action, nullptr);
}

Interrupts::~Interrupts() {
  std::signal(SIGINT, SIG_DFL);
  target.store(nullptr);
  clear();
}

const std::atomic<bool>& Interrupts::flag() { return pending; }

void Interrupts::strike() noexcept {
  pending.store(true);
  if (lua::Context* context = target.load()) lua::interrupt(*context);
}

void Interrupts::clear() {
  pending.store(false);
  presses.store(0);
}

}  // namespace tendril::shell
