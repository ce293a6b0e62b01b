#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "client/trc/connection.h"
#include "client/trc/failure.h"
#include "core/messages/diagnostic_text.h"  // for who reads the diagnostics in the answers
#include "core/session/answers.h"
#include "proto/wire/path_item.h"
#include "trc/v1/setup.pb.h"

namespace trc::client {

// An NC program compensated by a server, used as trc::ProgramSession is: feed, finish, Answers;
// `failure` and `summary` are its own. One thread at a time.
//
// At most the number of chunks the server allows is unanswered, so that neither
// side holds more than a few messages.
class RemoteProgramSession {
 public:
  // Opens the stream; what is wrong with the setup shows in the first `feed`.
  RemoteProgramSession(const Connection& connection, const v1::ProgramSetup& setup);
  // Cancels a stream that has not finished.
  ~RemoteProgramSession();
  RemoteProgramSession(const RemoteProgramSession&) = delete;
  RemoteProgramSession& operator=(const RemoteProgramSession&) = delete;

  // Sends text, cut anywhere, and appends what has become certain. Returns
  // false once the stream has ended; `failure` then says why.
  bool feed(std::string_view text, Answers& out);
  // End of the text: appends all that was held back. Returns whether the
  // program was compensated completely.
  bool finish(Answers& out);

  // Where the server measures the path (`verify`): from now on `measuring` is told now and then how
  // many of its blocks have been, of how many, in the thread that uses the session.
  void tell_measuring(std::function<void(std::uint64_t measured, std::uint64_t all)> measuring);

  [[nodiscard]] const std::optional<Failure>& failure() const;
  // How often the stream was lost and another one has gone on.
  [[nodiscard]] std::uint64_t resumed() const;
  // Release and commit of the server, as in "0.1.0+0123456789ab"; empty before it has accepted the
  // stream.
  [[nodiscard]] const std::string& core_version() const;
  // Of a complete run only.
  [[nodiscard]] const std::optional<wire::ProgramSummary>& summary() const;
  // The record of the job as JSON (job_record.schema.json), to be filed as it is, where the setup
  // asks for it: of a complete run, or of a program that is refused. Else empty.
  [[nodiscard]] const std::string& record() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace trc::client
