// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>

#include "stages/tools/view/connection_table.h"
#include "stages/tools/view/http_message.h"

namespace roomcut::view {

/// HTTP/1.1 on the loopback interface: kThreads threads for any number of connections (ConnectionTable), as
/// only a request that has arrived whole occupies one.
class HttpServer {
 public:
  static constexpr int kThreads = 4;

  explicit HttpServer(HttpService service);

  /// Binds 127.0.0.1:`port`, 0 = any free one; returns the port. Throws boost::system::system_error.
  int bind(int port);
  /// Answers requests until stop() is called by another thread.
  void serve();
  void stop();

 private:
  void accept();

  HttpService service_;
  boost::asio::io_context io_;
  ConnectionTable connections_;
  boost::asio::ip::tcp::acceptor acceptor_;
  boost::asio::steady_timer pause_;
};

}  // namespace roomcut::view
