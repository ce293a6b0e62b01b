// A client for tests of faults: gives a program to a server slowly and writes down what comes back.
//
//   fault_client ADDRESS PROGRAM OUTPUT [PAUSE_MS [KEEPALIVE_MS]]
//
// Exit code 0: compensated; 1: not, the reason on standard error. The last line on standard output
// says how often the stream was resumed.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>

#include "client/trc/remote_program_session.h"

int main(int argc, char** argv) {
  using std::chrono::milliseconds;
  if (argc < 4) return 2;
  const milliseconds pause(argc > 4 ? std::atoi(argv[4]) : 0);
  trc::client::ConnectionOptions options;
  if (argc > 5) {
    options.keepalive_time = milliseconds(std::atoi(argv[5]));
    options.keepalive_timeout = options.keepalive_time;
    options.resume.longest_wait = options.keepalive_time;
  }
  std::optional<trc::client::Connection> connection;
  if (trc::client::Connection::open(argv[1], {}, connection, options)) return 2;

  std::ostringstream program;
  program << std::ifstream(argv[2], std::ios::binary).rdbuf();
  const std::string text = program.str();
  std::ofstream output(argv[3], std::ios::binary);
  trc::Answers answers([&](const trc::Answer& answer) {
    output << answer.text;
    return true;
  });

  trc::client::RemoteProgramSession session(*connection, {});
  constexpr std::size_t piece = 4096;
  bool goes_on = true;
  for (std::size_t at = 0; goes_on && at < text.size(); at += piece) {
    goes_on = session.feed(std::string_view(text).substr(at, piece), answers);
    if (at == 0) {
      std::puts("begun");
      std::fflush(stdout);
    }
    std::this_thread::sleep_for(pause);
  }
  const bool complete = session.finish(answers);
  std::printf("resumed %llu\n", static_cast<unsigned long long>(session.resumed()));
  if (complete) return 0;
  const auto& failure = session.failure();
  std::fprintf(stderr, "%s %s %s\n", failure->status.c_str(), failure->reason.c_str(),
               failure->message.c_str());
  return 1;
}
