#include <sys/wait.h>
#include <unistd.h>

#include <cctype>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "client/cli/command.h"
#include "client/cli/files.h"
#include "client/cli/program_options.h"
#include "client/cli/speech.h"
#include "proto/wire/settings.h"
#include "server/http/view/store.h"
#include "server/net/address.h"
#include "server/server.h"

namespace trc::cli {
namespace {

struct Call {
  ProgramOptions program;
  std::string listen = "127.0.0.1:0";
  bool no_browser = false;
};

std::string percent_encoded(std::string_view text) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string encoded;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '.' || c == '-' || c == '_') {
      encoded += c;
      continue;
    }
    encoded += '%';
    encoded += digits[byte >> 4U];
    encoded += digits[byte & 15U];
  }
  return encoded;
}

void append(std::string& query, std::string_view name, std::string_view value) {
  if (!query.empty()) query += '&';
  query += percent_encoded(name) + '=' + percent_encoded(value);
}

// The settings as query parameters of the page.
std::string query_of(const v1::ProgramSetup& setup, const ProgramOptions& options) {
  std::string query;
  for (const std::string& assignment : wire::assignments_of(setup)) {
    const std::size_t equals = assignment.find('=');
    append(query, assignment.substr(0, equals), assignment.substr(equals + 1));
  }
  if (!options.dialect.empty()) append(query, "dialect", options.dialect);
  if (!options.unit.empty()) append(query, "unit", options.unit);
  if (!options.unknown_words.empty()) append(query, "unknown_words", options.unknown_words);
  if (!options.whole_numbers.empty()) append(query, "whole_numbers", options.whole_numbers);
  return query;
}

// Does not wait for the browser; without xdg-open the user has the printed address.
void open_browser(const std::string& address) {
  const pid_t child = fork();
  if (child != 0) return;
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  setsid();
  execlp("xdg-open", "xdg-open", address.c_str(), nullptr);
  _exit(1);
}

Exit run(const Call& call) {
  v1::ProgramSetup setup;
  if (!setup_of(call.program, setup)) return Exit::wrong_call;
  if (server::split_host_port(call.listen) && !server::is_local_address(call.listen)) {
    complain("--listen " + call.listen +
             ": the page is for this machine alone; trcd --http-listen serves others");
    return Exit::wrong_call;
  }
  Input input(call.program.file);
  if (!input.open()) return Exit::wrong_call;
  std::string text;
  for (std::string_view piece = input.read(); !piece.empty(); piece = input.read()) text += piece;
  if (input.failed()) return Exit::wrong_call;

  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);

  server::Config config;
  config.log_level = "off";
  config.http_listen = call.listen;
  if (const auto fault = server::first_fault(config)) {
    complain(*fault);
    return Exit::wrong_call;
  }
  const std::string token = server::http::ViewStore::new_id();
  const std::string name = std::filesystem::path(input.name()).filename().string();
  auto [server, fault, misconfigured] =
      server::Server::start_http(config, {.token = token,
                                          .name = percent_encoded(name),
                                          .settings = query_of(setup, call.program),
                                          .text = std::move(text)});
  if (server == nullptr) {
    complain(fault);
    return Exit::wrong_call;
  }
  const std::string host = call.listen.substr(0, call.listen.rfind(':'));
  const std::string address =
      "http://" + host + ":" + std::to_string(server->http_port()) + "/?offer=" + token;
  std::cout << address << std::endl;
  const bool has_desk =
      std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  if (!call.no_browser && has_desk) open_browser(address);
  int signal = 0;
  sigwait(&signals, &signal);
  return Exit::done;
}

}  // namespace

void add_view(CLI::App& app, Action& action) {
  auto* command = app.add_subcommand(
      "view",
      "Show a program and its path in a browser: serves a page on this machine until "
      "interrupted");
  auto call = std::make_shared<Call>();
  command->add_option("file", call->program.file, "NC program; - reads standard input")
      ->type_name("FILE")
      ->required();
  add_settings_options(*command, call->program);
  command->add_option("--listen", call->listen, "Address of the page; port 0 takes a free one")
      ->type_name("HOST:PORT")
      ->capture_default_str();
  command->add_flag("--no-browser", call->no_browser, "Print the address only");
  command->footer(settings_help(Language::english));
  command->callback([call, &action] { action = [call] { return run(*call); }; });
}

}  // namespace trc::cli
