// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/view/http_connection.h"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/string.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/write.hpp>
#include <limits>
#include <sstream>

#include "stages/tools/view/connection_table.h"

namespace roomcut::view {

namespace asio = boost::asio;
namespace http = boost::beast::http;

namespace {

constexpr std::size_t kPiece = std::size_t{64}
                               << 10U;  ///< of a file that is sent, of what is drained [bytes]

template <class Name>
std::vector<std::string> values(const http::fields& fields, const Name& name) {
  std::vector<std::string> result;
  const auto [begin, end] = fields.equal_range(name);
  for (auto field = begin; field != end; ++field) {
    result.emplace_back(field->value());
  }
  return result;
}

RequestHead head_of(const http::request_header<>& request) {
  return {std::string(request.method_string()),           values(request, http::field::host),
          values(request, http::field::origin),           values(request, kMarkHeader),
          values(request, http::field::content_length),   values(request, http::field::transfer_encoding),
          values(request, http::field::content_encoding), values(request, http::field::content_type)};
}

/// The answer's status line and headers. What holds for every answer: no framing, sniffing or storing.
std::string head_text(const HttpAnswer& answer, std::uint64_t length) {
  http::response<http::empty_body> head{static_cast<http::status>(answer.status), 11};
  head.set(http::field::cache_control, "no-store");
  head.set("X-Content-Type-Options", "nosniff");
  head.set("Cross-Origin-Resource-Policy", "same-origin");
  head.set("Content-Security-Policy", "frame-ancestors 'none'");
  head.set("Referrer-Policy", "no-referrer");
  head.set(http::field::connection, "close");
  head.set(http::field::content_type, answer.media_type);
  head.set(http::field::content_length, std::to_string(length));
  if (!answer.content_range.empty()) {
    head.set(http::field::content_range, answer.content_range);
  }
  std::ostringstream text;
  text << head.base();
  return text.str();
}

/// The answer to a request that cannot be read.
HttpAnswer unreadable(const boost::system::error_code& error) {
  if (error == http::error::header_limit || error == http::error::buffer_overflow) {
    return error_answer(431, "the request line and its headers are larger than " +
                                 std::to_string(HttpConnection::kLargestHead >> 10U) + " KiB");
  }
  if (error == http::error::bad_content_length) {
    return error_answer(411, "a body must say its length (Content-Length), once, at most " +
                                 std::to_string(kLargestBody >> 20U) + " MiB");
  }
  return error_answer(400, "this is no request of HTTP/1.1: " + error.message());
}

}  // namespace

HttpConnection::HttpConnection(asio::ip::tcp::socket socket, ConnectionTable& table,
                               const HttpService& service)
    : socket_(std::move(socket)),
      timer_(socket_.get_executor()),
      table_(table),
      service_(service),
      buffer_(std::max(kPiece, 2 * kLargestHead)),
      waits_since_(table.next_step()) {}

auto HttpConnection::then(Step step) {
  return [self = shared_from_this(), this, step](const Error& error, std::size_t count) {
    (this->*step)(error, count);
  };
}

void HttpConnection::wait_at_most(std::chrono::seconds time) {
  late_ = false;
  waits_since_ = table_.next_step();
  timer_.expires_after(time);
  timer_.async_wait([self = shared_from_this(), this, round = ++round_](const Error& error) {
    if (!error && round == round_) {
      late_ = true;
      Error ignored;
      socket_.cancel(ignored);
    }
  });
}

void HttpConnection::start() {
  asio::post(socket_.get_executor(), [self = shared_from_this(), this] { read_head(); });
}

void HttpConnection::make_room() {
  asio::post(socket_.get_executor(), [self = shared_from_this(), this] {
    unwanted_ = true;
    Error ignored;
    if (phase_ == Phase::kHead || phase_ == Phase::kBody) {
      socket_.cancel(ignored);
    } else {
      finish();
    }
  });
}

void HttpConnection::read_head() {
  parser_.header_limit(kLargestHead);
  parser_.body_limit(std::numeric_limits<std::uint64_t>::max());  // refuse() bounds it
  wait_at_most(kHeadTime);
  http::async_read_header(socket_, buffer_, parser_, then(&HttpConnection::on_head));
}

/// Whether the request did not arrive; then it is answered, if somebody is there to take an answer.
bool HttpConnection::interrupted(const Error& error) {
  if (unwanted_) {
    answer(error_answer(503, "there are too many connections; try again"));
  } else if (late_) {
    answer(error_answer(408, "the request took too long to arrive"));
  } else if (error && error != http::error::end_of_stream && error != http::error::partial_message &&
             error.category() == make_error_code(http::error::end_of_stream).category()) {
    answer(unreadable(error));
  } else if (error) {
    finish();
  } else {
    return false;
  }
  return true;
}

void HttpConnection::on_head(const Error& error, std::size_t /*count*/) {
  if (interrupted(error)) {
    return;
  }
  const http::request_header<>& head = parser_.get().base();
  request_.head = head_of(head);
  if (const auto refusal = service_.refuse(request_.head)) {
    answer(error_answer(refusal->status, refusal->why));
    return;
  }
  const std::string target(head.target());
  request_.path = target.substr(0, target.find('?'));
  request_.range = std::string(head[http::field::range]);
  body_size_ = request_.head.method == "GET" || request_.head.method == "HEAD"
                   ? 0
                   : static_cast<std::size_t>(parser_.content_length().value_or(0));
  if (body_size_ == 0) {
    handle();
    return;
  }
  phase_ = Phase::kBody;
  table_.begin_body(*this);
  wait_at_most(kBodyTime);
  if (boost::beast::iequals(head[http::field::expect], "100-continue")) {
    piece_ = "HTTP/1.1 100 Continue\r\n\r\n";
    asio::async_write(socket_, asio::buffer(piece_), then(&HttpConnection::read_body));
  } else {
    read_body({}, 0);
  }
}

void HttpConnection::read_body(const Error& error, std::size_t /*count*/) {
  if (!interrupted(error)) {
    http::async_read(socket_, buffer_, parser_, then(&HttpConnection::on_body));
  }
}

void HttpConnection::on_body(const Error& error, std::size_t /*count*/) {
  if (!interrupted(error)) {
    request_.body = std::move(parser_.get().body());
    handle();
  }
}

void HttpConnection::handle() {
  phase_ = Phase::kHandled;
  ++round_;  // nobody waits for the peer now
  waits_since_ = std::numeric_limits<std::uint64_t>::max();
  timer_.cancel();
  answer(service_.handle(std::move(request_)));
}

void HttpConnection::answer(HttpAnswer with) {
  phase_ = Phase::kAnswer;
  body_size_ = 0;
  answer_ = std::move(with);
  const std::uint64_t length = answer_.file ? answer_.length : answer_.text.size();
  piece_ = head_text(answer_, length);
  if (parser_.get().method() == http::verb::head) {
    answer_.length = 0;
  } else if (!answer_.file) {
    piece_ += answer_.text;
  }
  wait_at_most(kPieceTime);
  asio::async_write(socket_, asio::buffer(piece_), then(&HttpConnection::on_piece));
}

void HttpConnection::on_piece(const Error& error, std::size_t /*count*/) {
  if (error) {
    finish();
  } else if (!answer_.file || answer_.length == 0) {
    drain();
  } else {
    piece_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kPiece, answer_.length)));
    if (!answer_.file->read(answer_.offset, piece_.data(), piece_.size())) {
      finish();  // cut shorter under our hands: the peer misses bytes that were promised
      return;
    }
    answer_.offset += piece_.size();
    answer_.length -= piece_.size();
    wait_at_most(kPieceTime);
    asio::async_write(socket_, asio::buffer(piece_), then(&HttpConnection::on_piece));
  }
}

/// Takes what the peer still sends: closing over it would reset the connection, and the answer might be lost.
void HttpConnection::drain() {
  if (unwanted_) {
    finish();
    return;
  }
  phase_ = Phase::kDrain;
  Error ignored;
  socket_.shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
  piece_.resize(kPiece);
  wait_at_most(kDrainTime);
  socket_.async_read_some(asio::buffer(piece_), then(&HttpConnection::on_drained));
}

void HttpConnection::on_drained(const Error& error, std::size_t count) {
  drained_ += count;
  if (error || drained_ > 2 * kLargestBody) {
    finish();
  } else {
    socket_.async_read_some(asio::buffer(piece_), then(&HttpConnection::on_drained));
  }
}

void HttpConnection::finish() {
  ++round_;
  timer_.cancel();
  Error ignored;
  socket_.close(ignored);
  table_.leave(*this);
}

}  // namespace roomcut::view
