// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/view/connection_table.h"

#include <algorithm>

namespace roomcut::view {

void ConnectionTable::admit(const std::shared_ptr<HttpConnection>& connection) {
  const std::scoped_lock lock(mutex_);
  open_.push_back(connection);
  if (open_.size() <= kMost) {
    return;
  }
  const auto first = std::min_element(open_.begin(), open_.end(), [](const auto& a, const auto& b) {
    return a->waits_since() < b->waits_since();
  });
  const std::shared_ptr<HttpConnection> gone = *first;
  open_.erase(first);
  gone->make_room();
}

void ConnectionTable::begin_body(const HttpConnection& connection) {
  const std::scoped_lock lock(mutex_);
  std::size_t total = 0;
  for (const auto& other : open_) {
    total += other->body_size();
  }
  for (const auto& other : open_) {
    if (total > kMostBodyBytes && other.get() != &connection &&
        other->phase() == HttpConnection::Phase::kBody) {
      total -= other->body_size();
      other->make_room();
    }
  }
}

void ConnectionTable::leave(const HttpConnection& connection) {
  const std::scoped_lock lock(mutex_);
  open_.remove_if([&](const auto& other) { return other.get() == &connection; });
}

}  // namespace roomcut::view
