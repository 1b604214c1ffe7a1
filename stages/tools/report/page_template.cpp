// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/tools/report/page_template.h"

#define ZLIB_CONST  // zlib then promises to only read its input
#include <tbb/parallel_for.h>
#include <zlib.h>

#include <new>
#include <stdexcept>

#include "common/picture/svg.h"

namespace roomcut::report {

namespace {

constexpr int kGzipWindow = 15 + 16;  // zlib: the largest window, with a gzip header
constexpr int kMemory = 9;
constexpr int kQuick = 3;

}  // namespace

std::string gzip(std::string_view bytes, bool noisy) {
  z_stream stream{};
  if (deflateInit2(&stream, kQuick, Z_DEFLATED, kGzipWindow, kMemory, noisy ? Z_RLE : Z_DEFAULT_STRATEGY) !=
      Z_OK) {
    throw std::bad_alloc();  // the one reason that it can have
  }
  std::string packed(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<const Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int result = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (result != Z_STREAM_END) {
    throw std::runtime_error("zlib cannot finish");
  }
  return packed;
}

std::string fill_template(std::string_view page_template, const std::vector<PageBlock>& blocks) {
  const std::size_t mark = page_template.find(kDataMark);
  if (mark == std::string_view::npos) {
    throw std::invalid_argument("the page's template has no place for data");
  }
  std::string page(page_template.substr(0, mark));
  std::vector<std::string> packed(blocks.size());
  tbb::parallel_for(std::size_t{0}, blocks.size(),
                    [&](std::size_t i) { packed[i] = gzip(blocks[i].bytes, blocks[i].noisy); });
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    page += "<script type=\"application/octet-stream\" id=\"block-" + blocks[i].name + "\">";
    page += base64({reinterpret_cast<const std::uint8_t*>(packed[i].data()), packed[i].size()});
    page += "</script>\n";
  }
  page += page_template.substr(mark + kDataMark.size());
  return page;
}

}  // namespace roomcut::report
