// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/view/http_server.h"

#include <boost/asio/strand.hpp>
#include <thread>
#include <vector>

namespace roomcut::view {

namespace asio = boost::asio;

HttpServer::HttpServer(HttpService service)
    : service_(std::move(service)), io_(kThreads), acceptor_(io_), pause_(io_) {}

int HttpServer::bind(int port) {
  const asio::ip::tcp::endpoint address(asio::ip::address_v4::loopback(), static_cast<unsigned short>(port));
  acceptor_.open(address.protocol());
  acceptor_.set_option(
      asio::socket_base::reuse_address(true));  // not SO_REUSEPORT: that would share the port
  acceptor_.bind(address);
  acceptor_.listen();
  return acceptor_.local_endpoint().port();
}

void HttpServer::accept() {
  acceptor_.async_accept(
      asio::make_strand(io_), [this](const boost::system::error_code& error, asio::ip::tcp::socket socket) {
        if (!error) {
          const auto connection = std::make_shared<HttpConnection>(std::move(socket), connections_, service_);
          connections_.admit(connection);
          connection->start();
          accept();
        } else if (acceptor_.is_open()) {  // out of descriptors: some are free soon
          pause_.expires_after(std::chrono::milliseconds(50));
          pause_.async_wait([this](const boost::system::error_code& /*ended*/) { accept(); });
        }
      });
}

void HttpServer::serve() {
  accept();
  std::vector<std::jthread> threads;
  for (int i = 1; i < kThreads; ++i) {
    threads.emplace_back([this] { io_.run(); });
  }
  io_.run();
}

void HttpServer::stop() {
  io_.stop();
}

}  // namespace roomcut::view
