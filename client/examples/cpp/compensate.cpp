// compensate ADDRESS FILE: writes the program with TRC resolved to standard output and its
// diagnostics to standard error. If the server is lost, the library waits for it and resumes the
// stream.

#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>

#include "client/trc/remote_program_session.h"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: compensate ADDRESS FILE\n";
    return 2;
  }
  std::ostringstream program;
  program << std::ifstream(argv[2], std::ios::binary).rdbuf();

  std::optional<trc::client::Connection> connection;
  if (const auto failure = trc::client::Connection::open(argv[1], {}, connection)) {
    std::cerr << failure->message << '\n';
    return 2;
  }
  trc::client::RemoteProgramSession session(*connection, {});
  trc::Answers print([](const trc::Answer& answer) {
    std::cout << answer.text;
    for (const trc::Diagnostic& told : answer.diagnostics)
      std::cerr << "line " << told.source.line << ": " << static_cast<int>(told.code) << ' '
                << trc::texts_of(told).message << '\n';
    return true;
  });
  session.feed(program.str(), print);
  if (session.finish(print)) return 0;
  std::cerr << session.failure()->message << '\n';
  return 1;
}
