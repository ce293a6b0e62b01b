#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl/context.hpp>
#include <memory>
#include <string>
#include <vector>

#include "server/http/memory.h"
#include "server/http/service.h"

namespace trc::server::http {

// One connection of HTTP/1.1: reads a request as a whole, has it handled, reads the next one. A
// request that comes slower than the limits allow, or is none, ends it.
struct NewConnection {
  boost::asio::ip::tcp::socket socket;
  std::shared_ptr<boost::asio::ssl::context> tls{};  // null: plain text
  std::vector<std::string> allowed_clients{};
  std::string peer{};
  std::shared_ptr<Memory> of_peer{};  // of the memory of all: what this client may have
};
// Lives until it is closed. The service and the memory must outlive it.
std::shared_ptr<OpenConnection> serve(NewConnection connection, Service& service, Memory& memory,
                                      const ConnectionLimits& limits);

}  // namespace trc::server::http
