// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/synthesize/synthesize_io.h"

#include <tbb/parallel_pipeline.h>

#include <memory>
#include <string>

#include "stages/tools/synthesize/output_file.h"

namespace roomcut::synthesize {

namespace {

/// The points of one block.
struct Block {
  std::uint64_t number;
  std::vector<float> xyz;
};

/// Hands blocks to the writer in their order, and says where a set-up begins.
class BlockSink {
 public:
  BlockSink(ScanWriter& writer, const Scene& scene, const PointSource& source)
      : writer_(writer), scene_(scene), source_(source) {}
  void take(const Block& block) {
    const SetUp set_up = source_.set_up(block.number);
    if (next_ <= set_up.number) {
      next_ = set_up.number + 1;
      begin(set_up);
    }
    writer_.add(block.xyz);
    points_ += block.xyz.size() / 3;
  }
  std::uint64_t points() const { return points_; }

 private:
  void begin(const SetUp& set_up) {
    if (!set_up.station) return writer_.begin(nullptr);
    const ScannerPose pose = pose_of(scene_, set_up.number, *set_up.station);
    writer_.begin(&pose);
  }
  ScanWriter& writer_;
  const Scene& scene_;
  const PointSource& source_;
  std::uint64_t next_ = 0, points_ = 0;
};

}  // namespace

std::uint64_t write_scan(const std::filesystem::path& path, const Scene& scene, const PointSource& source,
                         const ScanFormat& format, int threads,
                         const std::function<void(std::uint64_t)>& progress) {
  const std::unique_ptr<ScanWriter> writer = make_scan_writer(path, scene, format);
  BlockSink sink(*writer, scene, source);
  std::uint64_t next = 0;
  using Made = std::shared_ptr<Block>;
  tbb::parallel_pipeline(
      static_cast<std::size_t>(threads) * 3,
      tbb::make_filter<void, std::uint64_t>(tbb::filter_mode::serial_in_order,
                                            [&](tbb::flow_control& control) -> std::uint64_t {
                                              if (next < source.blocks()) return next++;
                                              control.stop();
                                              return 0;
                                            }) &
          tbb::make_filter<std::uint64_t, Made>(tbb::filter_mode::parallel,
                                                [&](std::uint64_t number) {
                                                  auto block = std::make_shared<Block>();
                                                  block->number = number;
                                                  block->xyz.reserve(3 << 16);
                                                  source.make(number, block->xyz);
                                                  return block;
                                                }) &
          tbb::make_filter<Made, void>(tbb::filter_mode::serial_in_order, [&](const Made& block) {
            sink.take(*block);
            progress(block->xyz.size() / 3);
          }));
  writer->finish();
  return sink.points();
}

void write_truth(const std::filesystem::path& path, const Scene& scene, const Building& building,
                 const TriangleMesh& truth) {
  OutputFile file(path);
  const std::uint64_t n = copies(scene);
  std::string text = "OFF\n" + std::to_string(truth.vertices.size() * n) + " " +
                     std::to_string(truth.triangles.size() * n) + " 0\n";
  const auto flush = [&] {
    file.write(text);
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

}  // namespace roomcut::synthesize
