#pragma once

#include <string>
#include <vector>

#include "client/cli/service.h"
#include "proto/wire/json_lines.h"
#include "trc/v1/path_item.pb.h"
#include "trc/v1/setup.pb.h"

namespace trc::cli {

// The result of a program in the form --format asks for: nc, jsonl or listing.
class ResultText {
 public:
  // Sets in the setup what the format needs.
  ResultText(const std::string& format, v1::ProgramSetup& setup);

  // Valid until the next call.
  [[nodiscard]] const std::string& of(const Answer& answer);
  // The last line of jsonl, else nothing: it holds times, which differ from run to run.
  [[nodiscard]] const std::string& of(const wire::PathSummary& summary);

 private:
  void add_json(const Answer& answer);
  void add_listing(const Answer& answer);

  bool as_json_;
  bool as_nc_;
  std::vector<std::string> axes_;
  int decimals_;
  wire::JsonLines lines_;
  v1::PathItem item_;
  std::string text_;
};

}  // namespace trc::cli
