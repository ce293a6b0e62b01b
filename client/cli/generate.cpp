#include <iostream>
#include <memory>

#include "client/cli/command.h"
#include "client/cli/files.h"
#include "client/cli/program_options.h"
#include "client/cli/speech.h"
#include "client/load/sample_program.h"

namespace trc::cli {
namespace {

struct Call {
  load::ShapeRequest request{.shape = "square"};
  std::string output;
  std::string language;
};

Exit run(const Call& call) {
  Output output(call.output);
  if (!output.open()) return Exit::wrong_call;
  bool written = true;
  const std::string fault = load::generate(call.request, [&](std::string_view text) {
    written = output.write(text);
    return written;
  });
  if (!fault.empty()) {
    complain(fault);
    return Exit::wrong_call;
  }
  return written && output.commit() ? Exit::done : Exit::wrong_call;
}

std::string list_of_shapes() {
  std::string text = "Shapes:\n";
  for (const load::ShapeRow& row : load::shapes())
    text += "  " + std::string(row.name) + std::string(10 - row.name.size(), ' ') +
            std::string(row.meaning) + "\n";
  return text;
}

}  // namespace

void add_generate(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand("generate", "Write a sample contour as an NC program");
  command->footer(
      list_of_shapes() +
      "The same shape, seed, radius and number of blocks give the same text everywhere.");
  auto call = std::make_shared<Call>();
  std::vector<std::string> names;
  for (const load::ShapeRow& row : load::shapes()) names.emplace_back(row.name);
  command->add_option("--shape", call->request.shape, "What is cut")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  command->add_option("--blocks", call->request.blocks, "Contour blocks")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{100'000'000}))
      ->capture_default_str();
  command->add_option("--seed", call->request.seed, "Which of the random contours")
      ->capture_default_str();
  command->add_option("--tool-radius", call->request.tool_radius, "mm")
      ->check(CLI::Range(0.1, 100.0))
      ->capture_default_str();
  command->add_option("-o,--output", call->output, "File to write; else standard output");
  add_language_option(*command, call->language);
  command->callback([call, &action] { action = [call] { return run(*call); }; });
}

}  // namespace trc::cli
