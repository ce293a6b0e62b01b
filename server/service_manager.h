#pragma once

#include <chrono>

namespace trc::server {

// Notifications to systemd if it has started the server (Type=notify-reload), else nothing.
namespace service_manager {

void ready();
void reloading();
void stopping();
// Asks for as much time again, from now on.
void alive();
// How often `alive` has to be said; 0: never.
[[nodiscard]] std::chrono::microseconds watchdog_interval();

}  // namespace service_manager
}  // namespace trc::server
