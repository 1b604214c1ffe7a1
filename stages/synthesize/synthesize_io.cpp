// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/synthesize/synthesize_io.h"

#include <tbb/parallel_pipeline.h>

#include <charconv>
#include <cstdio>
#include <memory>
#include <string>

#include "common/artefact/atomic_file.h"
#include "common/errors/codes.h"

namespace roomcut {

namespace {

/// A file that is written from front to back, and whose header may be written again.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path)
      : file_(path), stream_(std::fopen(file_.temporary_path().c_str(), "wb"), &std::fclose) {
    check(stream_ != nullptr);
  }
  void write(const void* data, std::size_t bytes) {
    check(std::fwrite(data, 1, bytes, stream_.get()) == bytes);
  }
  void rewind() { check(std::fseek(stream_.get(), 0, SEEK_SET) == 0); }
  void commit() {
    check(std::fclose(stream_.release()) == 0);
    file_.commit();
  }

 private:
  void check(bool good) const {
    if (!good)
      throw StageError(errors::kCannotWrite, file_.final_path().string(), "cannot be written",
                       "is the disk full?");
  }
  AtomicFile file_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream_;
};

std::string shortest(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

/// Always of the same length for one scene: the number of points is known only at the end.
std::string ply_header(const Scene& scene, std::uint64_t points) {
  const std::string count = std::to_string(points);
  return "ply\nformat binary_little_endian 1.0\ncomment synthetic scan of scene " + scene.name + ", noise " +
         shortest(scene.noise_m) + " m, seed " + std::to_string(scene.seed) +
         std::string(20 - count.size(), ' ') + "\nelement vertex " + count +
         "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
}

}  // namespace

std::uint64_t write_scan(const std::filesystem::path& path, const Scene& scene, const PointSource& source,
                         int threads, const std::function<void(std::uint64_t)>& progress) {
  OutputFile file(path);
  const std::string header = ply_header(scene, 0);
  file.write(header.data(), header.size());
  std::uint64_t next = 0;
  std::uint64_t points = 0;
  using Block = std::shared_ptr<std::vector<float>>;
  tbb::parallel_pipeline(
      static_cast<std::size_t>(threads) * 3,
      tbb::make_filter<void, std::uint64_t>(tbb::filter_mode::serial_in_order,
                                            [&](tbb::flow_control& control) -> std::uint64_t {
                                              if (next < source.blocks()) return next++;
                                              control.stop();
                                              return 0;
                                            }) &
          tbb::make_filter<std::uint64_t, Block>(tbb::filter_mode::parallel,
                                                 [&](std::uint64_t block) {
                                                   auto xyz = std::make_shared<std::vector<float>>();
                                                   xyz->reserve(3 << 16);
                                                   source.make(block, *xyz);
                                                   return xyz;
                                                 }) &
          tbb::make_filter<Block, void>(tbb::filter_mode::serial_in_order, [&](const Block& xyz) {
            file.write(xyz->data(), xyz->size() * sizeof(float));
            points += xyz->size() / 3;
            progress(xyz->size() / 3);
          }));
  file.rewind();
  const std::string complete = ply_header(scene, points);
  file.write(complete.data(), complete.size());
  file.commit();
  return points;
}

void write_truth(const std::filesystem::path& path, const Scene& scene, const Building& building,
                 const TriangleMesh& truth) {
  OutputFile file(path);
  const std::uint64_t n = copies(scene);
  std::string text = "OFF\n" + std::to_string(truth.vertices.size() * n) + " " +
                     std::to_string(truth.triangles.size() * n) + " 0\n";
  const auto flush = [&] {
    file.write(text.data(), text.size());
    text.clear();
  };
  for (std::uint64_t copy = 0; copy < n; ++copy) {
    const Vec3 offset = copy_offset(scene, building, copy);
    for (const Vec3& v : truth.vertices) {
      const Vec3 p = v + offset;
      text += shortest(p.x()) + " " + shortest(p.y()) + " " + shortest(p.z()) + "\n";
    }
    flush();
  }
  for (std::uint64_t copy = 0; copy < n; ++copy) {
    const std::uint64_t first = copy * truth.vertices.size();
    for (const auto& t : truth.triangles) {
      text += "3";
      for (const std::int32_t v : t) text += " " + std::to_string(first + static_cast<std::uint64_t>(v));
      text += "\n";
    }
    flush();
  }
  file.commit();
}

}  // namespace roomcut
