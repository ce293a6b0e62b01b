#pragma once

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <string>
#include <thread>

#include "tests/server/calls.h"

namespace trc::faults {

// The socket of a service manager.
class ServiceManager {
 public:
  explicit ServiceManager(const std::string& path) : socket_(socket(AF_UNIX, SOCK_DGRAM, 0)) {
    sockaddr_un name{};
    name.sun_family = AF_UNIX;
    path.copy(name.sun_path, sizeof(name.sun_path) - 1);
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&name), sizeof(name)), 0);
  }
  ~ServiceManager() { close(socket_); }
  ServiceManager(const ServiceManager&) = delete;
  ServiceManager& operator=(const ServiceManager&) = delete;

  // Whether such a message comes.
  bool hears(const std::string& part) {
    return server::eventually([&] {
      listen();
      const std::size_t at = heard_.find(part);
      if (at == std::string::npos) return false;
      heard_.erase(0, at + part.size());
      return true;
    });
  }
  // Whether nothing comes for so long, from now on.
  bool hears_nothing_for(std::chrono::milliseconds time) {
    listen();
    heard_.clear();
    std::this_thread::sleep_for(time);
    listen();
    return heard_.empty();
  }

 private:
  void listen() {
    std::array<char, 512> message{};
    for (ssize_t size = 0;
         (size = recv(socket_, message.data(), message.size(), MSG_DONTWAIT)) > 0;)
      heard_ += std::string(message.data(), static_cast<std::size_t>(size)) + "\n";
  }

  int socket_;
  std::string heard_;
};

}  // namespace trc::faults
