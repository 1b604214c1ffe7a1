// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/string_body.hpp>
#include <chrono>
#include <memory>
#include <string>

#include "stages/tools/view/http_message.h"

namespace roomcut::view {

class ConnectionTable;

/// One connection, one request, one answer. Waits for its peer without a thread, and never for long: the head
/// must have arrived within kHeadTime, the body within kBodyTime, each piece of the answer must be taken
/// within kPieceTime. What is too late, too large or no HTTP gets an answer that says so (408, 431, 413,
/// 400).
class HttpConnection : public std::enable_shared_from_this<HttpConnection> {
 public:
  static constexpr std::size_t kLargestHead = std::size_t{16} << 10U;  ///< request line and headers [bytes]
  static constexpr std::chrono::seconds kHeadTime{5}, kBodyTime{10}, kPieceTime{15}, kDrainTime{2};

  enum class Phase { kHead, kBody, kHandled, kAnswer, kDrain };

  HttpConnection(boost::asio::ip::tcp::socket socket, ConnectionTable& table, const HttpService& service);
  void start();
  /// Ends it, with 503 when it has no answer yet. From any thread.
  void make_room();
  Phase phase() const { return phase_; }
  /// Number of the step that it waits with for its peer, ascending over all connections; the largest number
  /// while the request is worked on.
  std::uint64_t waits_since() const { return waits_since_; }
  /// Size of a body that is on its way or at work [bytes].
  std::size_t body_size() const { return body_size_; }

 private:
  using Error = boost::system::error_code;
  using Step = void (HttpConnection::*)(const Error&, std::size_t);

  auto then(Step step);
  void wait_at_most(std::chrono::seconds time);
  void read_head();
  void on_head(const Error& error, std::size_t);
  void read_body(const Error& error, std::size_t);
  void on_body(const Error& error, std::size_t);
  bool interrupted(const Error& error);
  void handle();
  void answer(HttpAnswer with);
  void on_piece(const Error& error, std::size_t);
  void drain();
  void on_drained(const Error& error, std::size_t count);
  void finish();

  boost::asio::ip::tcp::socket socket_;
  boost::asio::steady_timer timer_;
  ConnectionTable& table_;
  const HttpService& service_;
  boost::beast::flat_buffer buffer_;
  boost::beast::http::request_parser<boost::beast::http::string_body> parser_;
  std::atomic<Phase> phase_{Phase::kHead};
  std::atomic<std::size_t> body_size_{0};
  std::atomic<std::uint64_t> waits_since_;
  HttpRequest request_;
  HttpAnswer answer_;
  std::string piece_;
  std::size_t drained_ = 0;
  unsigned round_ = 0;  ///< of the timer: one that fires late must not end the next step
  bool late_ = false, unwanted_ = false;
};

}  // namespace roomcut::view
