#include "client/cli/signals.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <iostream>
#include <system_error>

namespace trc::cli {
namespace {

// Ends of a pipe: the handler writes, the program reads.
std::array<int, 2> ends{-1, -1};

extern "C" void tell(int signal_number) {
  const int before = errno;
  const auto number = static_cast<unsigned char>(signal_number);
  // If the pipe is full, its bytes wake the reader anyway.
  [[maybe_unused]] const ssize_t written = ::write(ends[1], &number, 1);
  errno = before;
}

}  // namespace

Signals::Signals() {
  if (::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0)
    throw std::system_error(errno, std::generic_category(), "no pipe for signals");
  struct sigaction action {};
  action.sa_handler = tell;
  action.sa_flags = SA_RESTART;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    Former former{.number = number};
    ::sigaction(number, nullptr, &former.action);
    if (former.action.sa_handler == SIG_IGN) continue;
    ::sigaction(number, &action, nullptr);
    former_.push_back(former);
  }
}

Signals::~Signals() {
  for (const Former& former : former_) ::sigaction(former.number, &former.action, nullptr);
  for (int& end : ends) {
    ::close(end);
    end = -1;
  }
}

int Signals::descriptor() const { return ends[0]; }

int Signals::take() {
  int asked = 0;
  std::array<unsigned char, 256> told{};
  for (ssize_t size = 0; (size = ::read(ends[0], told.data(), told.size())) > 0;)
    asked = told[static_cast<std::size_t>(size) - 1];
  return asked;
}

void end_by(int signal_number) {
  std::cout.flush();
  std::cerr.flush();
  ::signal(signal_number, SIG_DFL);
  ::raise(signal_number);
  constexpr int by_signal = 128;
  std::_Exit(by_signal + signal_number);
}

}  // namespace trc::cli
