// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interrupt.h"

#include <unistd.h>

#include <csignal>
#include <ctime>
#include <string_view>

namespace unseen::cli {
namespace {

sigset_t signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  struct sigaction hangup;
  if (sigaction(SIGHUP, nullptr, &hangup) == 0 && hangup.sa_handler != SIG_IGN) sigaddset(&set, SIGHUP);  // else nohup has it ignored
  return set;
}

void say(std::string_view text) {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

/// Waits for the signals, which all other threads have blocked: unlike in a handler, anything may be called.
void watch(const std::stop_token& end, std::stop_source run) {
  const sigset_t set = signals();
  const timespec nap = {0, 50'000'000};
  while (!end.stop_requested()) {
    const int sent = sigtimedwait(&set, nullptr, &nap);
    if (sent < 0 || (run.stop_requested() && sent == SIGHUP)) continue;  // a terminal that closes may say so twice
    if (run.stop_requested()) _exit(130);
    run.request_stop();
    say("\nunseen: stopping; once more kills\n");
  }
}

}  // namespace

Interrupt::Interrupt() {
  const sigset_t set = signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  watcher_ = std::jthread([run = source_](const std::stop_token& end) { watch(end, run); });
}

Interrupt::~Interrupt() {
  watcher_.request_stop();
  watcher_.join();
  const sigset_t set = signals();
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

}  // namespace unseen::cli
