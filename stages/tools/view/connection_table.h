// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>

#include "stages/tools/view/http_connection.h"

namespace roomcut::view {

/// The connections that are open, in the order of their arrival. Where there are too many, the one that has
/// waited longest for its peer makes room, so that connections that nothing comes from, or nothing is taken
/// from, cannot hold up those that ask something. Thread-safe.
class ConnectionTable {
 public:
  static constexpr std::size_t kMost = 64;                               ///< connections
  static constexpr std::size_t kMostBodyBytes = std::size_t{64} << 20U;  ///< of all bodies together

  void admit(const std::shared_ptr<HttpConnection>& connection);
  /// Says that `connection` begins to read a body: others make room until all bodies fit, where they can.
  void begin_body(const HttpConnection& connection);
  void leave(const HttpConnection& connection);
  /// Numbers the steps of all connections, so that nobody needs a clock to tell who waits longest.
  std::uint64_t next_step() { return ++steps_; }

 private:
  std::atomic<std::uint64_t> steps_{0};
  std::mutex mutex_;
  std::list<std::shared_ptr<HttpConnection>> open_;
};

}  // namespace roomcut::view
