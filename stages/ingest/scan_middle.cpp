// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/ingest/scan_middle.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>

namespace roomcut::ingest {

namespace {

constexpr double kSteps = 1 << 28;  // in the reach: sums of 3e10 points fit into 64 bits

class FirstError {
 public:
  bool before(std::size_t index) const { return index > earliest_.load(std::memory_order_relaxed); }
  void note(std::size_t index) {
    const std::scoped_lock lock(mutex_);
    if (index < earliest_) {
      earliest_ = index;
      error_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (error_) {
      std::rethrow_exception(error_);
    }
  }

 private:
  std::mutex mutex_;
  std::atomic<std::size_t> earliest_{static_cast<std::size_t>(-1)};
  std::exception_ptr error_;
};

double median_or_zero(std::vector<double> values, double largest) {
  std::erase_if(values, [largest](double value) { return !(std::abs(value) < largest); });
  if (values.empty()) {
    return 0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Sums {
  std::int64_t points = 0;
  std::array<std::int64_t, 3> steps{};
};

void add_points(const ScanBlock& block, const Vec3& centre, double reach, Sums& sums) {
  const double scale = kSteps / reach;
  for (std::size_t i = 0; i < block.size(); ++i) {
    const double x = block.x[i] - centre.x();
    const double y = block.y[i] - centre.y();
    const double z = block.z[i] - centre.z();
    if (std::abs(x) < reach && std::abs(y) < reach && std::abs(z) < reach) {  // never true for NaN
      ++sums.points;
      sums.steps[0] += std::llrint(x * scale);
      sums.steps[1] += std::llrint(y * scale);
      sums.steps[2] += std::llrint(z * scale);
    }
  }
}

}  // namespace

void for_blocks(const ScanReader& reader, const VisitBlock& visit) {
  tbb::enumerable_thread_specific<ScanBlock> per_thread;
  FirstError error;
  std::atomic<std::size_t> next{
      0};  // in file order, so that what was just read from the disk, or decoded, is near
  const auto visit_next = [&](int /*worker*/) {
    for (std::size_t i = next++; i < reader.blocks() && !error.before(i); i = next++) {
      try {
        ScanBlock& block = per_thread.local();
        block.no_returns = 0;
        reader.read(i, block);
        block.drop_no_returns();
        visit(i, block);
      } catch (...) {
        error.note(i);
      }
    }
  };
  tbb::parallel_for(0, tbb::this_task_arena::max_concurrency(), visit_next, tbb::simple_partitioner());
  error.rethrow();
}

Vec3 scan_middle(const ScanReader& reader, const ScanBlock& sample, double reach,
                 const std::function<void(std::uint64_t)>& advance) {
  const double largest = 1e6 * reach;  // beyond it a coordinate is a ghost in any frame
  const Vec3 centre(median_or_zero(sample.x, largest), median_or_zero(sample.y, largest),
                    median_or_zero(sample.z, largest));
  tbb::enumerable_thread_specific<Sums> per_thread;
  for_blocks(reader, [&](std::size_t, const ScanBlock& block) {
    add_points(block, centre, reach, per_thread.local());
    if (advance) {
      advance(1);
    }
  });
  Sums total;
  for (const Sums& sums : per_thread) {
    total.points += sums.points;
    for (std::size_t k = 0; k < 3; ++k) {
      total.steps[k] += sums.steps[k];
    }
  }
  const double step = reach / kSteps / static_cast<double>(std::max<std::int64_t>(1, total.points));
  return centre + step * Vec3(static_cast<double>(total.steps[0]), static_cast<double>(total.steps[1]),
                              static_cast<double>(total.steps[2]));
}

}  // namespace roomcut::ingest
